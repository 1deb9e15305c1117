// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/cover_stops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

using Eigen::Vector3d;

// Places nearer to each other serve the same photos.
constexpr double kCell_m = 2;
// What a photo shows is no point: some of its walls may be near in direction and scale where its
// middle is not.
constexpr double kSpareAngle_rad = 0.1;
constexpr double kSpareRatio = 1.1;
// Of photos towards this much the same way one is enough: frames are far wider.
constexpr double kOneLook_rad = 0.21;

// A photo of a facade that lacks close partners.
struct Asking {
  uint32_t photo = 0;
  Gaze gaze;
};

std::vector<Asking> AskingOf(const LinkedPhotos& photos) {
  std::vector<Asking> out;
  for (uint32_t photo = 0; photo < photos.size(); ++photo) {
    if (photos.LacksClose(photo) > 0) out.push_back({photo, {}});
  }
  ParallelFor(out.size(), photos.threads(),
              [&](size_t i) { out[i].gaze = photos.GazeOf(out[i].photo, true); });
  std::erase_if(out, [](const Asking& one) { return !(one.gaze.distance_m > 0); });
  return out;
}

// Photos that ask, by where they look.
class AskingIndex {
 public:
  explicit AskingIndex(std::vector<Asking> asking) : asking_(std::move(asking)) {
    std::ranges::stable_sort(asking_, {}, XOf);
    for (const Asking& one : asking_) {
      reach_m_ = std::max(reach_m_, kSpareRatio * kCloseRatio * one.gaze.distance_m);
    }
  }
  // Those that a photo from there may be near to in direction and scale, ascending.
  std::vector<uint32_t> Near(const Vector3d& position) const {
    static const double least_cosine = std::cos(kCloseAngle_rad + kSpareAngle_rad);
    std::vector<uint32_t> out;
    const auto first = std::ranges::lower_bound(asking_, position.x() - reach_m_, {}, XOf);
    for (auto at = first; at != asking_.end() && XOf(*at) <= position.x() + reach_m_; ++at) {
      const Vector3d ray = position - at->gaze.middle;
      const double distance = ray.norm();
      if (distance > kSpareRatio * kCloseRatio * at->gaze.distance_m) continue;
      if (at->gaze.distance_m > kSpareRatio * kCloseRatio * distance) continue;
      if (ray.dot(at->gaze.way) >= least_cosine * distance) out.push_back(at->photo);
    }
    std::ranges::sort(out);
    return out;
  }

 private:
  static double XOf(const Asking& one) { return one.gaze.middle.x(); }
  std::vector<Asking> asking_;
  double reach_m_ = 0;
};

// Each place once; those of hovers first.
std::vector<CoverStop> Distinct(const std::vector<std::vector<LinkCandidate>>& found) {
  std::vector<CoverStop> out;
  std::set<std::array<int, 3>> cells;
  std::set<int> hovers;
  for (const LinkPlace place : {LinkPlace::kHover, LinkPlace::kColumn, LinkPlace::kOwn}) {
    for (const std::vector<LinkCandidate>& candidates : found) {
      for (const LinkCandidate& one : candidates) {
        if (one.place != place) continue;
        const Eigen::Vector3i cell = (one.position / kCell_m).array().floor().cast<int>();
        const bool is_new = place == LinkPlace::kHover
                                ? hovers.insert(one.hover).second
                                : cells.insert({cell.x(), cell.y(), cell.z()}).second;
        if (is_new) out.push_back({one.position, place, one.hover, {}, {}});
      }
    }
  }
  return out;
}

// The ways in which photos look at these middles, those that nearly agree as their mean.
std::vector<Vector3d> Looks(const Vector3d& from, std::span<const Vector3d> middles) {
  static const double one_look = std::cos(kOneLook_rad);
  std::vector<Vector3d> sums;
  for (const Vector3d& middle : middles) {
    const Vector3d way = (middle - from).normalized();
    const auto same = std::ranges::find_if(
        sums, [&](const Vector3d& sum) { return sum.normalized().dot(way) >= one_look; });
    if (same == sums.end()) {
      sums.push_back(way);
    } else {
      *same += way;
    }
  }
  return sums;
}

}  // namespace

std::vector<CoverStop> CoverStops(const Obstacles& obstacles, const LinkedPhotos& photos) {
  const std::vector<Asking> asking = AskingOf(photos);
  std::vector<std::vector<LinkCandidate>> found(asking.size());
  ParallelFor(asking.size(), photos.threads(), [&](size_t i) {
    found[i] = LinkCandidates(asking[i].gaze, obstacles, photos.hovers(),
                              static_cast<int>(photos.HoverOf(asking[i].photo)));
  });
  std::vector<CoverStop> out = Distinct(found);
  const AskingIndex index(asking);
  ParallelFor(out.size(), photos.threads(),
              [&](size_t i) { out[i].within = index.Near(out[i].position); });
  return out;
}

std::vector<CoverShot> CoverShots(const LinkedPhotos& photos, const CoverStop& stop) {
  std::vector<Vector3d> middles;
  for (const uint32_t photo : stop.within) middles.push_back(photos.GazeOf(photo, true).middle);
  std::vector<CoverShot> out;
  for (const Vector3d& look : Looks(stop.position, middles)) {
    CoverShot one{LinkShot(look), {}};
    const std::vector<Sight> sights = photos.SightsFrom(stop.position, one.shot);
    for (const uint32_t photo : stop.within) {
      if (photos.IsCloseTo(photo, sights)) one.served.push_back(photo);
    }
    if (!one.served.empty()) out.push_back(std::move(one));
  }
  return out;
}

}  // namespace stucco::plan
