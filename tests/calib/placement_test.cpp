// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace stucco::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Georef Place() {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 52;
  georef.origin_longitude_deg = 4;
  georef.origin_height_m = 20;
  return georef;
}

// Level photos on an arc about the origin that look at it, where they recorded to be.
struct Survey {
  explicit Survey(int photos) {
    for (int i = 0; i < photos; ++i) {
      const double turn = 0.3 * i;
      Add(30 * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.1 * (i % 3)), turn);
    }
  }

  void Add(const Eigen::Vector3d& centre, double turn) {
    const PhotoId id{static_cast<uint32_t>(model.photos.size() + 1)};
    RegisteredImage& photo = model.photos[id];
    photo.id = id;
    photo.name = "p" + std::to_string(id.value) + ".jpg";
    Eigen::Matrix3d rotation;
    rotation << -std::sin(turn), std::cos(turn), 0, 0, 0, -1, -std::cos(turn), -std::sin(turn), 0;
    photo.cam_from_world.rotation = Eigen::Quaterniond(rotation);
    photo.cam_from_world.translation = -(photo.cam_from_world.rotation * centre);
    CapturedPhoto capture;
    capture.path = photo.name;
    const Eigen::Vector3d geodetic = GeodeticFromEnu(Place(), centre);
    capture.position = GeoPosition{.latitude_deg = geodetic[0],
                                   .longitude_deg = geodetic[1],
                                   .height_m = geodetic[2],
                                   .has_height = true,
                                   .sigma_horizontal_m = 0.5,
                                   .sigma_vertical_m = 0.5};
    capture.gimbal = GimbalAngles{.yaw_deg = 270 - turn * 180 / std::numbers::pi};
    captures.photos.push_back(capture);
  }

  // A frame of its own, as another program leaves it.
  void Lose() {
    Similarity away;
    away.scale = 0.04;
    away.rotation = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -1, 0.4).normalized());
    away.translation = {12, -40, 15};
    Transform(away, model);
  }

  Eigen::Vector3d CentreInPlace(int index) const {
    const GeoPosition& recorded = *captures.photos[index].position;
    return EnuFromGeodetic(Place(), recorded.latitude_deg, recorded.longitude_deg,
                           recorded.height_m);
  }

  Captures captures;
  Reconstruction model;
};

TEST(Placement, BringsAModelToItsPositions) {
  Survey survey(8);
  survey.Lose();
  const ModelPlace place = PlaceByRecords(survey.captures, survey.model);
  EXPECT_THAT(place.why_not, IsEmpty());
  EXPECT_THAT(place.outliers, IsEmpty());
  EXPECT_EQ(place.georef.frame, "enu");
  EXPECT_TRUE(place.georef.metric);
  EXPECT_EQ(place.georef.source, "gps");
  Transform(place.world_from_model, survey.model);
  int i = 0;
  for (const auto& [id, photo] : survey.model.photos) {
    const Eigen::Vector3d geodetic = GeodeticFromEnu(place.georef, photo.cam_from_world.Center());
    const Eigen::Vector3d centre = EnuFromGeodetic(Place(), geodetic[0], geodetic[1], geodetic[2]);
    EXPECT_LT((centre - survey.CentreInPlace(i++)).norm(), 1e-6);
  }
  const PositionDifferences differences =
      CompareWithPositions(survey.captures, place.georef, survey.model, {});
  EXPECT_EQ(differences.distance_m.size(), 8u);
  EXPECT_LT(differences.rms_horizontal_m, 1e-6);
  EXPECT_LT(differences.rms_vertical_m, 1e-6);
}

TEST(Placement, NamesPositionsThatContradictTheOthers) {
  Survey survey(8);
  survey.captures.photos[5].position->height_m += 100;
  survey.Lose();
  const ModelPlace place = PlaceByRecords(survey.captures, survey.model);
  EXPECT_EQ(place.georef.frame, "enu");
  EXPECT_THAT(place.outliers, ElementsAre("p6.jpg"));
  Transform(place.world_from_model, survey.model);
  PositionDifferences differences =
      CompareWithPositions(survey.captures, place.georef, survey.model, place.outliers);
  EXPECT_NEAR(differences.distance_m.at("p6.jpg"), 100, 1e-3);
  EXPECT_LT(differences.rms_vertical_m, 1e-3);
  differences = CompareWithPositions(survey.captures, place.georef, survey.model, {});
  EXPECT_NEAR(differences.rms_vertical_m, 100 / std::sqrt(8.0), 1e-3);
}

TEST(Placement, WithoutPositionsOnlyUpIsKnown) {
  Survey survey(8);
  for (CapturedPhoto& photo : survey.captures.photos) photo.position.reset();
  const ModelPlace place = PlaceByRecords(survey.captures, survey.model);
  EXPECT_EQ(place.georef.frame, "arbitrary");
  EXPECT_FALSE(place.georef.metric);
  EXPECT_EQ(place.georef.source, "gimbal");
  ASSERT_TRUE(place.georef.up);
  EXPECT_LT((*place.georef.up - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_EQ(place.world_from_model.scale, 1);
  EXPECT_THAT(place.why_not, HasSubstr("fewer than three"));
}

TEST(Placement, PositionsThatContradictTheModelChangeNothing) {
  Survey survey(8);
  for (size_t i = 0; i < survey.captures.photos.size(); ++i) {
    survey.captures.photos[i].position->latitude_deg += 0.01 * std::sin(7.0 * i * i);
    survey.captures.photos[i].gimbal.reset();
  }
  const ModelPlace place = PlaceByRecords(survey.captures, survey.model);
  EXPECT_EQ(place.georef.frame, "arbitrary");
  EXPECT_EQ(place.georef.source, "none");
  EXPECT_THAT(place.why_not, HasSubstr("contradict"));
}

TEST(Placement, OnOneLineTheGimbalSaysWhereUpIs) {
  Survey survey(0);
  for (int i = 0; i < 8; ++i) survey.Add({10.0 * i, 0, 0}, 0.3 * i);
  survey.Lose();
  Survey without = survey;
  EXPECT_EQ(PlaceByRecords(survey.captures, survey.model).georef.frame, "enu");
  for (CapturedPhoto& photo : without.captures.photos) photo.gimbal.reset();
  const ModelPlace place = PlaceByRecords(without.captures, without.model);
  EXPECT_EQ(place.georef.frame, "arbitrary");
  EXPECT_TRUE(place.georef.metric);
  EXPECT_NEAR(place.world_from_model.scale, 25, 1e-6);
  EXPECT_THAT(place.why_not, HasSubstr("along one line"));
}

TEST(Placement, PhotosThatIngestDoesNotKnowTakeNoPart) {
  Survey survey(8);
  survey.captures.photos.resize(2);
  EXPECT_THAT(PlaceByRecords(survey.captures, survey.model).why_not, HasSubstr("fewer than three"));
}

}  // namespace
}  // namespace stucco::test
