// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/roof_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "proxy/facets/contour_lines.h"
#include "proxy/map/open_ground.h"

namespace stucco {
namespace {

constexpr double kSameLine_m = 1e-5;

// How far two lines come apart inside the box; large where they are not about parallel.
double Apart(const CutLine& line, const CutLine& other, const Eigen::AlignedBox2d& box) {
  constexpr double kAlike = 0.1;
  if (std::abs(Cross(line.direction, other.direction)) > kAlike) return 1e9;
  const Eigen::Vector2d half = box.diagonal().norm() / 2 * line.direction;
  const Eigen::Vector2d middle =
      line.point + line.direction * line.direction.dot(box.center() - line.point);
  double apart = 0;
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(middle - half), Eigen::Vector2d(middle + half)}) {
    apart = std::max(apart, std::abs(Cross(other.direction, p - other.point)));
  }
  return apart;
}

bool IsNew(const CutLine& line, const std::vector<CutLine>& lines, const Eigen::AlignedBox2d& box,
           double apart) {
  return std::ranges::none_of(
      lines, [&](const CutLine& other) { return Apart(line, other, box) < apart; });
}

// Whether two roofs fall to opposite sides, so that they meet in a ridge.
bool FallApart(const RoofPlane& a, const RoofPlane& b) {
  constexpr double kOpposite = -0.98;  // cosine
  return a.slope.dot(b.slope) < kOpposite * a.slope.norm() * b.slope.norm();
}

// The line in which two roofs meet, where both have samples near it, or one of two that fall apart:
// the far side of a ridge is often seen only at its eaves. Nothing when they run parallel or meet
// elsewhere.
std::optional<CutLine> MeetingLine(const CoverOfRoofs& cover, const std::vector<RoofPlane>& roofs,
                                   size_t a, size_t b, double reach) {
  constexpr double kLeastSlope = 0.02;
  constexpr double kLeastShared_m = 0.5;
  const Eigen::Vector2d slope = roofs[a].slope - roofs[b].slope;
  if (slope.norm() < kLeastSlope) return std::nullopt;
  const Eigen::Vector2d n = slope.normalized();
  CutLine line{.point = n * ((roofs[b].height - roofs[a].height) / slope.norm()),
               .direction = {-n.y(), n.x()},
               .crease = true};
  const Eigen::AlignedBox2d box(
      cover.raster.origin,
      Eigen::Vector2d(cover.raster.Center(cover.raster.width - 1, cover.raster.height - 1)));
  const Eigen::Vector2d middle =
      line.point + line.direction * line.direction.dot(box.center() - line.point);
  line.point = middle;
  const double half = box.diagonal().norm() / 2;
  const bool ridge = FallApart(roofs[a], roofs[b]);
  double shared = 0;
  for (double t = -half; t <= half; t += cover.raster.cell) {
    const int at = cover.raster.IndexAt(middle + t * line.direction);
    if (at < 0) continue;
    const bool near_a = cover.to_hit[a][at] <= reach, near_b = cover.to_hit[b][at] <= reach;
    if (ridge ? near_a || near_b : near_a && near_b) shared += cover.raster.cell;
  }
  if (shared < kLeastShared_m) return std::nullopt;
  return line;
}

// Straight borders of what lies within reach of `to_hit`: what a roof covers, in the ground plan;
// axes are those of the longest edge.
std::vector<CutLine> BordersOf(const PlaneRaster& raster, const std::vector<float>& to_hit,
                               const CutLine& axis, const std::vector<CutLine>& creases,
                               double detail) {
  constexpr int kMostLines = 10;
  const Eigen::Vector2d u = axis.direction, v(-u.y(), u.x());
  // The raster once more, turned to the axes.
  PlaneRaster turned = raster;
  const Eigen::Vector2d center = raster.Center(turned.width / 2, turned.height / 2);
  const double half = std::hypot(turned.width, turned.height) / 2 * turned.cell;
  turned.width = turned.height = static_cast<int>(2 * half / turned.cell) + 1;
  turned.origin = Eigen::Vector2d(u.dot(center) - half, v.dot(center) - half);
  const float reach = static_cast<float>(1.5 * turned.cell);
  std::vector<Evidence> evidence(static_cast<size_t>(turned.width) * turned.height,
                                 Evidence::kUnknown);
  for (int y = 0; y < turned.height; ++y) {
    for (int x = 0; x < turned.width; ++x) {
      const Eigen::Vector2d p = turned.Center(x, y);
      const int at = raster.IndexAt(p.x() * u + p.y() * v);
      if (at >= 0 && to_hit[at] <= reach) {
        evidence[turned.Index(x, y)] = Evidence::kSeen;
      }
    }
  }
  std::vector<CutLine> turned_creases;
  for (const CutLine& crease : creases) {
    CutLine line = crease;
    line.point = {u.dot(crease.point), v.dot(crease.point)};
    line.direction = {u.dot(crease.direction), v.dot(crease.direction)};
    turned_creases.push_back(line);
  }
  auto lines =
      ContourLines(turned, evidence, turned_creases,
                   {.detail = detail, .most_lines = kMostLines, .free_length = 10 * detail});
  for (CutLine& line : lines) {
    line.point = Eigen::Vector2d(line.point.x() * u + line.point.y() * v);
    line.direction = Eigen::Vector2d(line.direction.x() * u + line.direction.y() * v);
  }
  return lines;
}

// Lines of a footprint, the first ones first, none twice.
class LineList {
 public:
  LineList(const MapBuilding& building, const Eigen::AlignedBox2d& box)
      : box_(box), lines_(EdgeLines(building, box)), most_(std::max(kMostLines, lines_.size())) {}

  // Unless one of those that there are is nearer than that.
  void Add(const CutLine& line, double apart) {
    if (lines_.size() < most_ && IsNew(line, lines_, box_, apart)) lines_.push_back(line);
  }
  const std::vector<CutLine>& lines() const { return lines_; }

 private:
  static constexpr size_t kMostLines = 120;  // some thousand cells; the first ones matter most

  Eigen::AlignedBox2d box_;
  std::vector<CutLine> lines_;
  size_t most_;
};

}  // namespace

Eigen::AlignedBox2d BoxAround(const MapBuilding& building) {
  constexpr double kMargin_m = 1;
  return BoundsOf(building, kMargin_m);
}

// Longest first, so that short edges follow long ones that they lie in line with.
std::vector<CutLine> EdgeLines(const MapBuilding& building, const Eigen::AlignedBox2d& box) {
  std::vector<Segment2d> edges;
  for (const Polygon& part : building.parts) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        edges.push_back(EdgeOf(ring, i));
      }
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Segment2d& a, const Segment2d& b) {
    return (a.b - a.a).squaredNorm() > (b.b - b.a).squaredNorm();
  });
  constexpr double kSameEdge_m = 1e-4;
  std::vector<CutLine> lines;
  for (const Segment2d& edge : edges) {
    const CutLine line{.point = edge.a, .direction = (edge.b - edge.a).normalized()};
    if (IsNew(line, lines, box, kSameEdge_m)) lines.push_back(line);
  }
  return lines;
}

CoverOfRoofs CoverOf(const RoofTask& task) {
  const auto& [building, evidence, planes, tolerances] = task;
  CoverOfRoofs cover;
  const Eigen::AlignedBox2d box = BoxAround(building.building);
  cover.raster.cell = std::max(2 * tolerances.spacing, tolerances.level_of_detail / 2);
  cover.raster.origin = box.min();
  cover.raster.width = static_cast<int>(box.sizes().x() / cover.raster.cell) + 1;
  cover.raster.height = static_cast<int>(box.sizes().y() / cover.raster.cell) + 1;
  for (const int p : planes) {
    std::vector<char> hit(static_cast<size_t>(cover.raster.width) * cover.raster.height, 0);
    for (const int i : evidence.planes[p].points) {
      const int at = cover.raster.IndexAt(evidence.samples.positions[i].head<2>());
      if (at >= 0) hit[at] = 1;
    }
    cover.to_hit.push_back(DistancesTo(cover.raster, hit));
  }
  cover.to_open = DistancesToOpenGround(evidence, cover.raster, tolerances);
  return cover;
}

std::vector<CutLine> CreasesOf(const CoverOfRoofs& cover, const std::vector<RoofPlane>& roofs,
                               const Tolerances& tolerances) {
  std::vector<CutLine> creases;
  for (size_t a = 0; a < cover.to_hit.size(); ++a) {
    for (size_t b = a + 1; b < cover.to_hit.size(); ++b) {
      if (const auto line = MeetingLine(cover, roofs, a, b, tolerances.fill_gap)) {
        creases.push_back(*line);
      }
    }
  }
  return creases;
}

std::vector<CutLine> LinesOf(const RoofTask& task, const CoverOfRoofs& cover,
                             const std::vector<RoofPlane>& roofs) {
  LineList list(task.building.building, BoxAround(task.building.building));
  const CutLine axis = list.lines().front();
  const std::vector<CutLine> creases = CreasesOf(cover, roofs, task.tolerances);
  for (const CutLine& line : creases) list.Add(line, kSameLine_m);
  const double detail = task.tolerances.level_of_detail;
  for (const RoofStep& step : task.evidence.steps) {
    const auto normal = step.plane.normal.head<2>();
    const Eigen::Vector2d n = normal.normalized();
    list.Add({.point = n * (step.plane.offset / normal.norm()), .direction = {-n.y(), n.x()}},
             detail);
  }
  const auto add_borders = [&](const std::vector<float>& to_hit) {
    for (const CutLine& line : BordersOf(cover.raster, to_hit, axis, creases, detail)) {
      list.Add(line, detail);
    }
  };
  if (!cover.to_open.empty()) add_borders(cover.to_open);
  for (const std::vector<float>& to_hit : cover.to_hit) add_borders(to_hit);
  return list.lines();
}

std::vector<CutLine> WithCreases(const RoofTask& task, const std::vector<CutLine>& lines,
                                 const std::vector<CutLine>& creases) {
  LineList list(task.building.building, BoxAround(task.building.building));
  for (const CutLine& line : creases) list.Add(line, kSameLine_m);
  for (const CutLine& line : lines) {
    if (!line.crease) list.Add(line, kSameLine_m);
  }
  return list.lines();
}

}  // namespace stucco
