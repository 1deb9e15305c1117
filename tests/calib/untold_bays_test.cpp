// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/untold_bays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kPhotos = 8;
constexpr double kBetweenBays_m = 3;

// Photos that stand together before one wall with bays of 3 m, from x = 0 to 30 m.
class UntoldBaysTest : public testing::Test {
 protected:
  UntoldBaysTest()
      : scene_(MakeScene({.num_photos = kPhotos, .num_points = 800, .num_planes = 1})) {
    ShowOneWall(800);
    Record(0.5);
  }

  // The first `of_wall` tracks are of the wall, the others of what does not repeat itself.
  void ShowOneWall(int of_wall) {
    AddWalls(1);
    repeating_.wall_of.assign(kPhotos, {});
    for (int photo = 0; photo < kPhotos; ++photo) {
      for (const int track : scene_.tracks_of_photo[photo]) {
        repeating_.wall_of[photo].push_back(track >= 0 && track < of_wall ? 0 : -1);
      }
    }
  }

  void ShowAWallEach() {
    AddWalls(kPhotos);
    for (int photo = 0; photo < kPhotos; ++photo) {
      repeating_.wall_of[photo].assign(scene_.photos[photo].keypoints.size(), photo);
    }
  }

  void Record(double sigma_m) {
    recorded_.clear();
    for (const ScenePhoto& photo : scene_.photos) {
      recorded_.push_back(PositionPrior{photo.pose->Center(), sigma_m, 0.3});
    }
  }

  std::vector<int> Find() const { return UntoldBays(repeating_, facades_, recorded_, scene_); }

  Scene scene_;
  OnRepeatingWalls repeating_;
  std::vector<PlannedFacade> facades_;
  std::vector<std::optional<PositionPrior>> recorded_;

 private:
  void AddWalls(int count) {
    repeating_.period_m.clear();
    facades_.clear();
    for (int wall = 0; wall < count; ++wall) {
      PlannedFacade facade;
      facade.a_m = {0, 0};
      facade.b_m = {30, 0};
      facade.z_m = {0, 9};
      facades_.push_back(facade);
      repeating_.period_m[wall] = kBetweenBays_m;
    }
  }
};

TEST_F(UntoldBaysTest, NoneAreWhereRecordsTellThem) {
  EXPECT_THAT(Find(), IsEmpty());
}

TEST_F(UntoldBaysTest, ThoseAreWhoseRecordsWouldRatherHaveThemABayOrAStoreyBeside) {
  recorded_[3]->position.x() += 1.6;
  recorded_[5]->position.z() -= 3;
  EXPECT_THAT(Find(), ElementsAre(3, 5));
  // A wall of one storey looks like nothing a storey higher; what is off across it is no bay.
  facades_[0].z_m = {0, 4};
  recorded_[3]->position += Eigen::Vector3d(-1.6, 1.6, 0);
  EXPECT_THAT(Find(), IsEmpty());
}

TEST_F(UntoldBaysTest, PhotosThatMoveTogetherAreToldTogether) {
  Record(1.2);
  EXPECT_THAT(Find(), IsEmpty());
  ShowAWallEach();
  EXPECT_THAT(Find(), SizeIs(kPhotos));
}

TEST_F(UntoldBaysTest, WhatIsCommonToTheirRecordsIsNotTold) {
  Record(1.2);
  for (auto& position : recorded_) position->position.x() -= 1;
  EXPECT_THAT(Find(), SizeIs(kPhotos));
}

TEST_F(UntoldBaysTest, PointsOfWhatDoesNotRepeatItselfTellThem) {
  Record(5);
  EXPECT_THAT(Find(), SizeIs(kPhotos));
  ShowOneWall(600);
  EXPECT_THAT(Find(), SizeIs(kPhotos));  // no photo's place is sure
  repeating_.wall_of[2].clear();
  EXPECT_THAT(Find(), IsEmpty());
  ShowOneWall(770);
  repeating_.wall_of[2].clear();
  EXPECT_THAT(Find(), SizeIs(kPhotos - 1));
}

TEST_F(UntoldBaysTest, WhatTheWallRectifiedShowsTellsNothing) {
  Record(5);
  ShowOneWall(600);
  repeating_.wall_of[2].clear();
  repeating_.rectified.assign(kPhotos, {{0, 10000}});
  EXPECT_THAT(Find(), SizeIs(kPhotos - 1));
}

TEST_F(UntoldBaysTest, PhotosWithoutAPoseARecordOrSuchAWallAreNotJudged) {
  Record(5);
  scene_.photos[0].pose.reset();
  recorded_[1].reset();
  repeating_.wall_of[2].clear();
  EXPECT_THAT(Find(), ElementsAre(3, 4, 5, 6, 7));
  repeating_.period_m.clear();
  EXPECT_THAT(Find(), IsEmpty());
}

}  // namespace
}  // namespace stucco::test
