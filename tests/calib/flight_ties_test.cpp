// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/flight_ties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "survey/degree.h"
#include "tests/calib/made_records.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

// Photos of an arc about a corner, by turns of two flights.
class FlightTies : public ::testing::Test {
 protected:
  FlightTies() : scene_(MakeScene({.num_photos = 10, .num_points = 4000})) {
    for (int i = 0; i < 10; ++i) flights_.push_back(i % 2);
  }

  // Of flight 1 only what these photos see within `half_px` of the middle of their pictures.
  void KeepMiddle(const std::vector<int>& photos, double half_px) {
    const Eigen::Vector2d middle(600, 450);
    for (SceneTrack& track : scene_.tracks) {
      std::erase_if(track.elements, [&](const SceneElement& e) {
        if (flights_[e.photo] == 0) return false;
        if (std::ranges::find(photos, e.photo) == photos.end()) return true;
        const Eigen::Vector2d off = scene_.photos[e.photo].keypoints[e.keypoint] - middle;
        return off.lpNorm<Eigen::Infinity>() > half_px;
      });
    }
  }

  Scene scene_;
  std::vector<int> flights_;
};

TEST_F(FlightTies, HoldWhatSeesTheSame) {
  const auto ties = TiesOfFlights(flights_, scene_);
  ASSERT_EQ(ties.size(), 2U);
  EXPECT_LT(ties[0].position_m, 0.05);
  EXPECT_LT(ties[0].yaw_rad, 0.1 * kDegree);
  EXPECT_GT(ties[0].position_m, 0.001);  // not as sure as hundreds of matches would be
  EXPECT_NEAR(ties[0].yaw_rad, ties[1].yaw_rad, ties[1].yaw_rad);
}

TEST_F(FlightTies, AreWeakWhereOnePhotoSeesAPatch) {
  const auto all = TiesOfFlights(flights_, scene_);
  KeepMiddle({5}, 30);
  const auto patch = TiesOfFlights(flights_, scene_);
  for (const int flight : {0, 1}) {
    EXPECT_GT(patch[flight].yaw_rad, 5 * all[flight].yaw_rad);
    EXPECT_GT(patch[flight].yaw_rad, 0.2 * kDegree);
    EXPECT_LT(patch[flight].yaw_rad, 30 * kDegree);
  }
}

TEST_F(FlightTies, DoNotGrowWithTheKeypointsOfOnePhoto) {
  KeepMiddle({5}, 30);
  const double few = TiesOfFlights(flights_, scene_)[1].yaw_rad;
  const std::vector<SceneTrack> tracks = scene_.tracks;
  for (int copy = 0; copy < 9; ++copy) {
    scene_.tracks.insert(scene_.tracks.end(), tracks.begin(), tracks.end());
  }
  EXPECT_NEAR(TiesOfFlights(flights_, scene_)[1].yaw_rad, few, 1e-6 * few);
}

TEST_F(FlightTies, AreNoneWhereNothingIsShared) {
  KeepMiddle({}, 0);
  const auto ties = TiesOfFlights(flights_, scene_);
  EXPECT_NEAR(ties[1].position_m, std::sqrt(3.0) * FlightTie().position_m, 1);
  EXPECT_NEAR(ties[1].yaw_rad, FlightTie().yaw_rad, 0.01);
}

TEST_F(FlightTies, AreMadeByControlPointsToo) {
  KeepMiddle({}, 0);
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 4, 3), Eigen::Vector3d(5, 1, 2)}) {
    ControlPoint point;
    point.position = place;
    for (const int photo : {1, 3, 7}) {
      point.marks.push_back(
          {photo, *scene_.CameraOf(photo).Project(*scene_.photos[photo].pose * place)});
    }
    scene_.control.points.push_back(point);
  }
  const auto ties = TiesOfFlights(flights_, scene_);
  EXPECT_LT(ties[1].position_m, 0.2);
  EXPECT_LT(ties[1].yaw_rad, 0.2 * kDegree);
  EXPECT_GT(ties[0].yaw_rad, 1 * kDegree);  // marked in no photo of it
}

TEST_F(FlightTies, HoldASingleFlightByDefinition) {
  flights_.assign(10, 0);
  const auto ties = TiesOfFlights(flights_, scene_);
  ASSERT_EQ(ties.size(), 1U);
  EXPECT_EQ(ties[0].position_m, 0);
  EXPECT_EQ(ties[0].yaw_rad, 0);
}

}  // namespace
}  // namespace stucco::test
