// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/match_facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "evaluate/geometry/moved.h"
#include "survey/geometry2d.h"
#include "survey/triangulate.h"

namespace stucco::evaluate {
namespace {

using Point = Eigen::Vector2d;
using Triangle = std::array<Point, 3>;
using Box = Eigen::AlignedBox2d;

constexpr double kLeastOverlapM2 = 1e-4;  // facets that only touch have slivers in common
constexpr double kLeastCosine = 1e-3;     // planes at right angles have no distance along a normal

// What of a convex polygon lies left of the line from a to b (Sutherland & Hodgman, "Reentrant
// Polygon Clipping", 1974).
Ring ClippedLeftOf(const Ring& polygon, const Point& a, const Point& b) {
  Ring kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point& from = polygon[i];
    const Point& to = polygon[(i + 1) % polygon.size()];
    const double from_side = Cross(b - a, from - a);
    const double to_side = Cross(b - a, to - a);
    if (from_side >= 0) kept.push_back(from);
    if ((from_side > 0 && to_side < 0) || (from_side < 0 && to_side > 0)) {
      kept.push_back(from + (to - from) * (from_side / (from_side - to_side)));
    }
  }
  return kept;
}

Ring Intersection(const Triangle& a, const Triangle& b) {
  Ring common(a.begin(), a.end());
  for (size_t i = 0; i < 3 && !common.empty(); ++i) {
    common = ClippedLeftOf(common, b[i], b[(i + 1) % 3]);
  }
  return common;
}

// The plane of a facet as a sheet of paper.
struct Sheet {
  Eigen::Vector3d origin, u, v, normal;

  explicit Sheet(const Facet& facet)
      : origin(facet.outer.front()),
        u(facet.normal.unitOrthogonal()),
        v(facet.normal.cross(u)),
        normal(facet.normal) {}
  Point Down(const Eigen::Vector3d& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Eigen::Vector3d Up(const Point& p) const { return origin + p.x() * u + p.y() * v; }
};

// Counter-clockwise triangles of a facet seen along the normal of a sheet.
std::vector<Triangle> Flattened(const Facet& facet, const Sheet& sheet) {
  const FacetTriangles pieces = TriangulateFacet(facet);
  std::vector<Triangle> flat;
  for (const auto& corners : pieces.triangles) {
    Triangle triangle;
    for (size_t i = 0; i < 3; ++i) triangle[i] = sheet.Down(pieces.vertices[corners[i]]);
    if (Cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0) {
      std::swap(triangle[1], triangle[2]);
    }
    flat.push_back(triangle);
  }
  return flat;
}

Box BoxOf(const Triangle& triangle) {
  Box box;
  for (const Point& corner : triangle) box.extend(corner);
  return box;
}

Eigen::AlignedBox3d BoxOf(const Facet& facet) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : facet.outer) box.extend(corner);
  return box;
}

double PolygonArea(const Facet& facet) {
  double area = 0;
  for (const Triangle& t : Flattened(facet, Sheet(facet))) {
    area += Cross(t[1] - t[0], t[2] - t[0]) / 2;
  }
  return area;
}

struct Candidate {
  const Facet* result;
  Facet moved;
  Eigen::AlignedBox3d box;
};

TruthFacet MatchesOf(const Facet& truth, const std::vector<Candidate>& candidates,
                     const MatchLimits& limits) {
  TruthFacet answer{.truth = &truth, .area_m2 = PolygonArea(truth), .matches = {}};
  const Eigen::AlignedBox3d box = BoxOf(truth);
  for (const Candidate& candidate : candidates) {
    const double sine = truth.normal.cross(candidate.moved.normal).norm();
    const double angle = std::atan2(sine, truth.normal.dot(candidate.moved.normal));
    const double angle_deg = angle * 180 / std::numbers::pi;
    if (!(angle_deg <= limits.angle_deg)) continue;
    // Somewhere the distance is no more than its mean.
    if (!(box.exteriorDistance(candidate.box) <= limits.distance_m)) continue;
    const FacetOverlap overlap = Overlap(truth, candidate.moved);
    if (overlap.area_m2 >= kLeastOverlapM2 && overlap.distance_m <= limits.distance_m) {
      answer.matches.push_back({candidate.result, overlap.area_m2, overlap.distance_m, angle_deg});
    }
  }
  std::stable_sort(
      answer.matches.begin(), answer.matches.end(),
      [](const FacetMatch& a, const FacetMatch& b) { return a.overlap_m2 > b.overlap_m2; });
  return answer;
}

}  // namespace

FacetOverlap Overlap(const Facet& a, const Facet& b) {
  FacetOverlap overlap;
  const double cosine = a.normal.dot(b.normal);
  if (!(std::abs(cosine) >= kLeastCosine)) return overlap;
  const Sheet sheet(a);
  const std::vector<Triangle> of_a = Flattened(a, sheet), of_b = Flattened(b, sheet);
  std::vector<Box> boxes;
  boxes.reserve(of_b.size());
  for (const Triangle& triangle : of_b) boxes.push_back(BoxOf(triangle));
  double moment = 0;
  for (const Triangle& triangle : of_a) {
    const Box box = BoxOf(triangle);
    for (size_t j = 0; j < of_b.size(); ++j) {
      if (!box.intersects(boxes[j])) continue;
      const Ring common = Intersection(triangle, of_b[j]);
      for (size_t i = 1; i + 1 < common.size(); ++i) {
        const Ring piece = {common[0], common[i], common[i + 1]};
        const double area = SignedArea(piece);
        const Eigen::Vector3d middle = sheet.Up((piece[0] + piece[1] + piece[2]) / 3);
        overlap.area_m2 += area;
        moment += area * std::abs((b.offset - b.normal.dot(middle)) / cosine);
      }
    }
  }
  if (overlap.area_m2 > 0) overlap.distance_m = moment / overlap.area_m2;
  return overlap;
}

bool IsFacade(const Facet& truth) {
  return truth.facet_class == FacetClass::kWall && truth.seen > 0;
}

std::vector<TruthFacet> MatchFacets(const Proxy& result, const Proxy& truth,
                                    const Similarity& truth_from_result,
                                    const MatchLimits& limits) {
  std::vector<Candidate> candidates;
  for (const Building& building : result.buildings) {
    for (const Facet& facet : building.facets) {
      Facet moved = Moved(facet, truth_from_result);
      const Eigen::AlignedBox3d box = BoxOf(moved);
      candidates.push_back({&facet, std::move(moved), box});
    }
  }
  std::vector<TruthFacet> answer;
  for (const Building& building : truth.buildings) {
    for (const Facet& facet : building.facets) {
      answer.push_back(MatchesOf(facet, candidates, limits));
    }
  }
  return answer;
}

}  // namespace stucco::evaluate
