// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/safe_space.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <queue>

#include "plan/space/lift.h"

namespace stucco::plan {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Corners stand off from what the margin forbids, so that paths along a wall pass every test.
constexpr double kCornerSlack_m = 0.01;
constexpr double kNoFlyDistance_m = 0.1;
// Sides of the polygons around arcs turn by this much at most.
constexpr double kFootprintStep_rad = std::numbers::pi / 12;
constexpr double kNoFlyStep_rad = std::numbers::pi / 4;
// Beyond this many corners between two positions their distance is hundreds of metres, where a way
// through the streets is hardly ever shorter than a climb, and the search would cost too much.
constexpr size_t kMostNodes = 2000;

// An edge of the visibility graph that may turn out to be blocked.
struct Step {
  double estimate_m = 0;  // of the whole way through it
  double length_m = 0;    // up to its end
  int from = 0;
  int to = 0;

  bool operator<(const Step& other) const {  // std::priority_queue has the largest on top
    if (estimate_m != other.estimate_m) return estimate_m > other.estimate_m;
    return to != other.to ? to > other.to : from > other.from;
  }
};

// The state of a search over the corners of obstacles; the two last are the way's end and start.
struct Search {
  std::vector<Corner> corners;  // side by side in memory: every step looks at all of them
  std::vector<int> from;        // by corner, -1: not reached
  std::vector<double> length;
  std::priority_queue<Step> open;

  int End() const { return static_cast<int>(corners.size()) - 2; }
  int Start() const { return static_cast<int>(corners.size()) - 1; }
  const Vector2d& At(int k) const { return corners[k].position; }

  // Edges from a corner to those not reached yet; nothing longer than `bound_m` in all.
  void PushSteps(int k, double bound_m) {
    for (int to = 0; to <= End(); ++to) {
      const Vector2d d = At(to) - At(k);
      if (k != Start() && !corners[k].IsTangent(d)) continue;
      if (to != End() && !corners[to].IsTangent(d)) continue;
      if (from[to] >= 0 || to == k) continue;
      const double whole = length[k] + d.norm();
      const double estimate = whole + (At(End()) - At(to)).norm();
      if (estimate < bound_m) open.push({estimate, whole, k, to});
    }
  }

  // From the start to the end, which was reached.
  std::vector<Vector2d> Track() const {
    std::vector<Vector2d> track;
    for (int k = End(); k != Start(); k = from[k]) track.push_back(At(k));
    track.push_back(At(Start()));
    std::reverse(track.begin(), track.end());
    return track;
  }
};

}  // namespace

struct SafeSpace::Query {
  Vector2d start;
  Vector2d end;
  double level_m = 0;
  double bound_m = kInfinity;
};

SafeSpace::SafeSpace(const Obstacles& obstacles) : obstacles_(&obstacles) {
  const Site& site = obstacles.site();
  for (const Footprint& footprint : site.footprints) {
    AddCorners(footprint.outline, site.d_min_m + kSafetyMargin_m + kCornerSlack_m,
               kFootprintStep_rad, footprint.blocked_to_m);
  }
  for (const Polygon& polygon : site.no_fly) {
    AddCorners(polygon, kNoFlyDistance_m, kNoFlyStep_rad, kInfinity);
  }
  std::vector<Box2> boxes(nodes_.size());
  for (size_t k = 0; k < nodes_.size(); ++k) boxes[k].Add(nodes_[k].corner.position);
  tree_ = BoxTree(boxes);
}

void SafeSpace::AddCorners(const Polygon& outline, double radius, double step_rad, double top_m) {
  const double margin = obstacles_->site().d_min_m + kSafetyMargin_m;
  for (const Corner& corner : DilatedCorners(outline, radius, step_rad)) {
    if (obstacles_->no_fly().TopWithin(corner.position, kSafetyMargin_m) == kInfinity) continue;
    const double covered_to = obstacles_->footprints().TopWithin(corner.position, margin);
    if (covered_to < top_m) nodes_.push_back({corner, {covered_to, top_m}});
  }
}

bool SafeSpace::IsClear(const Vector2d& a, const Vector2d& b, double level_m) const {
  const Vector3d p(a.x(), a.y(), level_m);
  const Vector3d q(b.x(), b.y(), level_m);
  return !obstacles_->footprints().Touches(p, q, obstacles_->site().d_min_m + kSafetyMargin_m) &&
         !obstacles_->no_fly().Touches(p, q, kSafetyMargin_m);
}

// The first way found is never too much.
bool SafeSpace::IsTooMuch(size_t nodes, const Query& query) {
  return query.bound_m < kInfinity && nodes > kMostNodes;
}

std::vector<int> SafeSpace::NodesWithin(const Query& query) const {
  std::vector<int> found;
  const double distance = (query.end - query.start).norm();
  const double half_width =
      query.bound_m < kInfinity
          ? 0.5 * std::sqrt(std::max(query.bound_m * query.bound_m - distance * distance, 0.0))
          : kInfinity;
  const Segment2d axis{query.start, query.end};
  const double half_length = query.bound_m < kInfinity ? 0.5 * query.bound_m : kInfinity;
  const double reach = std::max(half_width, half_length - 0.5 * distance);
  tree_.Any([&](const Box2& box) { return reach == kInfinity || box.MayTouch(axis, reach); },
            [&](int k) {
              const Node& node = nodes_[k];
              const Vector2d& at = node.corner.position;
              if (query.level_m >= node.levels.from_m && query.level_m < node.levels.to_m &&
                  (at - query.start).norm() + (at - query.end).norm() < query.bound_m) {
                found.push_back(k);
              }
              return IsTooMuch(found.size(), query);
            });
  std::sort(found.begin(), found.end());
  return found;
}

// A* with edges tested when they come up: an edge waits with the length that it would give, and the
// first free one that arrives at a node is the shortest.
std::optional<std::vector<Vector2d>> SafeSpace::FindTrack(const Query& query) const {
  if (!((query.end - query.start).norm() < query.bound_m)) return std::nullopt;
  if (IsClear(query.start, query.end, query.level_m)) return {{query.start, query.end}};
  if (!IsClear(query.start, query.start, query.level_m)) return std::nullopt;
  if (!IsClear(query.end, query.end, query.level_m)) return std::nullopt;
  const std::vector<int> nodes = NodesWithin(query);
  if (nodes.empty() || IsTooMuch(nodes.size(), query)) return std::nullopt;
  Search search;
  search.corners.reserve(nodes.size() + 2);
  for (const int k : nodes) search.corners.push_back(nodes_[k].corner);
  search.corners.push_back({query.end, {}, {}});
  search.corners.push_back({query.start, {}, {}});
  search.from.assign(search.corners.size(), -1);
  search.length.assign(search.corners.size(), kInfinity);
  const int end = search.End();
  search.length[search.Start()] = 0;
  search.from[search.Start()] = search.Start();
  search.PushSteps(search.Start(), query.bound_m);
  while (!search.open.empty() && search.from[end] < 0) {
    const Step step = search.open.top();
    search.open.pop();
    if (search.from[step.to] >= 0) continue;
    if (!IsClear(search.At(step.from), search.At(step.to), query.level_m)) continue;
    search.from[step.to] = step.from;
    search.length[step.to] = step.length_m;
    if (step.to != end) search.PushSteps(step.to, query.bound_m);
  }
  if (search.from[end] < 0) return std::nullopt;
  return search.Track();
}

std::optional<Route> SafeSpace::ShortestRoute(const Vector3d& p, const Vector3d& q) const {
  if (!obstacles_->IsFree(p) || !obstacles_->IsFree(q)) return std::nullopt;
  if (obstacles_->IsFreeBetween(p, q)) return Route{{p, q}, (q - p).norm()};
  const double rise = q.z() - p.z();
  std::optional<Route> best;
  const auto try_level = [&](double level_m) {
    Query query{p.head<2>(), q.head<2>(), level_m};
    if (best) {
      const double squared = best->length_m * best->length_m - rise * rise;
      query.bound_m = std::sqrt(std::max(squared, 0.0));
    }
    const auto track = FindTrack(query);
    if (!track) return;
    Route route{Lift(*obstacles_, {*track, p.z(), q.z()}, level_m), 0};
    route.length_m = Length(route.points);
    if (best && !(route.length_m < best->length_m)) return;
    for (size_t k = 1; k < route.points.size(); ++k) {
      if (!obstacles_->IsFreeBetween(route.points[k - 1], route.points[k])) return;
    }
    best = std::move(route);
  };
  try_level(std::numeric_limits<double>::max());  // below no-fly polygons, above all else
  try_level(std::min(p.z(), q.z()));
  if (rise != 0) try_level(std::max(p.z(), q.z()));
  return best;
}

double SafeSpace::Distance(const Vector3d& p, const Vector3d& q) const {
  const auto route = ShortestRoute(p, q);
  return route ? route->length_m : kInfinity;
}

}  // namespace stucco::plan
