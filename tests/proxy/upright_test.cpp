// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/upright.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

double DegreesBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

Plane MakePlane(const Vector3d& normal, double area) {
  Plane plane;
  plane.normal = normal.normalized();
  plane.area = area;
  return plane;
}

// Photos around the z axis, tilted by `pitch_deg` (positive: into the sky).
std::vector<SurveyPhoto> Around(double pitch_deg, double from_deg, double to_deg) {
  std::vector<SurveyPhoto> photos;
  for (int i = 0; i <= 8; ++i) {
    const double yaw = (from_deg + (to_deg - from_deg) * i / 8) * std::numbers::pi / 180;
    const double pitch = pitch_deg * std::numbers::pi / 180;
    const Vector3d level(std::cos(yaw), std::sin(yaw), 0);
    const Vector3d forward = std::cos(pitch) * level + std::sin(pitch) * Vector3d::UnitZ();
    photos.emplace_back().cam_from_world =
        test::PoseOf(Vector3d::Zero(), forward, level.cross(Vector3d::UnitZ()));
  }
  return photos;
}

void Turn(const Eigen::Matrix3d& rotation, std::vector<SurveyPhoto>& photos) {
  const Similarity turn{1, Eigen::Quaterniond(rotation), Vector3d::Zero()};
  for (SurveyPhoto& photo : photos) photo.cam_from_world = Transformed(photo.cam_from_world, turn);
}

const Eigen::Matrix3d kTurned =
    Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();

TEST(UpFromPhotos, UsesLevelCamerasWhateverTheirPitch) {
  for (const double pitch : {-60.0, -20.0, 0.0, 15.0}) {
    std::vector<SurveyPhoto> photos = Around(pitch, 0, 200);
    Turn(kTurned, photos);
    EXPECT_LT(DegreesBetween(UpFromPhotos(photos).front(), kTurned.col(2)), 3) << pitch;
  }
  EXPECT_TRUE(UpFromPhotos({}).empty());
}

TEST(EstimateUp, RefinesTiltedCamerasByWalls) {
  // A front seen from one side, cameras tilted up by 12 degrees: only the walls know.
  std::vector<SurveyPhoto> photos = Around(12, 60, 120);
  std::vector<Plane> planes = {MakePlane({0, -1, 0}, 100), MakePlane({1, 0, 0}, 30),
                               MakePlane({-1, 0, 0}, 30), MakePlane({0, -0.5, 0.8}, 40)};
  for (Plane& plane : planes) plane.normal = kTurned * plane.normal;
  Turn(kTurned, photos);
  const UpEstimate estimate = EstimateUp(planes, photos);
  EXPECT_LT(DegreesBetween(estimate.up, kTurned.col(2)), 0.1);
  EXPECT_GT(estimate.explained, 0.7);
}

TEST(EstimateUp, LetsGoOfLeaningPlanes) {
  const std::vector<SurveyPhoto> photos = Around(5, 0, 180);
  const std::vector<Plane> planes = {MakePlane({0, -1, 0}, 100), MakePlane({1, 0, 0.001}, 60),
                                     MakePlane({0.6, 0.8, 0.12}, 30)};
  EXPECT_LT(DegreesBetween(EstimateUp(planes, photos).up, Vector3d::UnitZ()), 1.0);
}

TEST(RefineUp, ASiteThatSlopesDoesNotTiltTheWalls) {
  const std::vector<Plane> planes = {MakePlane({0, -1, 0}, 80), MakePlane({1, 0, 0}, 60),
                                     MakePlane({0.03, 0.02, 1}, 40000)};
  const Vector3d up = RefineUp(planes, {Vector3d(-0.02, 0.02, 1).normalized(), 4});
  EXPECT_LT(DegreesBetween(up, Vector3d::UnitZ()), 0.35);
}

// Walls of one house whose panes stand back lean in by what the windows' heights make of it; what
// gimbals know better holds, and many houses outvote what they know less well.
TEST(RefineUp, HoldsWhatIsSurerThanTheWalls) {
  const Vector3d given = Vector3d(0.004, 0, 1).normalized();  // 0.23 degrees
  const std::vector<Plane> house = {MakePlane({0, -1, 0}, 80), MakePlane({1, 0, 0}, 60),
                                    MakePlane({0, 1, 0}, 80), MakePlane({-1, 0, 0}, 60)};
  const Vector3d sure = RefineUp(house, {given, 5, 0.05});
  EXPECT_LT(DegreesBetween(sure, given), 0.03);
  const Vector3d unsure = RefineUp(house, {given, 5, 1.0});
  EXPECT_LT(DegreesBetween(unsure, Vector3d::UnitZ()), 0.05);
  std::vector<Plane> town;
  for (int i = 0; i < 200; ++i) town.insert(town.end(), house.begin(), house.end());
  EXPECT_LT(DegreesBetween(RefineUp(town, {given, 5, 0.05}), Vector3d::UnitZ()), 0.1);
}

TEST(EstimateUp, UsesTheGroundBelowPhotosStraightDown) {
  // Headed north and back south, looking down: the pictures' tops cancel out.
  std::vector<SurveyPhoto> photos = Around(-90, 90, 90);
  const std::vector<SurveyPhoto> back = Around(-90, 270, 270);
  photos.insert(photos.end(), back.begin(), back.end());
  std::vector<Plane> planes = {MakePlane({0, 0, 1}, 500), MakePlane({0.02, 0, 1}, 80)};
  Turn(kTurned, photos);
  for (Plane& plane : planes) plane.normal = kTurned * plane.normal;
  EXPECT_LT(DegreesBetween(EstimateUp(planes, photos).up, kTurned.col(2)), 1.5);
}

TEST(EstimateUp, SaysWhenItKnowsNothing) {
  const UpEstimate estimate = EstimateUp({}, {});
  EXPECT_EQ(estimate.up, Vector3d::UnitZ());
  EXPECT_EQ(estimate.explained, 0);
}

}  // namespace
}  // namespace stucco
