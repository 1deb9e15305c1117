// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace stucco::simulate {
namespace {

void AddWalls(const Polygon& outline, const std::optional<PitchedRoof>& roof, int corners,
              Solid& solid) {
  int start = 0;
  for (const Ring& ring : outline.rings) {
    const int n = static_cast<int>(ring.size());
    for (int i = 0; i < n; ++i) {
      const int a = start + i;
      const int b = start + (i + 1) % n;
      Solid::Face wall{.facet_class = FacetClass::kWall, .edge = a, .outer = {}, .holes = {}};
      wall.outer = {a, b, corners + b};
      if (roof && roof->apex_of[a] >= 0) wall.outer.push_back(corners + roof->apex_of[a]);
      wall.outer.push_back(corners + a);
      solid.faces.push_back(std::move(wall));
    }
    start += n;
  }
}

// The outline as a face, at the vertices from `first` on.
Solid::Face Slab(const Polygon& outline, int first, bool upwards) {
  Solid::Face face;
  face.facet_class = upwards ? FacetClass::kRoof : FacetClass::kGround;
  for (size_t r = 0; r < outline.rings.size(); ++r) {
    std::vector<int> ring;
    for (size_t i = 0; i < outline.rings[r].size(); ++i) ring.push_back(first++);
    if (!upwards) std::reverse(ring.begin(), ring.end());
    if (r == 0) {
      face.outer = std::move(ring);
    } else {
      face.holes.push_back(std::move(ring));
    }
  }
  return face;
}

}  // namespace

Loop Corners(const Solid& solid, const std::vector<int>& ring) {
  Loop loop;
  for (const int corner : ring) loop.push_back(solid.vertices[corner]);
  return loop;
}

Solid MakeSolid(const Polygon& outline, double base_m, double eaves_m,
                const std::optional<PitchedRoof>& roof) {
  Solid solid;
  for (const double z : {base_m, eaves_m}) {
    for (const Ring& ring : outline.rings) {
      for (const Eigen::Vector2d& corner : ring) {
        solid.vertices.emplace_back(corner.x(), corner.y(), z);
      }
    }
  }
  const int corners = static_cast<int>(solid.vertices.size()) / 2;
  AddWalls(outline, roof, corners, solid);
  if (roof) {
    for (size_t i = corners; i < roof->vertices.size(); ++i) {
      solid.vertices.push_back(roof->vertices[i] + Eigen::Vector3d(0, 0, eaves_m));
    }
    for (const PitchedRoof::Face& face : roof->faces) {
      std::vector<int> outer = face.corners;
      for (int& corner : outer) corner += corners;
      solid.faces.push_back({FacetClass::kRoof, face.edge, std::move(outer), {}});
    }
  } else {
    solid.faces.push_back(Slab(outline, corners, /*upwards=*/true));
  }
  solid.faces.push_back(Slab(outline, 0, /*upwards=*/false));
  return solid;
}

std::optional<std::string> FindGap(const Solid& solid) {
  std::map<std::pair<int, int>, int> uses;
  const auto count = [&](const std::vector<int>& ring) {
    for (size_t i = 0; i < ring.size(); ++i) ++uses[{ring[i], ring[(i + 1) % ring.size()]}];
  };
  for (const Solid::Face& face : solid.faces) {
    count(face.outer);
    for (const std::vector<int>& hole : face.holes) count(hole);
  }
  for (const auto& [edge, times] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (times == 1 && back != uses.end() && back->second == 1) continue;
    return fmt::format("the edge from vertex {} to {} does not border two faces", edge.first,
                       edge.second);
  }
  return std::nullopt;
}

}  // namespace stucco::simulate
