// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "survey/triangulate.h"

namespace stucco {

namespace {

class ObjWriter {
 public:
  void Add(const Facet& facet) {
    std::string name = facet.id;
    std::replace(name.begin(), name.end(), '/', '_');
    fmt::format_to(std::back_inserter(faces_), "g {}\n", name);
    const FacetTriangles triangulation = TriangulateFacet(facet);
    for (const auto& triangle : triangulation.triangles) {
      faces_ += "f";
      for (const uint32_t corner : triangle) {
        fmt::format_to(std::back_inserter(faces_), " {}", NumberOf(triangulation.vertices[corner]));
      }
      faces_ += "\n";
    }
  }

  std::string Text() const { return "# Stucco proxy: one group per facet\n" + vertices_ + faces_; }

 private:
  int NumberOf(const Eigen::Vector3d& p) {
    const auto [entry, added] =
        numbers_.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(numbers_.size()) + 1);
    if (added) {
      fmt::format_to(std::back_inserter(vertices_), "v {:.12g} {:.12g} {:.12g}\n", p.x(), p.y(),
                     p.z());
    }
    return entry->second;
  }

  std::string vertices_;
  std::string faces_;
  std::map<std::array<double, 3>, int> numbers_;  // shared corners are shared vertices
};

}  // namespace

std::string ObjText(const Proxy& proxy) {
  ObjWriter writer;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) writer.Add(facet);
  }
  return writer.Text();
}

}  // namespace stucco
