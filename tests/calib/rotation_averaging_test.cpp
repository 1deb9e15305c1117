// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/rotation_averaging.h"

#include <gtest/gtest.h>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

Eigen::Quaterniond Turned(const Eigen::Quaterniond& q, double sigma, Random& random) {
  const Eigen::Vector3d v(random.Gauss(sigma), random.Gauss(sigma), random.Gauss(sigma));
  return (Eigen::Quaterniond(Eigen::AngleAxisd(v.norm(), v.normalized())) * q).normalized();
}

class Averaging : public testing::Test {
 protected:
  Averaging() {
    Random random(3);
    for (int i = 0; i < 40; ++i) {
      truth_.push_back(Turned(Eigen::Quaterniond::Identity(), 1, random));
      rotations_.emplace_back(Turned(truth_.back(), 0.05, random));
    }
    for (int i = 0; i < 40; ++i) {
      for (int j = i + 1; j < std::min(40, i + 6); ++j) {
        pairs_.push_back({i, j, Turned(truth_[j] * truth_[i].conjugate(), 0.005, random)});
      }
    }
  }

  double Worst() const {
    double worst = 0;
    for (size_t i = 0; i < truth_.size(); ++i) {
      if (rotations_[i]) worst = std::max(worst, rotations_[i]->angularDistance(truth_[i]));
    }
    return worst;
  }

  std::vector<Eigen::Quaterniond> truth_;
  std::vector<std::optional<Eigen::Quaterniond>> rotations_;
  std::vector<RelativeRotation> pairs_;
};

TEST_F(Averaging, IsBetterThanPriors) {
  const double before = Worst();
  AverageRotations(pairs_, {0.005, 0.05}, rotations_);
  EXPECT_LT(Worst(), 0.3 * before);
}

TEST_F(Averaging, SurvivesWrongPairs) {
  Random random(5);
  for (size_t i = 0; i < pairs_.size(); i += 6) {
    pairs_[i].second_from_first = Turned(pairs_[i].second_from_first, 0.5, random);
  }
  AverageRotations(pairs_, {0.005, 0.05}, rotations_);
  EXPECT_LT(Worst(), 0.05);
}

TEST_F(Averaging, LeavesAloneWhatHasNoPrior) {
  rotations_[7].reset();
  std::erase_if(pairs_, [](const RelativeRotation& p) { return p.first == 7 || p.second == 7; });
  AverageRotations(pairs_, {0.005, 0.05}, rotations_);
  EXPECT_FALSE(rotations_[7]);
  EXPECT_LT(Worst(), 0.05);
}

}  // namespace
}  // namespace stucco::test
