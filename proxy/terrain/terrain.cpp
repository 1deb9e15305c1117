// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/terrain/terrain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "proxy/map/floors.h"
#include "proxy/map/outlines.h"
#include "proxy/terrain/ground_heights.h"
#include "proxy/terrain/terrain_mesh.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

// Whether the scene's planes say all: nearly every cell lies on its main plane or on level ones.
bool IsPlanar(const PlanarScene& scene, const GroundHeights& ground,
              const Eigen::Matrix3d& upright_from_world) {
  constexpr double kNearlyAll = 0.92;
  const double tolerance = scene.tolerances.level_of_detail / 2;
  size_t seen = 0, planar = 0;
  for (const GroundCell& cell : ground.cells()) {
    if (cell.samples == 0) continue;
    ++seen;
    const Eigen::Vector3d p = upright_from_world.transpose() * cell.middle;
    planar += std::ranges::any_of(scene.ground, [&](const Plane& plane) {
      const bool counts = &plane == &scene.ground.front() || plane.role == PlaneRole::kHorizontal;
      return counts && std::abs(plane.DistanceTo(p)) < tolerance;
    });
  }
  return static_cast<double>(planar) >= kNearlyAll * static_cast<double>(seen);
}

// Around what was seen of the ground, gaps and houses closed; small islands are none.
std::vector<Ring> OutlinesOf(const GroundHeights& ground, const Tolerances& tolerances) {
  constexpr double kSmallestAreas = 10;  // of min_area
  constexpr double kStraight = 1.5;      // cells that an outline may pass beside its corners
  const double side = ground.side();
  const int reach = std::max(3, static_cast<int>(std::lround(tolerances.fill_gap / side)));
  // Room for what dilation adds.
  cv::Mat seen = cv::Mat::zeros(ground.rows() + 2 * reach, ground.columns() + 2 * reach, CV_8U);
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) {
      if (ground.At(x, y).samples > 0) seen.at<uchar>(y + reach, x + reach) = 255;
    }
  }
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
  cv::morphologyEx(seen, seen, cv::MORPH_CLOSE, disc);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(seen, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Ring> outlines;
  for (const auto& contour : contours) {
    std::vector<cv::Point> corners;
    cv::approxPolyDP(contour, corners, kStraight, /*closed=*/true);
    Ring ring;
    for (const cv::Point& p : corners) ring.push_back(ground.MiddleOf(p.x - reach, p.y - reach));
    if (ring.size() >= 3 && std::abs(SignedArea(ring)) > kSmallestAreas * tolerances.min_area) {
      outlines.push_back(std::move(ring));
    }
  }
  return outlines;
}

Facet FacetOf(const TerrainTriangle& triangle, double side,
              const Eigen::Matrix3d& world_from_upright) {
  Facet facet;
  facet.facet_class = FacetClass::kGround;
  for (const auto& corner : triangle.corners) facet.outer.push_back(world_from_upright * corner);
  const Eigen::Vector3d normal =
      (facet.outer[1] - facet.outer[0]).cross(facet.outer[2] - facet.outer[0]);
  facet.area = normal.norm() / 2;
  facet.normal = normal.normalized();
  facet.offset = facet.normal.dot(facet.outer[0]);
  facet.support = triangle.points;
  const double level = facet.normal.dot(world_from_upright.col(2));
  if (triangle.cells > 0) facet.rms = level * std::sqrt(triangle.squares / triangle.cells);
  facet.seen = std::min(1.0, triangle.cells * side * side / (level * facet.area));
  facet.inferred = 1 - facet.seen;
  facet.source = "planes";
  return facet;
}

// Twice the area over the longest side.
double HeightOf(const Facet& triangle) {
  double longest = 0;
  for (size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, (triangle.outer[i] - triangle.outer[(i + 1) % 3]).norm());
  }
  return 2 * triangle.area / longest;
}

}  // namespace

std::vector<Facet> TerrainFacets(const PlanarScene& scene, std::span<const Building> buildings) {
  constexpr double kTolerance = 1.0 / 3;  // of the level of detail
  constexpr double kThinnest = 0.1;       // of the level of detail
  std::vector<Facet> facets;
  if (scene.ground.empty()) return facets;
  const Eigen::Matrix3d upright_from_world = UprightFromWorld(scene.up);
  const std::vector<Polygon> footprints = FloorsOf(buildings, upright_from_world);
  const GroundHeights ground = MeasureGround(scene, footprints);
  if (IsPlanar(scene, ground, upright_from_world)) return facets;
  const double detail = scene.tolerances.level_of_detail;
  const auto outlines = OutlinesOf(ground, scene.tolerances);
  for (const auto& triangle : MeshTerrain(ground, outlines, footprints, kTolerance * detail)) {
    Facet facet = FacetOf(triangle, ground.side(), upright_from_world.transpose());
    if (HeightOf(facet) > kThinnest * detail) facets.push_back(std::move(facet));
  }
  return facets;
}

}  // namespace stucco
