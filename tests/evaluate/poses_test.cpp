// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void Turn(double angle_deg, RegisteredImage& photo) {
  const Vector3d centre = photo.cam_from_world.Center();
  photo.cam_from_world.rotation =
      Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, Vector3d::UnitX()) *
      photo.cam_from_world.rotation;
  photo.cam_from_world.translation = -(photo.cam_from_world.rotation * centre);
}

void Shift(const Vector3d& by, RegisteredImage& photo) {
  photo.cam_from_world.translation -= photo.cam_from_world.rotation * by;
}

TEST(ComparePoses, TruthHasNoError) {
  const simulate::Flight flight = MadeFlight();
  const PoseComparison found =
      ComparePoses(MadeReconstruction(flight), MadeGeoref(), flight, MadeGeoref());
  EXPECT_EQ(found.figures.posed, 13);
  EXPECT_EQ(found.figures.total, 13);
  EXPECT_NEAR(found.figures.position_mean_m, 0, 1e-9);
  EXPECT_NEAR(found.figures.position_max_m, 0, 1e-9);
  EXPECT_NEAR(found.figures.rotation_max_deg, 0, 1e-5);
  EXPECT_NEAR(found.figures.georeferenced_mean_m, 0, 1e-6);
  EXPECT_THAT(found.notes, IsEmpty());
}

TEST(ComparePoses, NeitherDoesItInAnotherFrame) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  Transform(AnySimilarity(), result);
  Georef arbitrary;
  const PoseComparison found = ComparePoses(result, arbitrary, flight, MadeGeoref());
  EXPECT_NEAR(found.figures.position_max_m, 0, 1e-9);
  EXPECT_NEAR(found.figures.rotation_max_deg, 0, 1e-5);
  EXPECT_TRUE(std::isnan(found.figures.georeferenced_mean_m));
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_THAT(found.notes[0], HasSubstr("survey is \"arbitrary\""));
  ASSERT_TRUE(found.truth_from_world);
  EXPECT_NEAR(found.truth_from_world->scale, 1 / 0.4, 1e-9);
}

TEST(ComparePoses, AShiftIsSeenInTheFramesAsTheyAre) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  Transform({.scale = 1, .rotation = Eigen::Quaterniond::Identity(), .translation = {3, 4, 0}},
            result);
  const PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_NEAR(found.figures.position_max_m, 0, 1e-9);
  EXPECT_NEAR(found.figures.georeferenced_mean_m, 5, 1e-6);
}

TEST(ComparePoses, FramesWithOtherOriginsMeet) {
  const simulate::Flight flight = MadeFlight();
  Georef survey = MadeGeoref();
  survey.origin_latitude_deg += 0.001;
  survey.origin_height_m -= 30;
  Reconstruction result = MadeReconstruction(flight);
  for (auto& [id, photo] : result.photos) {
    const Vector3d centre = photo.cam_from_world.Center();
    Shift(BetweenFrames(MadeGeoref(), survey, centre) - centre, photo);
  }
  const PoseComparison found = ComparePoses(result, survey, flight, MadeGeoref());
  EXPECT_NEAR(found.figures.georeferenced_mean_m, 0, 1e-6);
  // Cameras that were not turned along with the tangent plane are off by its tilt.
  EXPECT_NEAR(found.figures.georeferenced_rotation_max_deg, 0.001, 1e-5);
}

TEST(ComparePoses, OneWrongPositionIsReportedAndSpoilsNoOther) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  Shift({0, 0, 7}, result.photos.begin()->second);
  const PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_NEAR(found.figures.position_max_m, 7, 1e-9);
  EXPECT_NEAR(found.figures.position_mean_m, 7.0 / 13, 1e-9);
  EXPECT_NEAR(found.figures.georeferenced_mean_m, 7.0 / 13, 1e-6);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_THAT(found.notes[0], HasSubstr("1 of 13 positions are much worse than the others"));
  EXPECT_THAT(found.notes[0], HasSubstr("by 7.000 to 7.000 m, ring00.jpg most"));
}

// A survey whose world is turned is right after the alignment and wrong as it is georeferenced.
TEST(ComparePoses, AGeoreferenceThatIsTurnedShows) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  Similarity turn;
  turn.rotation = Eigen::AngleAxisd(std::numbers::pi / 180, Vector3d::UnitZ());
  Transform(turn, result);
  const PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_NEAR(found.figures.rotation_max_deg, 0, 1e-5);
  EXPECT_NEAR(found.figures.georeferenced_rotation_mean_deg, 1, 1e-5);
  EXPECT_NEAR(found.figures.georeferenced_rotation_max_deg, 1, 1e-5);
  double farthest_m = 0;
  for (const simulate::FlownPhoto& photo : flight.photos) {
    farthest_m = std::max(farthest_m, photo.cam_from_world.Center().head<2>().norm());
  }
  EXPECT_NEAR(found.figures.georeferenced_max_m, 2 * std::sin(std::numbers::pi / 360) * farthest_m,
              1e-6);
}

TEST(ComparePoses, TurnedCamerasHaveTheAngle) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  for (auto& [id, photo] : result.photos) Turn(2, photo);
  Turn(3, result.photos.begin()->second);
  const PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_NEAR(found.figures.position_max_m, 0, 1e-9);
  EXPECT_NEAR(found.figures.rotation_max_deg, 5, 1e-5);
  EXPECT_NEAR(found.figures.rotation_mean_deg, 2 + 3.0 / 13, 1e-5);
}

// What bench/eval_poses.py finds for the same cameras and errors.
TEST(ComparePoses, AgreesWithAnIndependentProgram) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  int i = 0;
  for (auto& [id, photo] : result.photos) {
    Turn(0.05 * std::sin(5 * i), photo);
    Shift(0.1 * Vector3d(std::sin(7 * i + 1), std::sin(11 * i + 2), std::sin(13 * i + 3)), photo);
    ++i;
  }
  const PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_NEAR(found.figures.position_mean_m, 0.08593279810578638, 1e-9);
  EXPECT_NEAR(found.figures.position_max_m, 0.149177489112255, 1e-9);
  EXPECT_NEAR(found.figures.rotation_mean_deg, 0.10092884726588422, 1e-7);
  EXPECT_NEAR(found.figures.rotation_max_deg, 0.13929507755984072, 1e-7);
  EXPECT_NEAR(found.truth_from_world->scale, 0.9992670062317204, 1e-9);
}

TEST(ComparePoses, CountsThePhotosThatTheSurveyWasGiven) {
  simulate::Flight flight = MadeFlight();
  flight.photos[1].lost = true;
  flight.photos[2].held_out = true;
  Reconstruction result = MadeReconstruction(flight);
  result.photos.erase(result.photos.begin());
  const PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_EQ(found.figures.posed, 10);
  EXPECT_EQ(found.figures.total, 11);
}

TEST(ComparePoses, FindsPhotosThatWereMovedToAnotherFolder) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  for (auto& [id, photo] : result.photos)
    photo.name = "flight 1/" + photo.name.substr(photo.name.rfind('/') + 1);
  EXPECT_EQ(ComparePoses(result, MadeGeoref(), flight, MadeGeoref()).figures.posed, 13);
}

TEST(ComparePoses, SaysWhatCannotBeMeasured) {
  const simulate::Flight flight = MadeFlight();
  Reconstruction result = MadeReconstruction(flight);
  for (auto& [id, photo] : result.photos) photo.name += ".png";
  PoseComparison found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_EQ(found.figures.posed, 0);
  EXPECT_TRUE(std::isnan(found.figures.position_mean_m));
  EXPECT_FALSE(found.truth_from_world);
  EXPECT_EQ(found.notes.size(), 2u);
  result = MadeReconstruction(flight);
  while (result.photos.size() > 2) result.photos.erase(result.photos.begin());
  found = ComparePoses(result, MadeGeoref(), flight, MadeGeoref());
  EXPECT_EQ(found.figures.posed, 2);
  EXPECT_FALSE(found.truth_from_world);
  EXPECT_NEAR(found.figures.georeferenced_mean_m, 0, 1e-6);
}

}  // namespace
}  // namespace stucco::evaluate
