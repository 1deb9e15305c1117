// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "simulate/flight/ground_control.h"
#include "tests/simulate/made_flight.h"

namespace stucco::simulate {
namespace {

Flight MadeFlight() {
  return PrepareFlight(MadePlan(16), MadeSceneInfo(), MadeScene(), {}).flight;
}

TEST(SurveyPoints, LieOnSurfacesThatPhotosShow) {
  const Flight flight = MadeFlight();
  const CastRay cast = MadeScene().cast;
  const GroundControlList list = SurveyPoints(flight, cast, 8);
  ASSERT_EQ(list.points.size(), 8u);
  int checks = 0;
  for (const SurveyedPoint& surveyed : list.points) {
    checks += surveyed.role == PointRole::kCheck ? 1 : 0;
    EXPECT_GE(surveyed.markings.size(), 3u);
    const Eigen::Vector3d point =
        EnuFromGeodetic(flight.georef, surveyed.coordinates.y(), surveyed.coordinates.x(),
                        surveyed.coordinates.z());
    for (const PointMarking& marking : surveyed.markings) {
      const auto photo = std::ranges::find(flight.photos, marking.photo, &FlownPhoto::path);
      ASSERT_NE(photo, flight.photos.end());
      const Eigen::Vector3d center = photo->cam_from_world.Center();
      const auto hit = cast(center, (point - center).normalized());
      ASSERT_TRUE(hit);
      EXPECT_NEAR((hit->point - point).norm(), 0, 0.05);
      const auto pixel = photo->camera.Project(photo->cam_from_world * point);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - marking.pixel).norm(), 3);
    }
  }
  EXPECT_EQ(checks, 2);
}

TEST(SurveyPoints, DependOnTheSeedAlone) {
  const Flight flight = MadeFlight();
  const CastRay cast = MadeScene().cast;
  EXPECT_EQ(GroundControlText(SurveyPoints(flight, cast, 5)),
            GroundControlText(SurveyPoints(flight, cast, 5)));
  Flight other = flight;
  ++other.seed;
  EXPECT_NE(GroundControlText(SurveyPoints(flight, cast, 5)),
            GroundControlText(SurveyPoints(other, cast, 5)));
}

TEST(SurveyPoints, NothingIsMarkedInPhotosThatTheSurveyLacks) {
  Flight flight = MadeFlight();
  flight.photos[0].lost = true;
  flight.photos[1].held_out = true;
  flight.photos[2].duplicate_of = flight.photos[3].path;
  for (const SurveyedPoint& point : SurveyPoints(flight, MadeScene().cast, 6).points) {
    for (const PointMarking& marking : point.markings) {
      for (size_t i = 0; i < 3; ++i) EXPECT_NE(marking.photo, flight.photos[i].path);
    }
  }
  for (FlownPhoto& photo : flight.photos) photo.lost = true;
  EXPECT_TRUE(SurveyPoints(flight, MadeScene().cast, 6).points.empty());
}

}  // namespace
}  // namespace stucco::simulate
