// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/barometer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/records/records.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

constexpr double kTakeoff_m = 230;
constexpr double kStep_s = 5;  // between two photos

// Above the takeoff: two photos at each height.
double TrueHeight_m(int photo) {
  return 20 + 4.0 * (photo / 2 % 7);
}

struct MadeHeights {
  double satellite_sigma_m = 3;
  double barometer_sigma_m = 0.1;
  double drift_m = 0;  // of the barometer over the flight
};

Captures MakeCaptures(int num_photos, const MadeHeights& made) {
  Random random(5);
  Captures captures;
  captures.cameras.emplace_back();
  for (int i = 0; i < num_photos; ++i) {
    const int seconds = static_cast<int>(kStep_s) * i;
    CapturedPhoto photo;
    photo.path = fmt::format("{:03}.jpg", i);
    photo.usable = true;
    photo.camera = 0;
    photo.capture_time = fmt::format("2026:04:30 10:{:02}:{:02}", seconds / 60, seconds % 60);
    photo.position = GeoPosition{.latitude_deg = 48, .longitude_deg = 16};
    photo.position->height_m = kTakeoff_m + TrueHeight_m(i) + random.Gauss(made.satellite_sigma_m);
    photo.position->has_height = true;
    photo.height_above_takeoff_m =
        TrueHeight_m(i) + made.drift_m * i / num_photos + random.Gauss(made.barometer_sigma_m);
    captures.photos.push_back(photo);
  }
  return captures;
}

// Largest error of any height.
double MostOff_m(const Captures& captures) {
  double most = 0;
  for (size_t i = 0; i < captures.photos.size(); ++i) {
    const double is_m = captures.photos[i].position->height_m;
    const double true_m = kTakeoff_m + TrueHeight_m(static_cast<int>(i));
    most = std::max(most, std::abs(is_m - true_m));
  }
  return most;
}

// Whether heights are as they were recorded.
bool LeavesHeights(Captures captures) {
  const Captures before = captures;
  const SteadiedHeights steadied = SteadyHeights(nullptr, captures);
  for (size_t i = 0; i < captures.photos.size(); ++i) {
    if (captures.photos[i].position->height_m != before.photos[i].position->height_m) return false;
  }
  return steadied.num_photos == 0;
}

TEST(SteadyHeights, ScatterAsBarometersDo) {
  Captures captures = MakeCaptures(100, {});
  EXPECT_GT(MostOff_m(captures), 5);
  const SteadiedHeights steadied = SteadyHeights(nullptr, captures);
  EXPECT_EQ(steadied.num_photos, 100);
  EXPECT_NEAR(steadied.scatter_m, 3, 0.8);
  // The zero of all is as good as the mean of a hundred.
  EXPECT_NEAR(steadied.zero_sigma_m[7], 1.25 * 3 / 10, 0.1);
  EXPECT_LT(MostOff_m(captures), 3 * steadied.zero_sigma_m[7] + 0.35);
  EXPECT_NEAR(captures.photos[7].position->sigma_vertical_m, 1.07, 0.03);
  const double step_m =
      captures.photos[14].position->height_m - captures.photos[0].position->height_m;
  EXPECT_NEAR(step_m, 0, 0.6);
}

TEST(SteadyHeights, FollowASureDrift) {
  Captures captures = MakeCaptures(100, {.satellite_sigma_m = 1, .drift_m = 4});
  ASSERT_EQ(SteadyHeights(nullptr, captures).num_photos, 100);
  EXPECT_LT(MostOff_m(captures), 1);
}

TEST(SteadyHeights, AreGivenToPhotosWithout) {
  Captures captures = MakeCaptures(60, {});
  captures.photos[20].position->has_height = false;
  captures.photos[20].position->height_m = 0;
  ASSERT_EQ(SteadyHeights(nullptr, captures).num_photos, 60);
  EXPECT_TRUE(captures.photos[20].position->has_height);
  EXPECT_NEAR(captures.photos[20].position->height_m, kTakeoff_m + TrueHeight_m(20), 2);
}

TEST(SteadyHeights, HaveAZeroOfTheirOwnInEachFlight) {
  Captures captures = MakeCaptures(120, {.satellite_sigma_m = 1});
  for (size_t i = 60; i < captures.photos.size(); ++i) {
    captures.photos[i].capture_time.replace(11, 2, "12");
    *captures.photos[i].height_above_takeoff_m -= 12;
  }
  ASSERT_EQ(SteadyHeights(nullptr, captures).num_photos, 120);
  EXPECT_LT(MostOff_m(captures), 1);
}

TEST(SteadyHeights, StayWhereTheBarometerIsTheRougher) {
  EXPECT_TRUE(LeavesHeights(MakeCaptures(100, {.satellite_sigma_m = 0.3, .barometer_sigma_m = 2})));
}

TEST(SteadyHeights, StayByRtk) {
  Captures captures = MakeCaptures(100, {});
  for (CapturedPhoto& photo : captures.photos) photo.position->sigma_vertical_m = 0.03;
  EXPECT_TRUE(LeavesHeights(captures));
}

TEST(SteadyHeights, StayWhereTheBarometerSaysTheSameOfAll) {
  Captures captures = MakeCaptures(100, {.satellite_sigma_m = 0.7});
  for (CapturedPhoto& photo : captures.photos) photo.height_above_takeoff_m = 30;
  EXPECT_TRUE(LeavesHeights(captures));
}

TEST(SteadyHeights, StayWhereTheOtherIsAboveTheGround) {
  Captures captures = MakeCaptures(100, {.satellite_sigma_m = 0.7});
  for (size_t i = 0; i < captures.photos.size(); ++i) {
    const double slope_m = 10 * std::sin(0.06 * static_cast<double>(i));
    *captures.photos[i].height_above_takeoff_m -= slope_m;
  }
  EXPECT_TRUE(LeavesHeights(captures));
}

TEST(SteadyHeights, StayInShortFlights) {
  EXPECT_TRUE(LeavesHeights(MakeCaptures(7, {})));
}

TEST(ApplyRecords, HeightsByBarometersAreNoBetterThanTheirZero) {
  Scene scene = MakeScene({.num_photos = 3, .num_points = 5});
  std::vector<PoseRecord> records(3);
  for (PoseRecord& record : records) record.position = PositionPrior{};
  records[1].height_zero_sigma_m = 0.4;
  RecordErrors errors;
  errors.flights.resize(1);
  errors.flights[0].vertical_over_stated = 0.03;
  ApplyRecords(records, errors, scene);
  EXPECT_NEAR(scene.photos[0].prior->sigma_vertical_m, 0.3, 1e-9);
  EXPECT_NEAR(scene.photos[1].prior->sigma_vertical_m, 0.5, 1e-9);
}

}  // namespace
}  // namespace stucco::test
