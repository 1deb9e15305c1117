// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/lift.h"

#include <algorithm>

namespace stucco::plan {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// How much earlier than at the margin a climb is over, so that rounding leaves the margin whole.
constexpr double kClimbSlack_m = 2e-3;

// (distance along the track, height) of points that the path may not pass below.
using Profile = std::vector<Vector2d>;

void AddCrossings(const Obstacles& obstacles, const Segment2d& segment, const Interval& levels,
                  double start_m, Profile& profile) {
  std::vector<Crossing> crossings;
  const double radius = obstacles.site().d_min_m + kSafetyMargin_m + kClimbSlack_m;
  obstacles.footprints().FindCrossings(segment, levels.from_m, radius, crossings);
  const double length = (segment.b - segment.a).norm();
  for (const Crossing& crossing : crossings) {
    if (crossing.top_m > levels.to_m) continue;
    profile.emplace_back(start_m + length * crossing.part.from_m, crossing.top_m);
    profile.emplace_back(start_m + length * crossing.part.to_m, crossing.top_m);
  }
}

// Over each piece the floor is a parabola; the three points that control it (Bezier) enclose it.
void AddFloor(const Site& site, const Segment2d& segment, double start_m, Profile& profile) {
  if (site.terrain.IsFlat()) return;
  const double length = (segment.b - segment.a).norm();
  const auto floor = [&](double t) {
    return site.FloorAt(segment.a + t * (segment.b - segment.a));
  };
  ForTerrainPieces(site.terrain, segment, [&](double from, double to) {
    const double start = floor(from);
    const double end = floor(to);
    const double control = 2 * floor(0.5 * (from + to)) - 0.5 * (start + end);
    profile.emplace_back(start_m + length * from, start);
    profile.emplace_back(start_m + length * 0.5 * (from + to), control);
    profile.emplace_back(start_m + length * to, end);
    return true;
  });
}

// The least concave function over the profile from its first point to its last.
Profile PullTight(Profile profile) {
  const Vector2d last = profile.back();
  profile.pop_back();
  std::stable_sort(profile.begin() + 1, profile.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  profile.push_back(last);
  Profile hull;
  for (const Vector2d& point : profile) {
    while (hull.size() > 1 &&
           Cross(hull.back() - hull[hull.size() - 2], point - hull.back()) >= 0) {
      hull.pop_back();
    }
    hull.push_back(point);
  }
  return hull;
}

// Puts the corners of the track back into the profile pulled tight.
std::vector<Vector3d> OnTrack(const Track& track, const std::vector<double>& at,
                              const Profile& hull) {
  std::vector<Vector3d> path;
  const auto add = [&](const Vector2d& xy, double z) { path.emplace_back(xy.x(), xy.y(), z); };
  size_t k = 0;  // the track's segment
  add(track.points.front(), hull.front().y());
  for (size_t h = 1; h < hull.size(); ++h) {
    const Vector2d& from = hull[h - 1];
    const Vector2d& to = hull[h];
    while (k + 2 < at.size() && at[k + 1] < to.x()) {
      ++k;
      if (!(at[k] > from.x())) continue;
      const double t = (at[k] - from.x()) / (to.x() - from.x());
      add(track.points[k], from.y() + t * (to.y() - from.y()));
    }
    if (h + 1 == hull.size()) break;
    const double length = at[k + 1] - at[k];
    const double t = length > 0 ? std::clamp((to.x() - at[k]) / length, 0.0, 1.0) : 0;
    add(track.points[k] + t * (track.points[k + 1] - track.points[k]), to.y());
  }
  add(track.points.back(), hull.back().y());
  return path;
}

}  // namespace

std::vector<Vector3d> Lift(const Obstacles& obstacles, const Track& track, double level_m) {
  const Interval levels{std::min(track.start_z, track.end_z), level_m};
  Profile profile{{0, track.start_z}};
  std::vector<double> at{0};
  for (size_t k = 0; k + 1 < track.points.size(); ++k) {
    const Segment2d segment{track.points[k], track.points[k + 1]};
    if (levels.to_m > levels.from_m) {
      AddCrossings(obstacles, segment, levels, at.back(), profile);
    }
    AddFloor(obstacles.site(), segment, at.back(), profile);
    at.push_back(at.back() + (segment.b - segment.a).norm());
  }
  for (Vector2d& point : profile) point.x() = std::min(point.x(), at.back());
  profile.emplace_back(at.back(), track.end_z);
  return OnTrack(track, at, PullTight(std::move(profile)));
}

double Length(const std::vector<Vector3d>& points) {
  double length = 0;
  for (size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  return length;
}

}  // namespace stucco::plan
