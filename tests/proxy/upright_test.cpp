// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/upright.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace stucco {
namespace {

using Eigen::Vector3d;

double AngleDeg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

Plane MakePlane(const Vector3d& normal, double area) {
  Plane plane;
  plane.normal = normal.normalized();
  plane.area = area;
  return plane;
}

// Photos around the z axis, tilted by `pitch_deg` (positive: into the sky).
Stations Around(double pitch_deg, double from_deg, double to_deg) {
  Stations stations;
  for (int i = 0; i <= 8; ++i) {
    const double yaw = (from_deg + (to_deg - from_deg) * i / 8) * std::numbers::pi / 180;
    const double pitch = pitch_deg * std::numbers::pi / 180;
    const Vector3d level(std::cos(yaw), std::sin(yaw), 0);
    const Vector3d forward = std::cos(pitch) * level + std::sin(pitch) * Vector3d::UnitZ();
    Station station;
    station.right = level.cross(Vector3d::UnitZ());
    station.upwards = station.right.cross(forward);
    station.backwards = -forward;
    stations.all.push_back(station);
  }
  return stations;
}

void Turn(const Eigen::Matrix3d& rotation, Stations& stations) {
  for (Station& s : stations.all) {
    s.right = rotation * s.right;
    s.upwards = rotation * s.upwards;
    s.backwards = rotation * s.backwards;
  }
}

const Eigen::Matrix3d kTurned =
    Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();

TEST(UpFromStations, UsesLevelCamerasWhateverTheirPitch) {
  for (const double pitch : {-60.0, -20.0, 0.0, 15.0}) {
    Stations stations = Around(pitch, 0, 200);
    Turn(kTurned, stations);
    EXPECT_LT(AngleDeg(UpFromStations(stations).front(), kTurned.col(2)), 3) << pitch;
  }
  EXPECT_TRUE(UpFromStations({}).empty());
}

TEST(EstimateUp, RefinesTiltedCamerasByWalls) {
  // A front seen from one side, cameras tilted up by 12 degrees: only the walls know.
  Stations stations = Around(12, 60, 120);
  std::vector<Plane> planes = {MakePlane({0, -1, 0}, 100), MakePlane({1, 0, 0}, 30),
                               MakePlane({-1, 0, 0}, 30), MakePlane({0, -0.5, 0.8}, 40)};
  for (Plane& plane : planes) plane.normal = kTurned * plane.normal;
  Turn(kTurned, stations);
  const UpEstimate estimate = EstimateUp(planes, stations);
  EXPECT_LT(AngleDeg(estimate.up, kTurned.col(2)), 0.1);
  EXPECT_GT(estimate.explained, 0.7);
}

TEST(EstimateUp, LetsGoOfLeaningPlanes) {
  const Stations stations = Around(5, 0, 180);
  const std::vector<Plane> planes = {MakePlane({0, -1, 0}, 100), MakePlane({1, 0, 0.001}, 60),
                                     MakePlane({0.6, 0.8, 0.12}, 30)};
  EXPECT_LT(AngleDeg(EstimateUp(planes, stations).up, Vector3d::UnitZ()), 1.0);
}

TEST(RefineUp, ASiteThatSlopesDoesNotTiltTheWalls) {
  const std::vector<Plane> planes = {MakePlane({0, -1, 0}, 80), MakePlane({1, 0, 0}, 60),
                                     MakePlane({0.03, 0.02, 1}, 40000)};
  const Vector3d up = RefineUp(planes, Vector3d(-0.02, 0.02, 1).normalized(), 4);
  EXPECT_LT(AngleDeg(up, Vector3d::UnitZ()), 0.35);
}

TEST(EstimateUp, UsesTheGroundBelowPhotosStraightDown) {
  // Headed north and back south, looking down: the pictures' tops cancel out.
  Stations stations = Around(-90, 90, 90);
  const Stations back = Around(-90, 270, 270);
  stations.all.insert(stations.all.end(), back.all.begin(), back.all.end());
  std::vector<Plane> planes = {MakePlane({0, 0, 1}, 500), MakePlane({0.02, 0, 1}, 80)};
  Turn(kTurned, stations);
  for (Plane& plane : planes) plane.normal = kTurned * plane.normal;
  EXPECT_LT(AngleDeg(EstimateUp(planes, stations).up, kTurned.col(2)), 1.5);
}

TEST(EstimateUp, SaysWhenItKnowsNothing) {
  const UpEstimate estimate = EstimateUp({}, {});
  EXPECT_EQ(estimate.up, Vector3d::UnitZ());
  EXPECT_EQ(estimate.explained, 0);
}

}  // namespace
}  // namespace stucco
