// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/expected_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/calib/expect/made_site.h"

namespace stucco::test {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

ExpectedViews Expect(const std::vector<std::optional<Pose>>& poses) {
  const Camera camera = SiteCamera();
  StageContext context;
  context.threads = 2;
  const Plan plan = TwoHouses();
  return ExpectViews({plan, poses, std::vector<const Camera*>(poses.size(), &camera)}, context);
}

int SeenOfWall(const ExpectedViews& views, int photo, int wall) {
  return static_cast<int>(std::ranges::count_if(
      views.seen[photo], [&](int point) { return views.points[point].facade == wall; }));
}

TEST(ExpectViews, SeesWhatIsInThePictureAndNotHidden) {
  // Level from 15 m south of the first house, north; then south, where the second house's north
  // wall (facade 4 + 2) is; then the first house from behind the second.
  const ExpectedViews views = Expect({SitePose({10, -15, 6}, 0, 0), SitePose({10, -15, 6}, 180, 0),
                                      SitePose({10, -70, 6}, 0, 0), std::nullopt});
  EXPECT_EQ(SeenOfWall(views, 0, 0), 10 * 6);
  EXPECT_EQ(SeenOfWall(views, 0, 2), 0);  // the far side
  EXPECT_EQ(SeenOfWall(views, 0, 6), 0);
  EXPECT_EQ(SeenOfWall(views, 1, 0), 0);
  EXPECT_EQ(SeenOfWall(views, 1, 6), 10 * 6);
  EXPECT_EQ(SeenOfWall(views, 2, 0), 0);  // hidden
  EXPECT_EQ(SeenOfWall(views, 2, 4), 10 * 6);
  EXPECT_THAT(views.seen[3], IsEmpty());
}

TEST(OverlappingPairs, AreThoseThatSeeTheSameFromAlikeDirections) {
  const ExpectedViews views =
      Expect({SitePose({8, -15, 6}, 0, 0), SitePose({12, -15, 6}, 0, 0),
              SitePose({10, -15, 6}, 180, 0), SitePose({10, 5, 40}, 0, -90), std::nullopt});
  const auto pairs = OverlappingPairs(views, 10, 2);
  EXPECT_TRUE(std::ranges::is_sorted(pairs));
  EXPECT_THAT(pairs, Contains(Pair(0, 1)));
  EXPECT_THAT(pairs, Not(Contains(Pair(0, 2))));  // back to back
  EXPECT_THAT(pairs, Not(Contains(Pair(0, 3))));  // the roof
}

TEST(OverlappingPairs, AreTheBestOfEachPhoto) {
  std::vector<std::optional<Pose>> row;
  for (int i = 0; i < 8; ++i) row.push_back(SitePose({1.0 + 2.5 * i, -12, 6}, 0, 0));
  const auto pairs = OverlappingPairs(Expect(row), 2, 2);
  EXPECT_LE(pairs.size(), 16u);
  for (int i = 0; i + 1 < 8; ++i) EXPECT_THAT(pairs, Contains(Pair(i, i + 1)));
  EXPECT_THAT(pairs, Not(Contains(Pair(0, 7))));
  EXPECT_THAT(OverlappingPairs(Expect(row), 0, 2), IsEmpty());
}

TEST(ExpectViews, SurvivePhotosWithoutPoses) {
  const ExpectedViews views = Expect({std::nullopt, std::nullopt});
  EXPECT_TRUE(views.points.empty());
  EXPECT_THAT(OverlappingPairs(views, 10, 2), IsEmpty());
  EXPECT_THAT(ObliqueWallPairs(views, 10, 2), IsEmpty());
}

TEST(ExpectViews, SaysNothingOfPhotosFarAway) {
  const ExpectedViews views = Expect({SitePose({5000, -15, 6}, 270, 0)});
  EXPECT_THAT(views.seen[0], IsEmpty());
}

TEST(ObliqueWallPairs, AreTheSameWithAnyNumberOfThreads) {
  std::vector<std::optional<Pose>> poses;
  for (int i = 0; i < 6; ++i) {
    poses.push_back(SitePose({3.0 * i, -14, 6}, 0, 0));
    poses.push_back(SitePose({3.0 * i, -20, 32}, 0, -45));
  }
  const ExpectedViews views = Expect(poses);
  EXPECT_EQ(ObliqueWallPairs(views, 3, 1), ObliqueWallPairs(views, 3, 4));
  EXPECT_EQ(OverlappingPairs(views, 3, 1), OverlappingPairs(views, 3, 4));
  EXPECT_FALSE(ObliqueWallPairs(views, 3, 1).empty());
}

TEST(ObliqueWallPairs, JoinFrontalPhotosWithTiltedOnes) {
  const ExpectedViews views = Expect(
      {SitePose({8, -15, 6}, 0, 0), SitePose({12, -15, 6}, 0, 0), SitePose({10, -20, 32}, 0, -45),
       SitePose({10, 40, 32}, 180, -45), SitePose({14, -20, 32}, 0, -45)});
  const auto pairs = ObliqueWallPairs(views, 6, 2);
  EXPECT_TRUE(std::ranges::is_sorted(pairs));
  EXPECT_THAT(pairs, Contains(WallPair{0, 2, 0}));
  EXPECT_THAT(pairs, Contains(WallPair{1, 2, 0}));
  EXPECT_THAT(pairs, Not(Contains(WallPair{0, 1, 0})));  // they match as they are
  EXPECT_THAT(pairs, Contains(WallPair{1, 4, 0}));
  EXPECT_THAT(pairs, Not(Contains(WallPair{2, 4, 0}))) << "from the same direction";
  for (const WallPair& pair : pairs) {
    EXPECT_LT(pair.first, pair.second);
    EXPECT_NE(pair.second, 3) << "it sees the other side";
  }
}

}  // namespace
}  // namespace stucco::test
