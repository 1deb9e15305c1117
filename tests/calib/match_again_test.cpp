// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/match_again.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_bays.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// Two photos of a wall whose bays all look the same, unless the test says otherwise.
class MatchAgainTest : public BaysTest {
 protected:
  MatchAgainTest() {
    for (const Pose& pose : truth_) Take(pose, true);
    matched_.tried = {{0, 1, 0, 0}};
  }

  // With the second photo known to stand `off` from where it does.
  int Again(const Vector3d& off, double sigma_m) {
    const std::vector<std::optional<KnownPose>> poses = {
        KnownPose{truth_[0], {0.05, 0.05}, 1e-3},
        KnownPose{Moved(truth_[1], off), {sigma_m, sigma_m}, 1e-3}};
    const PhotoSet set = Photos();
    return MatchAgain({options_, set, features_, repeating_, poses, context_}, matched_);
  }

  void LetBaysDiffer() {
    for (size_t i = 0; i < truth_.size(); ++i) features_.plain[i] = SeeBays(truth_[i], false);
  }

  // Matches that join another bay.
  int NumWrong() const {
    int wrong = 0;
    for (const Match& match : matched_.verified.at(0).pair.matches) {
      const auto at = [&](int photo, int keypoint) {
        const WallView view{guidance_.facades[0], {}, {}, truth_[photo]};
        return PlaceOnWall(features_.plain[photo].keypoints[keypoint], SiteCamera(), view)->along_m;
      };
      wrong += std::abs(at(0, match.first) - at(1, match.second)) > 0.1;
    }
    return wrong;
  }

  std::vector<Pose> truth_ = {SitePose({8, -18, 6}, 0, 0), SitePose({13, -15, 8}, -10, -5)};
  MatchedPairs matched_;
};

TEST_F(MatchAgainTest, JoinsTheRightBayWherePosesTellIt) {
  EXPECT_EQ(Again({0.6, 0, 0.3}, 0.4), 1);
  ASSERT_EQ(matched_.verified.size(), 1U);
  EXPECT_GT(matched_.verified[0].pair.matches.size(), 60U);
  EXPECT_EQ(NumWrong(), 0);
  EXPECT_GT(matched_.tried[0].num_verified, 60);
}

TEST_F(MatchAgainTest, ChoosesNoBayWherePosesDoNotTellIt) {
  EXPECT_EQ(Again({0.6, 0, 0.3}, 2), 0);
  EXPECT_EQ(Again({1.4, 0, 0}, 0.6), 0);  // about as far from the next
  EXPECT_TRUE(matched_.verified.empty());
}

TEST_F(MatchAgainTest, MatchesNothingThatPosesRuleOut) {
  // What repeats itself within a bay is a metre from its like, and nearer than half a bay.
  EXPECT_EQ(Again({1, 0, 0}, 0.1), 0);
  EXPECT_EQ(Again({0, 0, 1}, 0.1), 0);
}

TEST_F(MatchAgainTest, JoinsTheRightBayWhereBaysDiffer) {
  LetBaysDiffer();
  EXPECT_EQ(Again({1.4, 0, 0.3}, 1), 1);
  ASSERT_EQ(matched_.verified.size(), 1U);
  EXPECT_GT(matched_.verified[0].pair.matches.size(), 60U);
  EXPECT_EQ(NumWrong(), 0);
}

TEST_F(MatchAgainTest, KeepsWhatAPairHas) {
  Again({0, 0, 0}, 0.1);
  const std::vector<Match> before = matched_.verified.at(0).pair.matches;
  EXPECT_EQ(Again({0, 0, 0}, 5), 0);
  EXPECT_EQ(matched_.verified.at(0).pair.matches, before);
}

TEST(DropOnRepeatingWalls, LeavesWhatElsePhotosShow) {
  OnRepeatingWalls repeating;
  repeating.wall_of = {{0, -1, -1, -1}, {}, {-1, 4, -1, -1}};
  const auto pair = [](int first, int second, std::vector<Match> matches) {
    VerifiedPair verified;
    verified.pair = {first, second, std::move(matches)};
    return verified;
  };
  // The last keypoint of each is one of a rectified wall.
  std::vector<VerifiedPair> pairs = {pair(0, 1, {{0, 0}, {1, 1}, {2, 2}, {4, 9}}),
                                     pair(0, 2, {{0, 0}, {1, 1}, {2, 2}}),
                                     pair(1, 2, {{7, 0}, {8, 2}})};
  DropOnRepeatingWalls(repeating, 2, pairs);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].pair.matches, (std::vector<Match>{{1, 1}, {2, 2}, {4, 9}}));
  EXPECT_EQ(pairs[1].pair.matches, (std::vector<Match>{{7, 0}, {8, 2}}));
}

}  // namespace
}  // namespace stucco::test
