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

std::string ObjText(const Proxy& proxy) {
  std::string vertices, faces;
  std::map<std::array<double, 3>, int> numbers;  // shared corners are shared vertices
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      std::string name = facet.id;
      std::replace(name.begin(), name.end(), '/', '_');
      fmt::format_to(std::back_inserter(faces), "g {}\n", name);
      const FacetTriangles triangulation = TriangulateFacet(facet);
      for (const auto& triangle : triangulation.triangles) {
        faces += "f";
        for (const uint32_t corner : triangle) {
          const Eigen::Vector3d& p = triangulation.vertices[corner];
          const auto [entry, added] =
              numbers.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(numbers.size()) + 1);
          if (added) {
            fmt::format_to(std::back_inserter(vertices), "v {:.12g} {:.12g} {:.12g}\n", p.x(),
                           p.y(), p.z());
          }
          fmt::format_to(std::back_inserter(faces), " {}", entry->second);
        }
        faces += "\n";
      }
    }
  }
  return "# Stucco proxy: one group per facet\n" + vertices + faces;
}

}  // namespace stucco
