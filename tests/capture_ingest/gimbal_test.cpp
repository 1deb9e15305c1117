// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/gimbal.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace stucco {
namespace {

// Rows right, down, forward in east, north, up (docs/formats.md).
Eigen::Matrix3d CameraFromWorld(const GimbalAngles& angles) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double yaw = angles.yaw_deg * kDegree;
  const double pitch = angles.pitch_deg * kDegree;
  const double roll = angles.roll_deg * kDegree;
  const Eigen::Vector3d forward(std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch),
                                std::sin(pitch));
  const Eigen::Vector3d right(std::cos(yaw), -std::sin(yaw), 0);
  const Eigen::Vector3d down = forward.cross(right);
  Eigen::Matrix3d rows;
  rows.row(0) = std::cos(roll) * right + std::sin(roll) * down;
  rows.row(1) = -std::sin(roll) * right + std::cos(roll) * down;
  rows.row(2) = forward;
  return rows;
}

Tags Dji(const char* yaw, const char* pitch, const char* roll) {
  return {{"Xmp.drone-dji.GimbalYawDegree", yaw},
          {"Xmp.drone-dji.GimbalPitchDegree", pitch},
          {"Xmp.drone-dji.GimbalRollDegree", roll},
          {"Xmp.drone-dji.FlightYawDegree", "-33"}};
}

TEST(ReadGimbal, ReadsDji) {
  const auto angles = ReadGimbal(Dji("+106.80", "-90.00", "+0.00")).angles;
  ASSERT_TRUE(angles);
  EXPECT_DOUBLE_EQ(angles->yaw_deg, 106.8);
  EXPECT_DOUBLE_EQ(angles->pitch_deg, -90);
  EXPECT_DOUBLE_EQ(angles->roll_deg, 0);
}

TEST(ReadGimbal, NeverTakesTheBody) {
  EXPECT_FALSE(ReadGimbal({{"Xmp.drone-dji.FlightYawDegree", "12"},
                           {"Xmp.drone-dji.FlightPitchDegree", "1"},
                           {"Xmp.drone-dji.FlightRollDegree", "0"}})
                   .angles);
}

TEST(ReadGimbal, ReadsTheOtherMakers) {
  const auto parrot = ReadGimbal({{"Xmp.drone-parrot.CameraYawDegree", "176.3"},
                                  {"Xmp.drone-parrot.CameraPitchDegree", "-78.4"},
                                  {"Xmp.drone-parrot.CameraRollDegree", "-0.3"}})
                          .angles;
  ASSERT_TRUE(parrot);
  EXPECT_DOUBLE_EQ(parrot->pitch_deg, -78.4);
  const auto skydio =
      ReadGimbal({{"Xmp.drone-skydio.CameraOrientationNED/drone-skydio:Yaw", "127.4"},
                  {"Xmp.drone-skydio.CameraOrientationNED/drone-skydio:Pitch", "-7.5"}})
          .angles;
  ASSERT_TRUE(skydio);
  EXPECT_DOUBLE_EQ(skydio->yaw_deg, 127.4);
  EXPECT_DOUBLE_EQ(skydio->roll_deg, 0);
  EXPECT_TRUE(ReadGimbal({{"Xmp.drone.GimbalYawDegree", "1"}, {"Xmp.drone.GimbalPitchDegree", "2"}})
                  .angles);
}

TEST(ReadGimbal, Pix4dCountsPitchFromStraightDown) {
  const Tags tags = {
      {"Xmp.Camera.Yaw", "-13.305"}, {"Xmp.Camera.Pitch", "5.18"}, {"Xmp.Camera.Roll", "2.73"}};
  const auto angles = ReadGimbal(tags).angles;
  ASSERT_TRUE(angles);
  EXPECT_NEAR(angles->pitch_deg, -84.82, 1e-12);
  EXPECT_DOUBLE_EQ(angles->roll_deg, 2.73);
  Tags sensefly = tags;
  sensefly["Exif.Image.Make"] = "senseFly";
  EXPECT_DOUBLE_EQ(ReadGimbal(sensefly).angles->roll_deg, -2.73);
}

TEST(ReadGimbal, QuarantinesPlaceholdersAndNonsense) {
  EXPECT_FALSE(ReadGimbal(Dji("+0.00", "+0.00", "+0.00")).angles);
  EXPECT_FALSE(ReadGimbal(Dji("+0.00", "+0.00", "+0.00")).doubts.empty());
  EXPECT_FALSE(ReadGimbal(Dji("+1234", "-90", "0")).angles);
  EXPECT_FALSE(ReadGimbal(Dji("abc", "-90", "0")).angles);
  EXPECT_FALSE(ReadGimbal({}).angles);
}

// Close to nadir some gimbals report the yaw the other way round with a roll of 180.
TEST(Normalized, UndoesTheFlipAtNadir) {
  const GimbalAngles flipped{-80, -89.9, 180};
  const GimbalAngles angles = Normalized(flipped);
  EXPECT_NEAR(angles.yaw_deg, 100, 1e-9);
  EXPECT_NEAR(angles.roll_deg, 0, 1e-9);
}

TEST(Normalized, KeepsTheRotation) {
  for (double yaw = -180; yaw <= 180; yaw += 45) {
    for (double pitch = -90; pitch <= 30; pitch += 15) {
      for (const double roll : {-180.0, -170.0, -30.0, 0.0, 5.0, 120.0, 180.0}) {
        const GimbalAngles angles{yaw, pitch, roll};
        const Eigen::Matrix3d difference =
            CameraFromWorld(angles) - CameraFromWorld(Normalized(angles));
        EXPECT_LT(difference.norm(), 1e-12) << yaw << " " << pitch << " " << roll;
      }
    }
  }
}

}  // namespace
}  // namespace stucco
