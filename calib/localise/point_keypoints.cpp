// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/localise/point_keypoints.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace stucco {

std::vector<PointId> PointsOfKeypoints(const std::vector<Keypoint>& keypoints,
                                       const RegisteredImage& image, double reach_px) {
  std::vector<const Observation*> by_x;
  for (const Observation& observation : image.observations) {
    if (observation.point.IsValid()) by_x.push_back(&observation);
  }
  const auto x_of = [](const Observation* observation) { return observation->pixel.x(); };
  std::ranges::stable_sort(by_x, {}, x_of);
  std::vector<PointId> points(keypoints.size());
  for (size_t i = 0; i < keypoints.size(); ++i) {
    const Eigen::Vector2d pixel(keypoints[i].x, keypoints[i].y);
    double nearest = reach_px * reach_px;
    for (auto it = std::ranges::lower_bound(by_x, pixel.x() - reach_px, {}, x_of);
         it != by_x.end() && (*it)->pixel.x() <= pixel.x() + reach_px; ++it) {
      const double distance = ((*it)->pixel - pixel).squaredNorm();
      if (distance > nearest || (points[i].IsValid() && distance == nearest)) continue;
      nearest = distance;
      points[i] = (*it)->point;
    }
  }
  return points;
}

std::vector<PointVote> MostVoted(const std::vector<PointVote>& votes) {
  std::map<std::pair<int, PointId>, int> counts;
  for (const PointVote& vote : votes) ++counts[{vote.keypoint, vote.point}];
  std::vector<std::tuple<int, int, PointId>> ranked;  // (minus votes, keypoint, point)
  ranked.reserve(counts.size());
  for (const auto& [which, count] : counts) ranked.emplace_back(-count, which.first, which.second);
  std::ranges::sort(ranked);
  std::set<int> keypoints;
  std::set<PointId> points;
  std::vector<PointVote> chosen;
  for (const auto& [count, keypoint, point] : ranked) {
    if (keypoints.contains(keypoint) || points.contains(point)) continue;
    keypoints.insert(keypoint);
    points.insert(point);
    chosen.push_back({keypoint, point});
  }
  std::ranges::sort(chosen, {}, &PointVote::keypoint);
  return chosen;
}

}  // namespace stucco
