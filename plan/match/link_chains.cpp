// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/link_chains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stucco::plan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOverlap = 0.6;

// The photo that is nearest to a place on the map.
uint32_t NearestPhoto(const LinkedPhotos& photos, const Vector2d& place) {
  uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t photo = 0; photo < photos.size(); ++photo) {
    const double distance = (photos.graph().position(photo).head<2>() - place).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = photo;
  }
  return nearest;
}

// The photos at both ends hold together, and not by one stop alone.
bool IsTied(const LinkedPhotos& photos, const Segment2d& corridor) {
  const uint32_t a = NearestPhoto(photos, corridor.a), b = NearestPhoto(photos, corridor.b);
  return std::ranges::none_of(
      LooseGroups(photos.places(), photos.ties()),
      [&](const LooseGroup& group) { return group.Holds(a) != group.Holds(b); });
}

// The width of the photos lies along the line.
LinkCandidate StopAt(const Vector2d& place, const Vector2d& along, const Site& site) {
  LinkCandidate stop;
  stop.position = {place.x(), place.y(), site.CeilingAt(place)};
  stop.shot = {.yaw_rad = std::atan2(-along.y(), along.x()),
               .pitch_rad = -std::numbers::pi / 2,
               .kind = ViewKind::kLink,
               .targets = {}};
  return stop;
}

int AddChain(const Obstacles& obstacles, const Segment2d& corridor, double step_m,
             LinkedPhotos& photos) {
  const Vector2d line = corridor.b - corridor.a;
  const double stops = std::ceil(line.norm() / step_m);
  int added = 0;
  for (double k = 0; k < stops; ++k) {
    const Vector2d place = corridor.a + (k + 0.5) / stops * line;
    const LinkCandidate stop = StopAt(place, line.normalized(), obstacles.site());
    if (!obstacles.IsFree(stop.position)) continue;
    photos.Add(stop);
    ++added;
  }
  return added;
}

}  // namespace

int AddChains(const Obstacles& obstacles, LinkedPhotos& photos) {
  if (photos.size() == 0) return 0;
  const double width = 2 * photos.half_width() * obstacles.site().safe_altitude_m;
  int added = 0;
  for (const Segment2d& corridor : photos.corridors()) {
    if (IsTied(photos, corridor)) continue;
    added += AddChain(obstacles, corridor, (1 - kOverlap) * width, photos);
  }
  return added;
}

}  // namespace stucco::plan
