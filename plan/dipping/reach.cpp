// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

constexpr double kStretchM = 0.5;
constexpr double kFrontal = 0.7071;  // cosine of 45 degrees
constexpr double kNone = std::numeric_limits<double>::infinity();

struct WallObserver {
  const Candidate* candidate = nullptr;
  const Intervals* seen = nullptr;
};

size_t Stretches(const Facade& wall) {
  return std::max<size_t>(1, static_cast<size_t>(std::ceil(wall.length_m() / kStretchM)));
}

Interval Stretch(const Facade& wall, size_t index, size_t count) {
  const double step = wall.length_m() / static_cast<double>(count);
  return {step * static_cast<double>(index), step * static_cast<double>(index + 1)};
}

Vector2d MiddleOf(const Facade& wall, const Interval& stretch) {
  return wall.a + wall.along() * ((stretch.from_m + stretch.to_m) / 2);
}

bool SeesWhole(const Intervals& seen, const Interval& stretch) {
  constexpr double kRounded_m = 0.011;  // parts end on whole centimetres
  return std::any_of(seen.begin(), seen.end(), [&](const Interval& part) {
    return stretch.from_m >= part.from_m - kRounded_m && stretch.to_m <= part.to_m + kRounded_m;
  });
}

// The least distance at which the whole stretch is seen, from within 45 degrees where it is at all.
double NearestView(const Facade& wall, const std::vector<WallObserver>& observers,
                   const Interval& stretch) {
  double frontal = kNone, any = kNone;
  for (const WallObserver& observer : observers) {
    if (!SeesWhole(*observer.seen, stretch)) continue;
    const Vector2d ray = observer.candidate->position - MiddleOf(wall, stretch);
    const double distance = ray.norm();
    any = std::min(any, distance);
    if (ray.dot(wall.normal()) >= kFrontal * distance) frontal = std::min(frontal, distance);
  }
  return std::isfinite(frontal) ? frontal : any;
}

// How far from each stretch of the wall a photo may stand.
std::vector<double> LimitsOf(const Facade& wall, const std::vector<WallObserver>& observers,
                             double near_enough) {
  std::vector<double> limits(Stretches(wall));
  for (size_t i = 0; i < limits.size(); ++i) {
    const Interval stretch = Stretch(wall, i, limits.size());
    limits[i] = std::max(Reach::kFarther * NearestView(wall, observers, stretch), near_enough);
  }
  return limits;
}

}  // namespace

Reach::Reach(const DippingSetting& setting, std::span<const Candidate> candidates)
    : limits_m_(setting.site.facades.size()) {
  const Site& site = setting.site;
  std::vector<std::vector<WallObserver>> observers(site.facades.size());
  for (const Candidate& candidate : candidates) {
    for (const SeenFacade& seen : candidate.seen) {
      observers[seen.facade].push_back({&candidate, &seen.seen});
    }
  }
  ParallelFor(site.facades.size(), setting.threads, [&](size_t i) {
    if (observers[i].empty()) return;
    limits_m_[i] = LimitsOf(site.facades[i], observers[i], kNearEnough * setting.d_max_m);
  });
}

Intervals Reach::Within(int facade, const Facade& wall, const Vector2d& p, Intervals seen) const {
  if (limits_m_.empty() || limits_m_[facade].empty()) return seen;
  const std::vector<double>& limits = limits_m_[facade];
  Intervals allowed;
  for (size_t i = 0; i < limits.size(); ++i) {
    Interval stretch = Stretch(wall, i, limits.size());
    if ((p - MiddleOf(wall, stretch)).norm() > limits[i]) continue;
    // On whole centimetres, as everything that is seen.
    stretch = {std::round(stretch.from_m * 100) / 100, std::round(stretch.to_m * 100) / 100};
    if (i + 1 == limits.size()) stretch.to_m = wall.length_m();
    allowed.push_back(stretch);
  }
  return Intersection(seen, Union(std::move(allowed)));
}

}  // namespace stucco::plan
