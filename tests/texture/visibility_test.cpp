// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/visibility.h"

#include <gtest/gtest.h>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::LookFrom;
using test::MakeProxy;
using test::MakeWall;

TEST(OcclusionScene, FacetsBlockSegmentsThatCrossThem) {
  const OcclusionScene scene(MakeProxy({MakeWall(4, 3)}));
  EXPECT_TRUE(scene.Blocked({2, -5, 1}, {2, 5, 1}));
  EXPECT_TRUE(scene.Blocked({2, 5, 1}, {2, -5, 1}));
  EXPECT_FALSE(scene.Blocked({5, -5, 1}, {5, 5, 1}));
  EXPECT_FALSE(scene.Blocked({2, -5, 1}, {2, -0.1, 1}));
}

TEST(OcclusionScene, OfNothingBlocksNothing) {
  const OcclusionScene scene((Proxy()));
  EXPECT_FALSE(scene.Blocked({0, 0, 0}, {1, 1, 1}));
}

TEST(OcclusionScene, StaysExactFarFromTheOrigin) {
  Facet wall = MakeWall(4, 3);
  const Eigen::Vector3d far(400000, 5300000, 300);
  for (auto& vertex : wall.outer) vertex += far;
  const OcclusionScene scene(MakeProxy({wall}));
  EXPECT_TRUE(scene.Blocked(far + Eigen::Vector3d(2, -0.01, 1), far + Eigen::Vector3d(2, 0.01, 1)));
  EXPECT_FALSE(
      scene.Blocked(far + Eigen::Vector3d(2, -0.02, 1), far + Eigen::Vector3d(2, -0.01, 1)));
}

TEST(SightedByOthers, WhoLooksFromAboutWhereAViewerStoodSeesItToo) {
  SurveyPhoto before = LookFrom("before.jpg", {0, -10, 1}, {0, 0, 1}, {400, 300, 400});
  SurveyPhoto elsewhere = LookFrom("elsewhere.jpg", {8, -10, 1}, {0, 0, 1}, {400, 300, 400});
  before.id = PhotoId{7};
  elsewhere.id = PhotoId{1};
  SurveyPhoto beside = LookFrom("new/beside.jpg", {0.5, -10, 1}, {0, 0, 1}, {400, 300, 400});
  SurveyPhoto far_off = LookFrom("new/far.jpg", {4, -10, 1}, {0, 0, 1}, {400, 300, 400});
  beside.id = PhotoId{1};  // numbered by itself, as elsewhere.jpg is
  far_off.id = PhotoId{7};
  SightedPoints points;
  points.positions = {{0, 5, 1}, {0, 5, 1}, {0, 5, 1}};
  points.views = {7, 1, 1, 99};
  points.ends = {2, 3, 4};  // the last is of a photo that is gone
  const std::vector<SurveyPhoto> of_points = {before, elsewhere};
  const std::vector<SurveyPhoto> others = {beside, far_off};
  const SightedPoints found = SightedByOthers(points, of_points, others);
  EXPECT_EQ(found.positions, points.positions);
  EXPECT_TRUE(found.IsSeenBy(0, beside.id));
  EXPECT_FALSE(found.IsSeenBy(0, far_off.id));
  EXPECT_FALSE(found.IsSeenBy(1, beside.id));
  EXPECT_FALSE(found.IsSeenBy(2, beside.id));

  points.ends.clear();
  points.views.clear();
  EXPECT_TRUE(SightedByOthers(points, of_points, others).IsSeenBy(0, far_off.id));
}

class Foreground : public ::testing::Test {
 protected:
  // Points 1 m in front of the wall's middle.
  Foreground() {
    AddPatch(2, -1, 1.5);
    points_.positions.push_back({0.5, -1, 0.5});  // noise
  }
  CloudView Ask(const Eigen::Vector3d& on_wall, double clearance) const {
    const NearestPoints nearest = SplatNearest(photo_, points_, 100);
    const SightScene scene{{&photo_, 1}, nullptr, {&nearest, 1}, points_.positions};
    return AskCloud(scene, 0, *ProjectIntoPhoto(photo_, on_wall), wall_, {-clearance, clearance});
  }
  // A patch of points of 40 cm around a place.
  void AddPatch(double x, double y, double z) {
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j)
        points_.positions.push_back({x - 0.2 + 0.01 * i, y, z - 0.2 + 0.01 * j});
    }
  }

  Facet wall_ = MakeWall(4, 3);
  SurveyPhoto photo_ = LookFrom("a.jpg", {2, -6, 1.5}, {2, 0, 1.5}, {400, 300, 400});
  SightedPoints points_;
};

TEST_F(Foreground, HidesWhatIsBehindIt) {
  EXPECT_EQ(Ask({2, 0, 1.5}, 0.3), CloudView::kInFront);
  EXPECT_EQ(Ask({3.2, 0, 1.5}, 0.3), CloudView::kNoPoints);
}

TEST_F(Foreground, ThatIsWithinTheClearanceBelongsToTheWall) {
  EXPECT_EQ(Ask({2, 0, 1.5}, 1.2), CloudView::kSurface);
}

TEST_F(Foreground, OfASinglePointIsNoise) {
  // The wall point behind the lone point, seen from the camera.
  const Eigen::Vector3d lone = points_.positions.back();
  const Eigen::Vector3d camera(2, -6, 1.5);
  const Eigen::Vector3d behind = camera + (lone - camera) * 6 / 5;
  EXPECT_EQ(Ask(behind, 0.3), CloudView::kSurface);
}

TEST_F(Foreground, IsNotWhatLiesBeyondThePlane) {
  AddPatch(3.5, 2, 2.5);
  const Eigen::Vector3d camera(2, -6, 1.5);
  const Eigen::Vector3d on_wall = camera + (Eigen::Vector3d(3.5, 2, 2.5) - camera) * 6 / 8;
  EXPECT_EQ(Ask(on_wall, 0.3), CloudView::kBeyond);
  AddPatch(on_wall.x(), 0, on_wall.z());
  EXPECT_EQ(Ask(on_wall, 0.3), CloudView::kSurface);
}

TEST_F(Foreground, BeyondIsOnlyWhatThePhotoItselfSees) {
  AddPatch(3.5, 2, 2.5);
  const Eigen::Vector3d camera(2, -6, 1.5);
  const Eigen::Vector3d on_wall = camera + (Eigen::Vector3d(3.5, 2, 2.5) - camera) * 6 / 8;
  photo_.id = PhotoId{7};
  for (size_t i = 0; i < points_.positions.size(); ++i) {
    points_.views.insert(points_.views.end(), {3, 9});
    points_.ends.push_back(points_.views.size());
  }
  // Others saw it, from the far side of a wall that has no points here.
  EXPECT_EQ(Ask(on_wall, 0.3), CloudView::kSurface);
  EXPECT_EQ(Ask({2, 0, 1.5}, 0.3), CloudView::kInFront);
  photo_.id = PhotoId{9};
  EXPECT_EQ(Ask(on_wall, 0.3), CloudView::kBeyond);
}

TEST(SplatNearest, KeepsTheNearestPoint) {
  const SurveyPhoto photo = LookFrom("a.jpg", {0, -6, 0}, {0, 0, 0}, {400, 300, 400});
  const SightedPoints points{{{0, 0, 0}, {0, -2, 0}, {0, -1, 0}, {0, -7, 0}}, {}, {}};
  const NearestPoints nearest = SplatNearest(photo, points, 100);
  EXPECT_EQ(nearest.width, 100);
  EXPECT_EQ(nearest.height, 75);
  EXPECT_EQ(nearest.index[37 * 100 + 50], 1);
}

}  // namespace
}  // namespace stucco
