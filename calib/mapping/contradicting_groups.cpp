// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/contradicting_groups.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "survey/attitude.h"

namespace stucco {
namespace {

constexpr size_t kNearestTied = 5;
constexpr int kLeastShared = 30;
constexpr size_t kLeastPhotos = 3;
// What poses may be off by where records are better.
constexpr double kTiedSigma_m = 0.05;
constexpr double kAmongNeighbours_m = 0.01;  // of which the shift that they share is taken away
constexpr double kTiedSigma_rad = 0.05 * std::numbers::pi / 180;

// What a record of one kind is off by, in its standard deviations.
using Difference = std::optional<Eigen::Vector3d>;

struct Differences {
  Difference attitude;  // about the axes of the world
  Difference position;
};

Differences DifferencesOf(const ScenePhoto& photo) {
  Differences result;
  if (photo.attitude) {
    const Eigen::Quaterniond turn =
        photo.attitude->cam_from_world.conjugate() * photo.pose->rotation;
    result.attitude = RotationVector(turn) / std::hypot(photo.attitude->sigma_rad, kTiedSigma_rad);
  }
  if (photo.prior) {
    const Eigen::Vector3d off = photo.pose->Center() - photo.prior->position;
    const double horizontal = std::hypot(photo.prior->sigma_horizontal_m, kTiedSigma_m);
    const double vertical = std::hypot(photo.prior->sigma_vertical_m, kTiedSigma_m);
    result.position = off.cwiseQuotient(Eigen::Vector3d(horizontal, horizontal, vertical));
  }
  return result;
}

// The photo and those that share most points with it, of those that agree with their records.
std::vector<int> GroupOf(const Scene& scene, const std::vector<bool>& agrees, int photo) {
  const std::vector<int> shared = PointsShared(scene, photo);
  std::vector<std::pair<int, int>> order;  // (-points, photo)
  for (size_t other = 0; other < shared.size(); ++other) {
    if (agrees[other] && shared[other] >= kLeastShared) {
      order.emplace_back(-shared[other], static_cast<int>(other));
    }
  }
  std::ranges::sort(order);
  if (order.size() > kNearestTied) order.resize(kNearestTied);
  std::vector<int> group = {photo};
  for (const auto& [points, other] : order) group.push_back(other);
  return group;
}

// What poses that are turned about their middle lie off their recorded positions, but for a common
// shift: a sum of squares in standard deviations. Of photos that have both records.
double SquaresTurned(const Scene& scene, const std::vector<int>& told,
                     const Eigen::Quaterniond& turn) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int photo : told) middle += scene.photos[photo].pose->Center();
  middle /= static_cast<double>(told.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const int photo : told) {
    const PositionPrior& prior = *scene.photos[photo].prior;
    const double horizontal = std::hypot(prior.sigma_horizontal_m, kAmongNeighbours_m);
    const double vertical = std::hypot(prior.sigma_vertical_m, kAmongNeighbours_m);
    const Eigen::Vector3d centre = middle + turn * (scene.photos[photo].pose->Center() - middle);
    const Eigen::Vector3d off =
        (centre - prior.position).cwiseQuotient(Eigen::Vector3d(horizontal, horizontal, vertical));
    sum += off;
    squares += off.cwiseProduct(off);
  }
  return (squares - sum.cwiseProduct(sum) / static_cast<double>(told.size())).sum();
}

// Whether positions deny that the group is turned as its attitudes say: then it is the gimbals that
// are off together, as those of one line of a flight are.
bool PositionsDenyTheTurn(const Scene& scene, const std::vector<int>& group) {
  std::vector<int> told;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (const int photo : group) {
    const ScenePhoto& posed = scene.photos[photo];
    if (!posed.attitude || !posed.prior) continue;
    told.push_back(photo);
    turn += RotationVector(posed.attitude->cam_from_world.conjugate() * posed.pose->rotation);
  }
  if (told.size() < kLeastPhotos) return false;
  turn /= static_cast<double>(told.size());
  return SquaresTurned(scene, told, FromRotationVector(turn)) >
         SquaresTurned(scene, told, Eigen::Quaterniond::Identity()) + kUnlikelySquare;
}

// Adds those that are off the mean's way where the mean is more than chance.
void Test(const std::vector<int>& group, const std::vector<Differences>& all,
          Difference Differences::*kind, std::set<int>& off) {
  std::vector<int> told;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int photo : group) {
    if (!(all[photo].*kind)) continue;
    told.push_back(photo);
    mean += *(all[photo].*kind);
  }
  if (told.size() < kLeastPhotos) return;
  const double count = static_cast<double>(told.size());
  mean /= count;
  const double variance = kCommonShare + (1 - kCommonShare) / count;
  if (mean.squaredNorm() <= kUnlikelySquare * variance) return;
  for (const int photo : told) {
    if ((all[photo].*kind)->dot(mean) >= mean.squaredNorm() / 2) off.insert(photo);
  }
}

}  // namespace

std::vector<int> ContradictingGroups(const Scene& scene, const std::vector<bool>& agrees) {
  assert(agrees.size() == scene.photos.size());
  const int count = static_cast<int>(scene.photos.size());
  std::vector<Differences> differences(count);
  for (int i = 0; i < count; ++i) {
    if (agrees[i]) differences[i] = DifferencesOf(scene.photos[i]);
  }
  std::set<int> off;
  for (int i = 0; i < count; ++i) {
    if (!agrees[i]) continue;
    const std::vector<int> group = GroupOf(scene, agrees, i);
    if (!PositionsDenyTheTurn(scene, group)) Test(group, differences, &Differences::attitude, off);
    Test(group, differences, &Differences::position, off);
  }
  return {off.begin(), off.end()};
}

}  // namespace stucco
