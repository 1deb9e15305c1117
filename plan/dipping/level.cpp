// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "plan/dipping/wall_view.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

// Walls whose feet differ by less share a level: about a storey.
constexpr double kStoreyM = 3;
constexpr double kTouchM = 0.1;
constexpr double kOnLineM = 0.002;  // twice the grid that cleaned maps are rounded to
constexpr double kLeastPieceM = 0.05;
constexpr double kRoomM = 0.2;
constexpr std::array<std::array<double, 2>, 4> kAround = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

// The stretches of the edge from a to b that none of these facades covers.
Intervals Uncovered(const Site& site, const std::vector<int>& facades, const Vector2d& a,
                    const Vector2d& b) {
  const double length = (b - a).norm();
  const Vector2d along = (b - a) / length, normal(along.y(), -along.x());
  Intervals covered;
  for (const int index : facades) {
    const Facade& facade = site.facades[index];
    const bool on_line = std::abs((facade.a - a).dot(normal)) < kOnLineM &&
                         std::abs((facade.b - a).dot(normal)) < kOnLineM;
    const Interval part{(facade.a - a).dot(along), (facade.b - a).dot(along)};
    if (on_line && part.from_m < part.to_m) {
      covered.push_back({part.from_m - kOnLineM, part.to_m + kOnLineM});
    }
  }
  return Gaps(Union(std::move(covered)), {0, length});
}

// The facades of the level on this footprint, and the rest of its contour, which only blocks.
void AddWalls(const Site& site, int footprint, const std::vector<int>& facades,
              std::vector<MapWall>& walls) {
  for (const int facade : facades) {
    walls.push_back({site.facades[facade].a, site.facades[facade].b, facade});
  }
  for (const Ring& ring : site.footprints[footprint].outline.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const Vector2d along = (b - a).normalized();
      for (const Interval& rest : Uncovered(site, facades, a, b)) {
        walls.push_back({rest.from_m == 0 ? a : Vector2d(a + along * rest.from_m),
                         rest.to_m == (b - a).norm() ? b : Vector2d(a + along * rest.to_m), -1});
      }
    }
  }
}

Level MakeLevel(const Site& site, std::vector<int> facades) {
  double bottom = site.facades[facades.front()].z_m.from_m, top_of_feet = bottom;
  std::map<int, std::vector<int>> by_footprint;
  for (const int facade : facades) {
    bottom = std::min(bottom, site.facades[facade].z_m.from_m);
    top_of_feet = std::max(top_of_feet, site.facades[facade].z_m.from_m);
    by_footprint[site.facades[facade].footprint].push_back(facade);
  }
  std::vector<MapWall> walls;
  for (size_t i = 0; i < site.footprints.size(); ++i) {
    const auto own = by_footprint.find(static_cast<int>(i));
    if (own != by_footprint.end()) {
      AddWalls(site, static_cast<int>(i), own->second, walls);
    } else if (site.footprints[i].z_m.to_m > bottom + kTouchM) {
      AddWalls(site, static_cast<int>(i), {}, walls);
    }
  }
  return {bottom, true, std::move(facades), Visibility(std::move(walls)), {}};
}

}  // namespace

std::vector<Level> SplitIntoLevels(const Site& site) {
  std::vector<int> ground;
  std::vector<int> raised;
  for (size_t i = 0; i < site.facades.size(); ++i) {
    const Facade& facade = site.facades[i];
    const Vector2d middle = (facade.a + facade.b) / 2 + facade.normal();
    const bool is_raised =
        facade.z_m.from_m > site.terrain.HighestAround(middle, facade.length_m()) + kStoreyM;
    (is_raised ? raised : ground).push_back(static_cast<int>(i));
  }
  std::vector<Level> levels;
  if (!ground.empty()) levels.push_back(MakeLevel(site, std::move(ground)));
  std::stable_sort(raised.begin(), raised.end(), [&](int i, int j) {
    return site.facades[i].z_m.from_m < site.facades[j].z_m.from_m;
  });
  for (size_t i = 0; i < raised.size();) {
    const double bottom = site.facades[raised[i]].z_m.from_m;
    std::vector<int> facades;
    for (; i < raised.size() && site.facades[raised[i]].z_m.from_m < bottom + kStoreyM; ++i) {
      facades.push_back(raised[i]);
    }
    std::sort(facades.begin(), facades.end());
    levels.push_back(MakeLevel(site, std::move(facades)));
    levels.back().on_ground = false;
  }
  return levels;
}

double LowestAt(const Level& level, const DippingSetting& setting, const Vector2d& p) {
  const double floor = setting.site.FloorAt(p);
  return level.on_ground ? floor : std::max(floor, level.bottom_m + setting.d_min_m);
}

bool MayDip(const Level& level, const DippingSetting& setting, const Vector2d& p) {
  const double lowest = LowestAt(level, setting, p);
  const Interval z{lowest, std::max(lowest, setting.site.CeilingAt(p))};
  if (!setting.obstacles.IsFree(p, z)) return false;
  // A point on the very border of a no-fly polygon is free, but no path leads there.
  return setting.site.no_fly.empty() ||
         std::all_of(kAround.begin(), kAround.end(), [&](const std::array<double, 2>& d) {
           return setting.obstacles.IsFree(p + kRoomM * Vector2d(d[0], d[1]), z);
         });
}

std::vector<SeenFacade> SeenFrom(const Level& level, const DippingSetting& setting,
                                 const Vector2d& p) {
  std::vector<SeenFacade> all = level.visibility.From(p, setting.d_max_m);
  std::vector<SeenFacade> result;
  for (SeenFacade& seen : all) {
    const Facade& facade = setting.site.facades[seen.facade];
    const Interval frontal = FrontalWindow(facade, p);
    Intervals kept;
    for (const Interval& part : Intersection(seen.seen, frontal)) {
      const Interval rounded{std::ceil(part.from_m * 100) / 100, std::floor(part.to_m * 100) / 100};
      if (rounded.length_m() >= kLeastPieceM) kept.push_back(rounded);
    }
    kept = level.reach.Within(seen.facade, facade, p, std::move(kept));
    if (!kept.empty()) result.push_back({seen.facade, std::move(kept)});
  }
  return result;
}

}  // namespace stucco::plan
