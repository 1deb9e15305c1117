// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/repeating_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "calib/features/descriptors.h"
#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_bays.h"
#include "tests/site/made_plan.h"
#include "tests/survey/stage_support.h"

namespace stucco::test {
namespace {

const Pose kBefore = SitePose({10, -18, 6}, 0, 0);

WallView ViewFrom(const Pose& pose) {
  return {TwoHouses().facades[0], {0, 20}, {0, 12}, pose};
}

WallKeypoints OnWallFrom(const Pose& pose, bool alike) {
  const Features features = SeeBays(pose, alike);
  return {UnitDescriptors(features), PlacesOnWall(features, SiteCamera(), ViewFrom(pose))};
}

TEST(FindRepeats, TellsBaysThatLookTheSame) {
  const WallRepeats repeats = FindRepeats(OnWallFrom(kBefore, true));
  EXPECT_GT(repeats.share, 0.9);
  EXPECT_NEAR(repeats.period_m, 3, 0.05);
}

TEST(FindRepeats, SeesNothingInBaysThatDiffer) {
  const WallRepeats repeats = FindRepeats(OnWallFrom(kBefore, false));
  EXPECT_EQ(repeats.share, 0);
  EXPECT_EQ(repeats.period_m, 0);
  EXPECT_EQ(FindRepeats({}).share, 0);
}

class OnRepeatingWallsTest : public testing::Test {
 protected:
  OnRepeatingWallsTest() {
    captures_.cameras.push_back({"key", "Made", SiteCamera(), "option"});
    guidance_.facades = TwoHouses().facades;
  }

  // Three photos that show the wall, plain and rectified, with records that are `off` along it.
  OnRepeatingWalls Find(bool alike, double off_m = 0) {
    ExpectInput input{TwoHouses(), {}, {}};
    for (const double x : {8.0, 10.0, 12.0}) {
      CapturedPhoto photo;
      photo.camera = 0;
      captures_.photos.push_back(photo);
      const Pose pose = SitePose({x, -18, 6}, 0, 0);
      input.poses.push_back(SitePose({x + off_m, -18, 6}, 0, 0));
      input.cameras.push_back(&captures_.cameras[0].intrinsics);
      features_.plain.push_back(SeeBays(pose, alike));
      WallRun& run = features_.walls[{static_cast<int>(features_.plain.size()) - 1, 0}];
      run.begin = features_.plain.back().size();
      run.features = features_.plain.back();
      run.places = PlacesOnWall(run.features, SiteCamera(), ViewFrom(pose));
    }
    context_.threads = 2;
    guidance_.views = ExpectViews(std::move(input), context_);
    for (const CapturedPhoto& photo : captures_.photos) photos_.push_back(&photo);
    return FindAgain();
  }

  OnRepeatingWalls FindAgain() {
    const PhotoSet set{captures_, photos_, guidance_};
    return FindOnRepeatingWalls({options_, set, context_}, features_);
  }

  void FindFrom(const std::vector<std::optional<Pose>>& poses, OnRepeatingWalls& found) {
    const PhotoSet set{captures_, photos_, guidance_};
    LookAgain({options_, set, context_}, features_, poses, found);
  }

  Captures captures_;
  Guidance guidance_;
  DetectedFeatures features_;

 private:
  CalibOptions options_;
  StageContext context_;
  std::vector<const CapturedPhoto*> photos_;
};

TEST_F(OnRepeatingWallsTest, KnowWhichKeypointsLieOnThem) {
  const OnRepeatingWalls found = Find(true);
  ASSERT_EQ(found.period_m.size(), 1U);
  EXPECT_NEAR(found.period_m.at(0), 3, 0.05);
  for (int photo = 0; photo < 3; ++photo) {
    ASSERT_EQ(found.wall_of[photo].size(), features_.plain[photo].size());
    EXPECT_TRUE(std::ranges::all_of(found.wall_of[photo], [](int wall) { return wall == 0; }));
    EXPECT_TRUE(found.Shows(photo, 0));
    EXPECT_TRUE(found.IsMostOf(photo));
    const int own = static_cast<int>(features_.plain[photo].size());
    EXPECT_FALSE(found.Shows(photo, own));
    EXPECT_TRUE(found.IsOnOne(photo, 0));
    EXPECT_TRUE(found.IsOnOne(photo, own));
    EXPECT_TRUE(found.IsOnOne(photo, 2 * own - 1));
    EXPECT_FALSE(found.IsOnOne(photo, 2 * own));
  }
}

TEST_F(OnRepeatingWallsTest, AreSeenAnewFromWherePhotosTurnOutToBe) {
  OnRepeatingWalls found = Find(true, 5);
  const auto num_off = [&](int photo) {
    return std::ranges::count(found.wall_of[photo], -1);  // beyond the wall's end
  };
  EXPECT_GT(num_off(0), 10);
  const auto before = num_off(1);
  FindFrom({SitePose({8, -18, 6}, 0, 0), std::nullopt, std::nullopt}, found);
  EXPECT_EQ(num_off(0), 0);
  EXPECT_EQ(num_off(1), before);
}

TEST_F(OnRepeatingWallsTest, AreNoneWhereBaysDiffer) {
  const OnRepeatingWalls found = Find(false);
  EXPECT_TRUE(found.period_m.empty());
  ASSERT_EQ(found.wall_of.size(), 3U);
  EXPECT_FALSE(found.Shows(0, 0));
  EXPECT_FALSE(found.IsOnOne(0, static_cast<int>(features_.plain[0].size())));
  EXPECT_FALSE(found.IsMostOf(0));
}

TEST_F(OnRepeatingWallsTest, AreNoneWithoutAPlan) {
  Find(true);
  guidance_.views.reset();
  EXPECT_TRUE(FindAgain().period_m.empty());
}

}  // namespace
}  // namespace stucco::test
