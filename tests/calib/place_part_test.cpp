// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/place_part.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/parts/parts.h"
#include "tests/calib/made_parts.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

constexpr int kFirst = 8;

struct Case {
  Scene first;
  Scene second;
  std::vector<PoseRecord> records;
  RecordErrors errors;

  PartPlace Place() const { return PlaceOfPart(records, &errors, second, first); }
};

Case Parted(const Scene& scene) {
  Case c;
  std::vector<int> first;
  std::vector<int> second;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    (i < kFirst ? first : second).push_back(i);
  }
  c.first = SceneOf(scene, first);
  c.second = SceneOf(scene, second);
  c.records = MakeRecords(scene, {.position_sigma_m = 0.5, .attitude_sigma_rad = 0.003});
  FlightErrors flight;
  flight.sigma_horizontal_m = 0.5;
  flight.sigma_vertical_m = 0.5;
  c.errors.flights = {flight};
  c.errors.sigma_attitude_rad = 0.003;
  return c;
}

// The second half `distance_m` from the first.
Case Apart(double distance_m, int num_second = 9) {
  return Parted(Joined(MakeScene({.num_photos = kFirst, .num_points = 300}),
                       MakeScene({.num_photos = num_second, .num_points = 300, .seed = 2}),
                       {distance_m, 0, 0}));
}

TEST(PlaceOfPart, IsAsSureAsTheMeanOfItsRecords) {
  const PartPlace place = Apart(300).Place();
  EXPECT_NEAR(place.position_sigma_m, 0.5 * std::sqrt(3.0 / 9), 1e-9);
  EXPECT_LT(place.rotation_sigma_rad, 0.003 * std::sqrt(3.0 / 9) + 1e-9);
  EXPECT_GT(place.rotation_sigma_rad, 0.5 * 0.003 * std::sqrt(3.0 / 9));
  EXPECT_GE(place.surface_sigma_m, place.position_sigma_m);
  // 1000 pixels of focal length, 20 m away.
  EXPECT_NEAR(place.surface_sigma_px / place.surface_sigma_m, 50, 15);
}

TEST(PlaceOfPart, SharesNothingWithWhatIsFarAway) {
  EXPECT_EQ(Apart(300).Place().shared_surface, 0);
}

TEST(PlaceOfPart, SharesWhatBothSee) {
  const Scene scene = MakeScene({.num_photos = 2 * kFirst, .num_points = 600});
  EXPECT_GT(Parted(Unmatched(scene, kFirst)).Place().shared_surface, 0.6);
}

TEST(PlaceOfPart, AFlightOfItsOwnIsNoSurerThanAPosition) {
  Case c = Apart(300);
  for (size_t i = kFirst; i < c.records.size(); ++i) c.records[i].flight = 1;
  c.errors.flights.push_back(c.errors.flights[0]);
  // 5 m and 10 m are stated.
  EXPECT_NEAR(c.Place().position_sigma_m, std::sqrt(150 + 0.25 * 3 / 9), 1e-6);
}

TEST(PlaceOfPart, WithoutErrorsItsOwnDistancesCount) {
  const Case c = Apart(300, 20);
  const PartPlace place = PlaceOfPart(c.records, nullptr, c.second, c.first);
  EXPECT_NEAR(place.position_sigma_m, 0.5 * std::sqrt(3.0 / 20), 0.08);
}

TEST(PlaceOfPart, NothingIsKnownWithoutPositions) {
  Case c = Apart(300);
  for (size_t i = kFirst; i < c.records.size(); ++i) c.records[i].position.reset();
  EXPECT_LT(c.Place().position_sigma_m, 0);
  EXPECT_LT(c.Place().surface_sigma_m, 0);
}

}  // namespace
}  // namespace stucco::test
