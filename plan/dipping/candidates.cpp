// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/candidates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "plan/dipping/wall_view.h"
#include "site/incidence.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

constexpr double kGridM = 6;  // of regular points
constexpr double kRayStep = 1.5 * std::numbers::pi / 180;
constexpr double kWallStepM = 1;        // between the rays' starting points on unseen walls
constexpr double kClearOfLineM = 0.05;  // how far beyond the border of the zone a point is put
constexpr size_t kBlock = 64;           // points looked at as one piece of work

// Points of a lattice over the area's bounding box.
std::vector<Vector2d> GridPoints(const Site& site) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Ring& ring : site.area.rings) {
    for (const Vector2d& corner : ring) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  std::vector<Vector2d> points;
  for (double y = low.y() + kGridM / 2; y < high.y(); y += kGridM) {
    for (double x = low.x() + kGridM / 2; x < high.x(); x += kGridM) points.emplace_back(x, y);
  }
  return points;
}

// `count` points evenly in front of the wall.
void AddRow(const Facade& facade, double distance, int count, std::vector<Vector2d>& points) {
  for (int i = 0; i < count; ++i) {
    const double along = facade.length_m() * (i + 0.5) / count;
    points.push_back(facade.a + facade.along() * along + facade.normal() * distance);
  }
}

// In front of the wall, as near as allowed: as few as photos from there need, and twice as many for
// where something stands in the way; twice and four times as far for walls whose front is not free.
std::vector<Vector2d> FrontalPoints(const Facade& facade, const DippingSetting& setting) {
  std::vector<Vector2d> points;
  for (const double distance :
       {setting.d_min_m + kClearOfLineM, 2 * setting.d_min_m, 4 * setting.d_min_m}) {
    if (distance > setting.d_max_m) break;
    const double photos = facade.length_m() / ((1 - kOverlap) * setting.width_per_m * distance);
    const int few = std::max(1, static_cast<int>(std::ceil(photos)));
    AddRow(facade, distance, few, points);
    AddRow(facade, distance, 2 * few, points);
  }
  return points;
}

// Which of the points may be used, with what they see, in their order.
std::vector<Candidate> LookFrom(const Level& level, const DippingSetting& setting,
                                const std::vector<Vector2d>& points) {
  std::vector<Candidate> all(points.size());
  ParallelFor((points.size() + kBlock - 1) / kBlock, setting.threads, [&](size_t block) {
    for (size_t i = block * kBlock; i < std::min(points.size(), (block + 1) * kBlock); ++i) {
      all[i].position = points[i];
      if (MayDip(level, setting, points[i])) all[i].seen = SeenFrom(level, setting, points[i]);
    }
  });
  std::erase_if(all, [](const Candidate& candidate) { return candidate.seen.empty(); });
  return all;
}

std::vector<Intervals> UnseenParts(const Level& level, const DippingSetting& setting,
                                   const std::vector<Candidate>& candidates) {
  std::vector<Intervals> seen(setting.site.facades.size());
  for (const Candidate& candidate : candidates) {
    for (const SeenFacade& part : candidate.seen) {
      seen[part.facade].insert(seen[part.facade].end(), part.seen.begin(), part.seen.end());
    }
  }
  std::vector<Intervals> unseen(setting.site.facades.size());
  for (const int facade : level.facades) {
    unseen[facade] =
        Gaps(Union(std::move(seen[facade])), {0, setting.site.facades[facade].length_m()});
  }
  return unseen;
}

// The first allowed point on the ray from a wall, if there is one before it meets another wall. The
// distance to the zone's border grows by at most one metre a metre, so the steps miss nothing but
// openings narrower than kClearOfLineM.
std::optional<Vector2d> FirstAllowed(const Level& level, const DippingSetting& setting,
                                     const Vector2d& from, const Vector2d& direction) {
  const double end = level.visibility.FirstHit(from, direction, setting.d_max_m);
  double at = kClearOfLineM;
  while (at < end) {
    const Vector2d p = from + direction * at;
    const double distance = setting.obstacles.HorizontalDistance(p, LowestAt(level, setting, p));
    if (distance > setting.d_min_m) {
      if (MayDip(level, setting, p)) return p;
      at += 1;  // a no-fly polygon
    } else {
      at += setting.d_min_m - distance + kClearOfLineM;
    }
  }
  return std::nullopt;
}

// Far fewer rays than are followed give points that differ: the first in each square metre stands
// for the others, of each stretch of wall apart.
struct SquareMetres {
  std::set<std::pair<int, int>> taken;
  bool Take(const Vector2d& p) {
    return taken.emplace(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())))
        .second;
  }
};

std::vector<Vector2d> PointsThatSee(const Level& level, const DippingSetting& setting,
                                    const Facade& facade, const Intervals& parts) {
  std::vector<Vector2d> points;
  for (const Interval& part : parts) {
    const int samples = static_cast<int>(part.length_m() / kWallStepM) + 1;
    for (int i = 0; i < samples; ++i) {
      const double along = part.from_m + part.length_m() * (i + 0.5) / samples;
      const Vector2d x = facade.a + facade.along() * along;
      SquareMetres squares;
      for (double turn = -kMaxIncidence_rad + kRayStep / 2; turn < kMaxIncidence_rad;
           turn += kRayStep) {
        const Vector2d ray = -Direction(facade, turn);
        const auto p = FirstAllowed(level, setting, x, ray);
        if (p && squares.Take(*p)) points.push_back(*p);
      }
    }
  }
  return points;
}

}  // namespace

std::vector<Candidate> FindCandidates(const Level& level, const DippingSetting& setting) {
  std::vector<Vector2d> points = GridPoints(setting.site);
  for (const int facade : level.facades) {
    const std::vector<Vector2d> frontal = FrontalPoints(setting.site.facades[facade], setting);
    points.insert(points.end(), frontal.begin(), frontal.end());
  }
  std::vector<Candidate> candidates = LookFrom(level, setting, points);

  const std::vector<Intervals> unseen = UnseenParts(level, setting, candidates);
  std::vector<std::vector<Vector2d>> found(level.facades.size());
  ParallelFor(level.facades.size(), setting.threads, [&](size_t i) {
    const int facade = level.facades[i];
    found[i] = PointsThatSee(level, setting, setting.site.facades[facade], unseen[facade]);
  });
  points.clear();
  for (const std::vector<Vector2d>& some : found) {
    points.insert(points.end(), some.begin(), some.end());
  }
  std::vector<Candidate> more = LookFrom(level, setting, points);
  std::move(more.begin(), more.end(), std::back_inserter(candidates));
  return candidates;
}

void LimitReach(const DippingSetting& setting, Level& level, std::vector<Candidate>& candidates) {
  level.reach = Reach(setting, candidates);
  ParallelFor(candidates.size(), setting.threads, [&](size_t i) {
    Candidate& candidate = candidates[i];
    for (SeenFacade& seen : candidate.seen) {
      seen.seen = level.reach.Within(seen.facade, setting.site.facades[seen.facade],
                                     candidate.position, std::move(seen.seen));
    }
    std::erase_if(candidate.seen, [](const SeenFacade& seen) { return seen.seen.empty(); });
  });
  std::erase_if(candidates, [](const Candidate& candidate) { return candidate.seen.empty(); });
}

}  // namespace stucco::plan
