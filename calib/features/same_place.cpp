// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/same_place.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <set>

namespace stucco {
namespace {

// A blob that a wall is seen obliquely at is an ellipse in the photo and a disc on the wall.
constexpr float kLikeScale = 2;

bool IsOfLikeScale(const Keypoint& a, const Keypoint& b) {
  return a.scale <= kLikeScale * b.scale && b.scale <= kLikeScale * a.scale;
}

std::vector<int32_t> OrderByX(std::span<const Keypoint> keypoints) {
  std::vector<int32_t> order(keypoints.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int32_t a, int32_t b) { return keypoints[a].x < keypoints[b].x; });
  return order;
}

}  // namespace

std::vector<int32_t> FindPlaces(std::span<const Keypoint> keypoints, size_t num_plain,
                                double same_px) {
  assert(num_plain <= keypoints.size());
  const std::vector<int32_t> order = OrderByX(keypoints);
  std::vector<int32_t> place(keypoints.size());
  std::iota(place.begin(), place.end(), 0);
  for (int32_t i = 0; i < static_cast<int32_t>(keypoints.size()); ++i) {
    const Keypoint& k = keypoints[i];
    double nearest = static_cast<size_t>(i) < num_plain ? 0 : same_px;
    auto other = std::lower_bound(order.begin(), order.end(), k.x - nearest,
                                  [&](int32_t j, double x) { return keypoints[j].x < x; });
    const double end = k.x + nearest;
    for (; other != order.end() && keypoints[*other].x <= end; ++other) {
      const int32_t j = *other;
      if (j >= i || place[j] != j || !IsOfLikeScale(k, keypoints[j])) continue;
      const double apart = std::hypot(k.x - keypoints[j].x, k.y - keypoints[j].y);
      if (apart > nearest || (apart == nearest && place[i] < j)) continue;
      nearest = apart;
      place[i] = j;
    }
  }
  return place;
}

void DropRepeated(const PlacesOfPair& places, std::vector<Match>& matches) {
  std::set<Match> known;
  std::erase_if(matches, [&](const Match& match) {
    return !known.insert({places.first[match.first], places.second[match.second]}).second;
  });
}

void JoinPlaces(const PlacesOfPair& places, std::vector<Match>& matches) {
  std::vector<bool> first_taken(places.first.size(), false);
  std::vector<bool> second_taken(places.second.size(), false);
  for (Match& match : matches) match = {places.first[match.first], places.second[match.second]};
  std::erase_if(matches, [&](const Match& match) {
    if (first_taken[match.first] || second_taken[match.second]) return true;
    first_taken[match.first] = second_taken[match.second] = true;
    return false;
  });
}

}  // namespace stucco
