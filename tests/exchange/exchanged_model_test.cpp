// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/exchanged_model.h"

#include <gtest/gtest.h>

#include "tests/exchange/made_model.h"

namespace stucco {
namespace {

// The observations of a point, each moved by `error` off where its photo shows it.
void MoveOff(PointId id, const Eigen::Vector2d& error, Reconstruction& model) {
  for (const TrackElement& element : model.points.at(id).track) {
    RegisteredImage& photo = model.photos.at(element.photo);
    const auto pixel =
        model.cameras.at(photo.camera).Project(photo.cam_from_world * model.points.at(id).position);
    photo.observations[element.observation].pixel = *pixel + error;
  }
}

TEST(MeasurePointErrors, IsTheMeanDistanceOfThePointsThatHaveNone) {
  ExchangedModel exchanged;
  exchanged.model = MadeModel();
  const PointId known = exchanged.model.points.begin()->first;
  const PointId unknown = exchanged.model.points.rbegin()->first;
  ASSERT_NE(known, unknown);
  exchanged.model.points.at(known).error_px = 7;
  exchanged.model.points.at(unknown).error_px = -1;
  MoveOff(unknown, {3, -4}, exchanged.model);
  MeasurePointErrors(exchanged);
  EXPECT_EQ(exchanged.model.points.at(known).error_px, 7);
  EXPECT_NEAR(exchanged.model.points.at(unknown).error_px, 5, 1e-9);
}

TEST(MeasurePointErrorsDeathTest, RequiresCoordinatesInWhichLengthsMeanSomething) {
  ExchangedModel on_a_map;
  on_a_map.model = MadeModel();
  on_a_map.crs = "EPSG:4326";
  EXPECT_DEATH(MeasurePointErrors(on_a_map), "crs");
}

}  // namespace
}  // namespace stucco
