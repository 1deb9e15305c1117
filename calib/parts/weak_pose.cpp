// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/weak_pose.h"

#include <fmt/format.h>

#include <cassert>
#include <utility>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr int kFewObservations = 50;
constexpr double kUncertain = 5;  // times as uncertain as usual

}  // namespace

std::string WhyWeak(double position_sigma, int observations, double usual) {
  if (position_sigma < 0) return "how surely it is placed could not be computed";
  if (observations < kFewObservations) return fmt::format("only {} points hold it", observations);
  if (position_sigma <= kUncertain * usual) return "";
  return fmt::format("{:.0f} times less sure than the middle photo", position_sigma / usual);
}

std::vector<int> WeakPoses(const Scene& scene, const std::vector<PoseSigma>& sigmas) {
  assert(sigmas.size() == scene.photos.size());
  std::vector<double> positions;
  for (size_t i = 0; i < sigmas.size(); ++i) {
    if (scene.photos[i].pose) positions.push_back(sigmas[i].position);
  }
  const double usual = Median(std::move(positions)).value_or(0);
  std::vector<int> weak;
  for (int i = 0; i < static_cast<int>(sigmas.size()); ++i) {
    if (!scene.photos[i].pose) continue;
    const int observations = NumUsedObservations(scene, i);
    if (!WhyWeak(sigmas[i].position, observations, usual).empty()) weak.push_back(i);
  }
  return weak;
}

}  // namespace stucco
