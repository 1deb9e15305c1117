// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/registration.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "proxy/map/facade_ids.h"
#include "proxy/map/ground_around.h"
#include "site/box_grid.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr double kSinOfWall = 0.26;     // 15 degrees
constexpr double kTraceCell_m = 0.5;    // about a window's width: finer tells no more of a shift
constexpr size_t kEnoughTraces = 6000;  // to tell a turn by
constexpr double kLeastHeight_m = 1;    // of what stands upright in a cell
constexpr double kBesideCloud_m = 10;   // facades with no point this near were not flown

// Samples of one cell of the ground plan that look the same way.
struct Pile {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  int count = 0;
};

std::vector<Segment2d> TracesOf(const Samples& upright, double cell) {
  constexpr int kDirections = 8;
  std::map<std::tuple<int, int, int>, Pile> piles;
  for (size_t i = 0; i < upright.size(); ++i) {
    if (!LooksLikeWall(upright.normals[i])) continue;
    const Eigen::Vector3d& p = upright.positions[i];
    const Eigen::Vector2d outwards = upright.normals[i].head<2>();
    const double turn = std::atan2(outwards.y(), outwards.x()) / (2 * std::numbers::pi);
    const int direction = static_cast<int>(std::floor(turn * kDirections + 0.5));
    Pile& pile = piles[{static_cast<int>(std::floor(p.x() / cell)),
                        static_cast<int>(std::floor(p.y() / cell)),
                        (direction + kDirections) % kDirections}];
    pile.position += p.head<2>();
    pile.outwards += outwards;
    pile.low = std::min(pile.low, p.z());
    pile.high = std::max(pile.high, p.z());
    ++pile.count;
  }
  std::vector<Segment2d> traces;
  for (const auto& [key, pile] : piles) {
    if (pile.high - pile.low < kLeastHeight_m || !(pile.outwards.norm() > 0)) continue;
    const Eigen::Vector2d middle = pile.position / pile.count;
    const Eigen::Vector2d outwards = pile.outwards.normalized();
    const Eigen::Vector2d half = cell / 2 * Eigen::Vector2d(-outwards.y(), outwards.x());
    traces.push_back({middle - half, middle + half});
  }
  return traces;
}

// The facades that the cloud comes near to.
std::vector<Segment2d> FacadesInCloud(const Samples& upright, const OutlineMap& map) {
  const auto cell_of = [](const Eigen::Vector2d& p) {
    return std::pair(static_cast<int>(std::floor(p.x() / kBesideCloud_m)),
                     static_cast<int>(std::floor(p.y() / kBesideCloud_m)));
  };
  std::set<std::pair<int, int>> seen;
  for (const Eigen::Vector3d& p : upright.positions) {
    const auto [x, y] = cell_of(p.head<2>());
    seen.insert({x, y});
  }
  std::vector<Segment2d> facades;
  for (const Facade& facade : map.facades) {
    const auto [x, y] = cell_of((facade.a + facade.b) / 2);
    bool near = false;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) near = near || seen.contains({x + dx, y + dy});
    }
    if (near) facades.push_back({facade.a, facade.b});
  }
  return facades;
}

// The facade that a piece of wall may be of, and how far outside of it the piece lies.
struct NearFacade {
  size_t facade = 0;
  double distance = 0;
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
};

// The nearest one; nothing within reach.
std::optional<NearFacade> FacadeBeside(const Segment2d& trace,
                                       const std::vector<Segment2d>& facades, double reach) {
  constexpr double kLeastCosine = 0.94;  // 20 degrees
  const Eigen::Vector2d middle = (trace.a + trace.b) / 2;
  const Eigen::Vector2d outwards = OutwardsOf(trace);
  std::optional<NearFacade> best;
  for (size_t f = 0; f < facades.size(); ++f) {
    const Eigen::Vector2d n = OutwardsOf(facades[f]);
    const double distance = n.dot(middle - facades[f].a);
    if (!(std::abs(distance) < reach) || !(n.dot(outwards) > kLeastCosine)) continue;
    if (best && std::abs(best->distance) <= std::abs(distance)) continue;
    if (Distance(facades[f], middle) > reach) continue;
    best = {f, distance, n};
  }
  return best;
}

// Least squares over shift and turn on what the traces have beside them, as far as facades of a
// map may be off by themselves. Pieces of one facade are no independent witnesses: all of them
// together weigh as much as their facade, against the prior of the turn.
void Refine(const std::vector<Segment2d>& traces, const std::vector<Segment2d>& facades,
            LevelMotion& motion) {
  constexpr std::array kReaches_m = {2.5, 2.5, 2.0, 2.0, 1.5, 1.5, 1.5, 1.5};
  constexpr double kFacadeSigma_m = 0.5;
  constexpr double kTurnSigma_rad = 0.005;  // 0.3 degrees: GPS over a site, grid north
  constexpr double kShiftSigma_m = 10;      // only what nothing else holds
  for (const double reach : kReaches_m) {
    const Eigen::Isometry2d moved = motion.Transform();
    std::vector<Segment2d> lines;
    lines.reserve(facades.size());
    for (const Segment2d& facade : facades) lines.push_back({moved * facade.a, moved * facade.b});
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double total = 0;
    std::set<size_t> matched;
    for (const Segment2d& trace : traces) {
      const auto beside = FacadeBeside(trace, lines, reach);
      if (!beside) continue;
      const double weight = std::pow(1 - std::pow(beside->distance / reach, 2), 2);
      const Eigen::Vector3d row = motion.RowOf(beside->outwards, (trace.a + trace.b) / 2);
      normal += weight * row * row.transpose();
      right += weight * beside->distance * row;
      total += weight;
      matched.insert(beside->facade);
    }
    if (!(total > 0)) return;
    const double trust =
        static_cast<double>(matched.size()) / (total * kFacadeSigma_m * kFacadeSigma_m);
    normal *= trust;
    right *= trust;
    normal.diagonal().head<2>().array() += 1 / (kShiftSigma_m * kShiftSigma_m);
    normal(2, 2) += 1 / (kTurnSigma_rad * kTurnSigma_rad);
    right.z() -= motion.turn_rad / (kTurnSigma_rad * kTurnSigma_rad);
    const Eigen::Vector3d step = normal.inverse() * right;
    motion.shift += step.head<2>();
    motion.turn_rad += step.z();
  }
}

// Of a town so many that are spread over it.
std::vector<Segment2d> EnoughOf(const std::vector<Segment2d>& traces) {
  if (traces.size() <= kEnoughTraces) return traces;
  std::vector<Segment2d> some;
  some.reserve(kEnoughTraces);
  for (size_t i = 0; i < kEnoughTraces; ++i) {
    some.push_back(traces[i * traces.size() / kEnoughTraces]);
  }
  return some;
}

// The motion that brings the facades onto what stands upright, or nothing where they do not match.
std::optional<LevelMotion> MotionOnto(const std::vector<Segment2d>& traces,
                                      const std::vector<Segment2d>& facades) {
  const auto shift = FindShift(traces, facades);
  if (!shift) return std::nullopt;
  LevelMotion motion;
  motion.shift = *shift;
  for (const Segment2d& facade : facades) motion.center += (facade.a + facade.b) / 2;
  motion.center /= static_cast<double>(facades.size());
  Refine(EnoughOf(traces), facades, motion);
  return motion;
}

double LengthOf(const std::vector<Segment2d>& lines) {
  double length = 0;
  for (const Segment2d& line : lines) length += (line.b - line.a).norm();
  return length;
}

// No photos, and walls hardly anywhere: chimneys and the edges of roofs match any map somewhere.
bool IsScanFromAbove(const Samples& upright, const std::vector<Segment2d>& traces,
                     const std::vector<Segment2d>& facades) {
  constexpr double kFewWalls = 0.25;  // of the facades, by length
  return upright.camera_centers.empty() && LengthOf(traces) < kFewWalls * LengthOf(facades);
}

// Cells of a metre that the cloud shows, raised above the ground or not.
struct RaisedCells {
  int seen = 0;
  int raised = 0;
  double Share() const { return seen == 0 ? 0 : static_cast<double>(raised) / seen; }
};

using CellTops = std::map<std::pair<int, int>, double>;

// The highest sample of each cell of a metre in and around a building.
CellTops TopsAround(const UprightSurvey& survey, const MapBuilding& building) {
  CellTops tops;
  for (const int i : survey.bins.In(BoundsOf(building, kRing_m))) {
    const Eigen::Vector3d& p = survey.samples.positions[i];
    const auto [cell, added] = tops.try_emplace(
        {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))}, p.z());
    if (!added) cell->second = std::max(cell->second, p.z());
  }
  return tops;
}

// The floors of a map, to ask where one stands.
class Floors {
 public:
  // `buildings` outlives it.
  explicit Floors(const std::vector<MapBuilding>& buildings)
      : buildings_(buildings), grid_(Bounds(buildings), kCell_m) {}

  bool Hold(const Eigen::Vector2d& p) const {
    return std::ranges::any_of(grid_.Touching({p, p}),
                               [&](int b) { return DistanceTo(buildings_[b], p) == 0; });
  }

 private:
  static constexpr double kCell_m = 30;  // about a building

  static std::vector<Eigen::AlignedBox2d> Bounds(const std::vector<MapBuilding>& buildings) {
    std::vector<Eigen::AlignedBox2d> bounds;
    bounds.reserve(buildings.size());
    for (const MapBuilding& building : buildings) bounds.push_back(BoundsOf(building, 0));
    return bounds;
  }

  const std::vector<MapBuilding>& buildings_;
  BoxGrid grid_;
};

// Of each building inside and beside, but not in a neighbour.
struct RaisedShares {
  RaisedCells inside, outside;
  // Also of buildings beside which no ground shows.
  int all_inside = 0, all_outside = 0;
};

RaisedShares CountRaised(const UprightSurvey& survey, const std::vector<MapBuilding>& buildings) {
  constexpr double kInside_m = 0.5;  // the wall's own points are neither
  constexpr double kNear_m = 1.5;    // eaves and hedges beside a wall say nothing
  RaisedShares shares;
  const Floors floors(buildings);
  for (const MapBuilding& building : buildings) {
    const auto ground = GroundAround(survey, building);
    const auto slope = SlopeAround(survey, building);
    for (const auto& [cell, height] : TopsAround(survey, building)) {
      const Eigen::Vector2d middle(cell.first + 0.5, cell.second + 0.5);
      const double to_outline = ToOutline(building, middle);
      const bool within = DistanceTo(building, middle) == 0;
      if (within ? to_outline < kInside_m : to_outline < kNear_m || to_outline > kRing_m) continue;
      if (!within && floors.Hold(middle)) continue;
      ++(within ? shares.all_inside : shares.all_outside);
      if (!ground) continue;
      RaisedCells& cells = within ? shares.inside : shares.outside;
      ++cells.seen;
      const bool on_slope = slope && slope->Shows({middle.x(), middle.y(), height});
      cells.raised += height > *ground + kRaised_m && !on_slope;
    }
  }
  return shares;
}

}  // namespace

bool LooksLikeWall(const Eigen::Vector3d& normal) {
  return std::abs(normal.z()) < kSinOfWall && normal.squaredNorm() > 0.25;
}

std::vector<Segment2d> WallTraces(const Samples& upright) {
  return TracesOf(upright, std::max(kTraceCell_m, upright.cell));
}

MapRegistration RegisterMap(const UprightSurvey& survey, const OutlineMap& map) {
  const Samples& upright = survey.samples;
  MapRegistration found;
  const std::vector<Segment2d> traces = WallTraces(upright);
  const std::vector<Segment2d> facades = FacadesInCloud(upright, map);
  if (!IsScanFromAbove(upright, traces, facades)) {
    const auto motion = MotionOnto(traces, facades);
    if (!motion) {
      found.refused = "what stands upright in the cloud is not where the map has walls";
      return found;
    }
    found.survey_from_map = motion->Transform();
    found.turn_rad = motion->turn_rad;
    found.shift_m = motion->shift;
    found.measured = true;
  }
  std::vector<MapBuilding> buildings;
  buildings.reserve(map.buildings.size());
  for (const MapBuilding& building : map.buildings) {
    buildings.push_back(Moved(building, found.survey_from_map));
  }
  const RaisedShares shares = CountRaised(survey, buildings);
  const auto& [inside, outside, all_inside, all_outside] = shares;
  found.raised_inside = inside.Share();
  found.raised_outside = outside.Share();
  constexpr int kFewestCells = 20;  // photos from the street show no roof, and prove nothing here
  constexpr double kLeastRaised = 0.6;
  constexpr double kLeastContrast = 0.3;
  constexpr double kLeastBeside = 0.05;  // of what a scan shows of roofs; eaves may be as much
  if (upright.camera_centers.empty() && all_outside < kLeastBeside * all_inside) {
    found.refused =
        "the cloud shows nothing beside the buildings: without the ground nobody knows how high "
        "its roofs are; take a cloud with its ground points";
  } else if (inside.seen >= kFewestCells && !(inside.Share() >= kLeastRaised &&
                                              inside.Share() - outside.Share() >= kLeastContrast)) {
    found.refused = fmt::format(
        "of the ground below its buildings {:.0f} % is built over, of that next to them {:.0f} %",
        100 * inside.Share(), 100 * outside.Share());
  }
  return found;
}

}  // namespace stucco
