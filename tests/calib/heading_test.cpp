// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/heading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "survey/attitude.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

// Over 90 x 70 m.
Scene MakeFlightOver(int num_photos) {
  Scene scene = MakeScene({.num_photos = num_photos, .num_points = 30});
  for (int i = 0; i < num_photos; ++i) {
    const Eigen::Quaterniond rotation = CamFromEnu({90.0 * (i % 4), -90, 0});
    scene.photos[i].pose =
        Pose{rotation, -(rotation * Eigen::Vector3d(9.0 * (i % 10), 7.0 * (i / 10), 30))};
  }
  return scene;
}

TEST(HeadingByPositions, IsWhatTurnsTheSceneBack) {
  Scene scene = MakeFlightOver(100);
  const auto records = MakeRecords(scene, {});
  for (const double turn : {0.0, 0.5, -4.0}) {
    Scene turned = scene;
    TurnAboutUp(turn * kDegree, turned);
    const SceneHeading heading = HeadingByPositions(records, turned);
    EXPECT_LT(heading.sigma_rad, 0.12 * kDegree);
    EXPECT_NEAR(heading.turn_rad, -turn * kDegree, 3 * heading.sigma_rad);
  }
}

TEST(HeadingByPositions, StatesHowSureItIs) {
  Scene scene = MakeFlightOver(100);
  double squares = 0;
  constexpr int kTimes = 60;
  for (int seed = 1; seed <= kTimes; ++seed) {
    const auto records = MakeRecords(scene, {.seed = static_cast<uint32_t>(seed)});
    const SceneHeading heading = HeadingByPositions(records, scene);
    squares += std::pow(heading.turn_rad / heading.sigma_rad, 2);
  }
  EXPECT_GT(std::sqrt(squares / kTimes), 0.7);
  EXPECT_LT(std::sqrt(squares / kTimes), 1.3);
}

TEST(HeadingByPositions, IsNotTurnedByShiftsOfFlightsOrWildPositions) {
  Scene scene = MakeFlightOver(100);
  auto records = MakeRecords(scene, {});
  for (size_t i = 0; i < records.size(); ++i) {
    records[i].flight = i < 50 ? 0 : 1;
    records[i].position->position.x() += i < 50 ? 3 : -3;
    if (i % 5 == 0) records[i].position->position += Eigen::Vector3d(30, -10, 3);
  }
  const SceneHeading heading = HeadingByPositions(records, scene);
  EXPECT_LT(heading.sigma_rad, 0.3 * kDegree);
  EXPECT_NEAR(heading.turn_rad, 0, 3 * heading.sigma_rad);
}

TEST(HeadingByPositions, TakesSmallFlightsTogether) {
  Scene scene = MakeFlightOver(100);
  auto records = MakeRecords(scene, {});
  for (size_t i = 0; i < records.size(); ++i) records[i].flight = static_cast<int>(i);
  TurnAboutUp(1 * kDegree, scene);
  const SceneHeading heading = HeadingByPositions(records, scene);
  EXPECT_LT(heading.sigma_rad, 0.12 * kDegree);
  EXPECT_NEAR(heading.turn_rad, -1 * kDegree, 3 * heading.sigma_rad);
}

TEST(HeadingByPositions, IsUnknownWithoutPositions) {
  const Scene scene = MakeFlightOver(12);
  auto records = MakeRecords(scene, {});
  for (size_t i = 1; i < records.size(); ++i) records[i].position.reset();
  EXPECT_EQ(HeadingByPositions(records, scene).turn_rad, 0);
  EXPECT_GT(HeadingByPositions(records, scene).sigma_rad, 3);
}

}  // namespace
}  // namespace stucco::test
