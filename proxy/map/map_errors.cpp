// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/map_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr double kWallSigma_m = 0.15;  // of one wall, beside what it shares with others
constexpr size_t kFewestGroups = 3;    // that tell how a map is

double WeightOf(double off) {
  const double sigmas = std::abs(off) / kWallSigma_m;
  return (sigmas > 1 ? 1 / sigmas : 1) / (kWallSigma_m * kWallSigma_m);
}

// How far outwards a motion of its group (shift in x and y, turn) takes the middle of a wall.
Eigen::Vector3d OutwardsBy(const HeldWall& wall, const Eigen::Vector2d& middle) {
  const Eigen::Vector2d arm = wall.middle - middle;
  return {wall.outwards.x(), wall.outwards.y(),
          wall.outwards.y() * arm.x() - wall.outwards.x() * arm.y()};
}

Eigen::Vector3d VectorOf(const GroupMotion& motion) {
  return {motion.shift.x(), motion.shift.y(), motion.turn};
}

// The motion that the walls of a group agree on, where all of them lie `outset` outside.
GroupMotion MotionOf(const HeldGroup& group, double outset, const GroupMotion& done,
                     const MapPrior& prior) {
  constexpr int kRounds = 10;
  const Eigen::Vector3d expected = Eigen::Vector3d(0, 0, prior.turn) - VectorOf(done);
  const Eigen::Vector3d sigmas(prior.shift_sigma, prior.shift_sigma, prior.turn_sigma);
  const Eigen::Vector3d certain = sigmas.cwiseAbs2().cwiseInverse();
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d normal = certain.asDiagonal();
    Eigen::Vector3d right = certain.cwiseProduct(expected);
    const auto add = [&](const Eigen::Vector3d& by, double is) {
      const double weight = WeightOf(is - by.dot(motion));
      normal += weight * by * by.transpose();
      right += weight * is * by;
    };
    for (const HeldWall& wall : group.walls) {
      add(OutwardsBy(wall, group.middle), wall.offset - outset);
      // Both of its ends are off by a sigma of their own.
      const double lever = wall.span / std::numbers::sqrt2;
      add({0, 0, lever}, wall.turn * lever);
    }
    motion = normal.ldlt().solve(right);
  }
  return {.shift = motion.head<2>(), .turn = motion.z()};
}

double OffsetAfter(const HeldWall& wall, const HeldGroup& group, const GroupMotion& motion) {
  return wall.offset - OutwardsBy(wall, group.middle).dot(VectorOf(motion));
}

double LongestSpan(const HeldGroup& group) {
  double longest = 0;
  for (const HeldWall& wall : group.walls) longest = std::max(longest, wall.span);
  return longest;
}

// How far buildings are shifted, by what most of them are.
double ShiftSpread(std::span<const HeldGroup> groups, std::span<const GroupMotion> motions) {
  constexpr double kMedianOfPlane = 1.1774;  // of lengths, for normal distributions along both axes
  constexpr double kLeast_m = 0.05;
  std::vector<double> lengths;
  for (size_t g = 0; g < groups.size(); ++g) {
    if (!groups[g].walls.empty()) lengths.push_back(motions[g].shift.norm());
  }
  if (lengths.size() < kFewestGroups) return kMapSigma_m;
  return std::clamp(*Median(lengths) / kMedianOfPlane, kLeast_m, kMapSigma_m);
}

// Turns of the groups with walls that are long enough to tell them.
std::vector<double> TurnsOf(std::span<const HeldGroup> groups,
                            std::span<const GroupMotion> motions) {
  constexpr double kLong_m = 6;
  std::vector<double> turns;
  for (size_t g = 0; g < groups.size(); ++g) {
    if (LongestSpan(groups[g]) > kLong_m) turns.push_back(motions[g].turn);
  }
  return turns;
}

}  // namespace

MapErrors ErrorsOf(std::span<const HeldGroup> groups, const MapPrior& prior) {
  constexpr int kRounds = 30;
  MapErrors errors{.motions = std::vector<GroupMotion>(groups.size())};
  for (int round = 0; round < kRounds; ++round) {
    double total = 1 / (kMapSigma_m * kMapSigma_m), sum = 0;
    for (size_t g = 0; g < groups.size(); ++g) {
      errors.motions[g] = MotionOf(groups[g], errors.outset, prior.done[g], prior);
      for (const HeldWall& wall : groups[g].walls) {
        const double off = OffsetAfter(wall, groups[g], errors.motions[g]);
        const double weight = WeightOf(off - errors.outset);
        total += weight;
        sum += weight * off;
      }
    }
    errors.outset = sum / total;
  }
  return errors;
}

double SpreadOf(std::span<const HeldGroup> groups, const MapErrors& errors) {
  constexpr size_t kFewest = 6;
  std::vector<double> off;
  for (size_t g = 0; g < groups.size(); ++g) {
    for (const HeldWall& wall : groups[g].walls) {
      off.push_back(std::abs(OffsetAfter(wall, groups[g], errors.motions[g]) - errors.outset));
    }
  }
  if (off.size() < kFewest) return kMapSigma_m;
  return std::clamp(*Median(off) / kMedianOfNormal, kWallSigma_m, kMapSigma_m);
}

MapPrior Learned(std::span<const HeldGroup> groups, const MapErrors& errors, MapPrior prior) {
  constexpr double kLeastTurn_rad = 0.001;
  for (size_t g = 0; g < groups.size(); ++g) {
    prior.done[g].shift += errors.motions[g].shift;
    prior.done[g].turn += errors.motions[g].turn;
  }
  prior.shift_sigma = ShiftSpread(groups, prior.done);
  std::vector<double> turns = TurnsOf(groups, prior.done);
  if (turns.size() < kFewestGroups) return prior;
  prior.turn = *Median(turns);
  for (double& turn : turns) turn = std::abs(turn - prior.turn);
  prior.turn_sigma = std::clamp(*Median(turns) / kMedianOfNormal, kLeastTurn_rad, kMapTurn_rad);
  return prior;
}

Eigen::Isometry2d IsometryOf(const GroupMotion& motion, const Eigen::Vector2d& middle) {
  Eigen::Isometry2d isometry = Eigen::Isometry2d::Identity();
  isometry.translate(Eigen::Vector2d(middle + motion.shift));
  isometry.rotate(motion.turn);
  isometry.translate(-middle);
  return isometry;
}

}  // namespace stucco
