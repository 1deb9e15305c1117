// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulate/random.h"
#include "simulate/scene/scene_folder.h"
#include "survey/triangulate.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

// Half the cross product of two sides: the triangle's area along its normal.
Vector3d AreaVector(const Surface& surface, const std::array<uint32_t, 3>& triangle) {
  const Vector3d& a = surface.vertices[triangle[0]];
  return 0.5 * (surface.vertices[triangle[1]] - a).cross(surface.vertices[triangle[2]] - a);
}

// The same number in [0, 1) for the same arguments, and unrelated ones for others.
double RandomShare(uint64_t seed, uint64_t index) {
  return static_cast<double>(simulate::SeedOf(seed, index) >> 11) * 0x1p-53;
}

}  // namespace

void Append(const Facet& facet, Surface& surface) {
  const FacetTriangles pieces = TriangulateFacet(facet);
  const auto first = static_cast<uint32_t>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), pieces.vertices.begin(), pieces.vertices.end());
  for (const auto& t : pieces.triangles) {
    surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    surface.groups.push_back(static_cast<int>(facet.facet_class));
  }
}

void Append(const Surface& more, Surface& surface) {
  const auto first = static_cast<uint32_t>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& t : more.triangles) {
    surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  surface.groups.insert(surface.groups.end(), more.groups.begin(), more.groups.end());
}

int GroupOf(const std::string& element) {
  if (element.starts_with(simulate::kOccluderPrefix)) return kStandsAbout;
  const size_t slash = element.find('/');
  if (slash == std::string::npos) return static_cast<int>(FacetClass::kGround);
  const char part = slash + 1 < element.size() ? element[slash + 1] : '\0';
  if (part == 'R') return static_cast<int>(FacetClass::kRoof);
  return static_cast<int>(part == 'F' || part == 'W' ? FacetClass::kWall : FacetClass::kOuterFloor);
}

bool IsOfBuilding(int group) {
  return group != static_cast<int>(FacetClass::kGround) && group != kStandsAbout;
}

namespace {

Surface SurfaceOf(const simulate::Scene& scene, bool with_what_stands_about) {
  std::vector<int> groups;
  for (const std::string& element : scene.elements) groups.push_back(GroupOf(element));
  Surface surface;
  for (const Eigen::Vector3f& position : scene.positions) {
    surface.vertices.push_back(position.cast<double>());
  }
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    const int group = groups[scene.elements_of[i]];
    if (group == kStandsAbout && !with_what_stands_about) continue;
    const Eigen::Vector3i& t = scene.triangles[i];
    surface.triangles.push_back(
        {static_cast<uint32_t>(t[0]), static_cast<uint32_t>(t[1]), static_cast<uint32_t>(t[2])});
    surface.groups.push_back(group);
  }
  return surface;
}

}  // namespace

Surface SurfaceOf(const simulate::Scene& scene) {
  return SurfaceOf(scene, true);
}

Surface ReliefOf(const simulate::Scene& scene) {
  return SurfaceOf(scene, false);
}

double SurfaceArea(const Surface& surface) {
  double area = 0;
  for (const auto& triangle : surface.triangles) area += AreaVector(surface, triangle).norm();
  return area;
}

std::vector<Vector3d> Positions(std::span<const SurfacePoint> points) {
  std::vector<Vector3d> positions;
  positions.reserve(points.size());
  for (const SurfacePoint& point : points) positions.push_back(point.position);
  return positions;
}

std::vector<SurfacePoint> SamplePoints(const Surface& surface, size_t count, uint64_t seed) {
  std::vector<double> up_to;  // area of the triangles up to and with each
  double area = 0;
  for (const auto& triangle : surface.triangles) {
    up_to.push_back(area += AreaVector(surface, triangle).norm());
  }
  if (!(area > 0) || !std::isfinite(area)) return {};
  std::vector<SurfacePoint> points;
  points.reserve(count);
  size_t i = 0;
  for (size_t k = 0; k < count; ++k) {
    const double at =
        area * (static_cast<double>(k) + RandomShare(seed, 3 * k)) / static_cast<double>(count);
    while (i + 1 < up_to.size() && up_to[i] <= at) ++i;
    const std::array<uint32_t, 3>& t = surface.triangles[i];
    // Evenly over a triangle: Osada et al., "Shape distributions" (2002), eq. 1.
    const double root = std::sqrt(RandomShare(seed, 3 * k + 1));
    const double share = RandomShare(seed, 3 * k + 2);
    points.push_back({(1 - root) * surface.vertices[t[0]] +
                          root * (1 - share) * surface.vertices[t[1]] +
                          root * share * surface.vertices[t[2]],
                      AreaVector(surface, t).normalized(), surface.groups[i]});
  }
  return points;
}

}  // namespace stucco::evaluate
