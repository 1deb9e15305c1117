// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/part_near.h"

#include <algorithm>

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr double kBorder_m = 0.25;

struct Cutter {
  const SurfaceIndex& things;
  double reach_m;
  Surface near;

  void Keep(const Corners& corners, int group) {
    const auto first = static_cast<uint32_t>(near.vertices.size());
    near.vertices.insert(near.vertices.end(), corners.begin(), corners.end());
    near.triangles.push_back({first, first + 1, first + 2});
    near.groups.push_back(group);
  }

  // A triangle is kept or left whole where the circle around it says so, else halved across its
  // longest side.
  void Take(const Corners& corners, int group) {
    const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Vector3d& corner : corners) radius = std::max(radius, (corner - middle).norm());
    const double away = things.Distance(middle);
    if (away > reach_m + radius) return;
    if (away + radius <= reach_m || radius <= kBorder_m) {
      if (away <= reach_m) Keep(corners, group);
      return;
    }
    size_t longest = 0;
    for (size_t i = 1; i < 3; ++i) {
      const auto side = [&](size_t k) { return (corners[(k + 1) % 3] - corners[k]).squaredNorm(); };
      if (side(i) > side(longest)) longest = i;
    }
    const Vector3d& a = corners[longest];
    const Vector3d& b = corners[(longest + 1) % 3];
    const Vector3d& c = corners[(longest + 2) % 3];
    const Vector3d half = (a + b) / 2;
    Take({a, half, c}, group);
    Take({half, b, c}, group);
  }
};

}  // namespace

Surface PartNear(const Surface& surface, const SurfaceIndex& things, double reach_m) {
  Cutter cutter{things, reach_m, {}};
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    cutter.Take({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]},
                surface.groups[i]);
  }
  return std::move(cutter.near);
}

}  // namespace stucco::evaluate
