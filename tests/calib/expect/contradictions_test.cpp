// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/contradictions.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// Photos that look down at the ground between the houses, and matches of points on it.
class Contradictions : public testing::Test {
 protected:
  Contradictions() {
    scene_.cameras.push_back({SiteCamera(), SiteCamera(), 0});
    for (int i = 0; i < 4; ++i) {
      truth_.push_back(SitePose({-10.0 + 6 * i, -20, 25}, 0, -90));
      scene_.photos.emplace_back();
    }
    recorded_.assign(truth_.begin(), truth_.end());
  }

  // `count` points that both photos show; in the second one everything is seen `repeat` further on.
  void Match(int first, int second, int count, const Vector3d& repeat) {
    VerifiedPair pair;
    pair.pair = {first, second, {}};
    while (static_cast<int>(pair.pair.matches.size()) < count) {
      const Vector3d point(random_.Uniform(-40, 40), random_.Uniform(-35, -5), 0);
      const auto a = SiteCamera().Project(truth_[first] * point);
      const auto b = SiteCamera().Project(truth_[second] * (point + repeat));
      if (!a || !b || !SiteCamera().Contains(*a) || !SiteCamera().Contains(*b)) continue;
      pair.pair.matches.push_back({Add(first, *a), Add(second, *b)});
    }
    pairs_.push_back(std::move(pair));
  }

  // What is left, and how many went.
  int Drop() {
    const Camera camera = SiteCamera();
    const Plan plan = TwoHouses();
    const ExpectedViews views =
        ExpectViews({plan, recorded_, std::vector<const Camera*>(recorded_.size(), &camera)}, {});
    return DropContradictions(views, scene_, pairs_);
  }

  Scene scene_;
  std::vector<Pose> truth_;
  std::vector<std::optional<Pose>> recorded_;
  std::vector<VerifiedPair> pairs_;

 private:
  int Add(int photo, const Eigen::Vector2d& pixel) {
    scene_.photos[photo].keypoints.push_back(pixel);
    return static_cast<int>(scene_.photos[photo].keypoints.size()) - 1;
  }
  Random random_{1};
};

TEST_F(Contradictions, LetsPairsStayWhoseRecordsAreMetresAndDegreesOff) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  recorded_[0] = SitePose({-8.5, -21, 24}, 3, -88);
  recorded_[2] = SitePose({2, -18.5, 25}, -2, -91);
  EXPECT_EQ(Drop(), 0);
  EXPECT_EQ(pairs_.size(), 2u);
}

TEST_F(Contradictions, TakesOutWhatMatchesSomewhereElse) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  Match(0, 3, 80, {18, 0, 0});  // a pattern of the ground that repeats after 18 m
  EXPECT_EQ(Drop(), 1);
  ASSERT_EQ(pairs_.size(), 2u);
  EXPECT_EQ(pairs_[0].pair.second, 1);
  EXPECT_EQ(pairs_[1].pair.first, 2);
}

TEST_F(Contradictions, BelievesAPhotoMoreThanARecordThatFitsNoneOfItsPairs) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  recorded_[3] = SitePose({60, 40, 25}, 120, -90);
  EXPECT_EQ(Drop(), 0);
  EXPECT_EQ(pairs_.size(), 3u);
}

TEST_F(Contradictions, SaysNothingWithoutARecordOrWithTooFewMatches) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  Match(0, 3, 5, {18, 0, 0});
  EXPECT_EQ(Drop(), 0);
  Match(1, 2, 60, {-18, 0, 0});
  recorded_[1].reset();
  EXPECT_EQ(Drop(), 0);
}

TEST_F(Contradictions, AllowsForThingsThatStandInFrontOfTheGround) {
  Match(0, 1, 60, Vector3d::Zero());
  // Tree tops 8 m above the ground.
  VerifiedPair pair;
  pair.pair = {0, 2, {}};
  for (int i = 0; i < 40; ++i) {
    const Vector3d point(-6 + 0.2 * i, -25 + 0.3 * i, 8);
    for (const int photo : {0, 2}) {
      scene_.photos[photo].keypoints.push_back(*SiteCamera().Project(truth_[photo] * point));
    }
    pair.pair.matches.push_back({static_cast<int>(scene_.photos[0].keypoints.size()) - 1,
                                 static_cast<int>(scene_.photos[2].keypoints.size()) - 1});
  }
  pairs_.push_back(pair);
  Match(1, 2, 60, Vector3d::Zero());
  EXPECT_EQ(Drop(), 0);
}

}  // namespace
}  // namespace stucco::test
