// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plan/field/sun_window.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

SunDay Day(int year, unsigned month, unsigned day) {
  return SunOn({std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)});
}

// A sun that stands over the equator, and sundials that are right.
SunDay Equinox() {
  return {{}, 0, 0};
}

// Meeus, example 25.a: 1992 October 13 at 0 TD has a declination of -7.78507 degrees; noon is half
// a day later, in which the sun sinks by 0.19 degrees. Example 28.a: the equation of time is 13 min
// 42.6 s, and grows by 14 s a day.
TEST(SunOn, AgreesWithMeeus) {
  const SunDay day = Day(1992, 10, 13);
  EXPECT_NEAR(day.declination_rad / kDegree, -7.78507 - 0.187, 0.005);
  EXPECT_NEAR(day.equation_of_time_min, 13.71 + 0.11, 0.03);
}

TEST(SunOn, TurnsAtTheSolstices) {
  EXPECT_NEAR(Day(2026, 6, 21).declination_rad / kDegree, 23.437, 0.005);
  EXPECT_NEAR(Day(2026, 12, 21).declination_rad / kDegree, -23.437, 0.005);
  EXPECT_NEAR(Day(2026, 3, 20).declination_rad / kDegree, 0, 0.1);
}

TEST(SolarNoonUtc, FollowsTheLongitude) {
  EXPECT_DOUBLE_EQ(SolarNoonUtc(Equinox(), 0), 720);
  EXPECT_DOUBLE_EQ(SolarNoonUtc(Equinox(), 15), 660);
  EXPECT_DOUBLE_EQ(SolarNoonUtc(Equinox(), -180), 0);
  EXPECT_LT(SolarNoonUtc(Day(2026, 11, 3), 0), 720 - 16);  // sundials are ahead in November
}

TEST(SunOnWall, ANorthWallHasNoneInWinter) {
  for (const SunDay& day : {Equinox(), Day(2026, 12, 21)}) {
    const SunWindow window = SunOnWall(day, 50, 0);
    EXPECT_TRUE(window.hours.empty());
    EXPECT_FALSE(window.grazes);
  }
}

TEST(SunOnWall, ANorthWallHasMorningsAndEveningsInSummer) {
  const SunWindow window = SunOnWall(Day(2026, 6, 21), 50, 0);
  ASSERT_EQ(window.hours.size(), 2u);
  EXPECT_LT(window.hours[0].to_h, 8);
  EXPECT_GT(window.hours[1].from_h, 16);
  EXPECT_NEAR(window.hours[0].to_h - window.hours[0].from_h,
              window.hours[1].to_h - window.hours[1].from_h, 1.0 / 60);
}

// At the equinox the sun is at hour angle h in the direction (-sin h, -sin l cos h, cos l cos h):
// 10 degrees in front of a south wall while cos h >= sin 10 / sin l, 5 degrees up while cos h >=
// sin 5 / cos l.
TEST(SunOnWall, ASouthWallHasNoon) {
  const double latitude = 50;
  const double least = std::max(std::sin(10 * kDegree) / std::sin(latitude * kDegree),
                                std::sin(5 * kDegree) / std::cos(latitude * kDegree));
  const double half_h = std::acos(least) / kDegree / 15;
  const SunWindow window = SunOnWall(Equinox(), latitude, 180);
  ASSERT_EQ(window.hours.size(), 1u);
  EXPECT_NEAR(window.hours[0].from_h, 12 - half_h, 1.0 / 60);
  EXPECT_NEAR(window.hours[0].to_h, 12 + half_h, 1.0 / 60);
}

TEST(SunOnWall, EastIsWestInTheMirror) {
  const SunDay day = Day(2026, 5, 1);
  const SunWindow east = SunOnWall(day, 50, 90);
  const SunWindow west = SunOnWall(day, 50, 270);
  ASSERT_EQ(east.hours.size(), 1u);
  ASSERT_EQ(west.hours.size(), 1u);
  EXPECT_LT(east.hours[0].to_h, 12);
  EXPECT_NEAR(east.hours[0].from_h, 24 - west.hours[0].to_h, 1.0 / 60 + 1e-9);
  EXPECT_NEAR(east.hours[0].to_h, 24 - west.hours[0].from_h, 1.0 / 60 + 1e-9);
}

TEST(SunOnWall, SouthernWinterShinesOnNorthWalls) {
  const SunWindow window = SunOnWall(Day(2026, 6, 21), -35, 0);
  ASSERT_EQ(window.hours.size(), 1u);
  EXPECT_LT(window.hours[0].from_h, 12);
  EXPECT_GT(window.hours[0].to_h, 12);
  EXPECT_TRUE(SunOnWall(Day(2026, 6, 21), -35, 180).hours.empty());
}

// At the equator in June the sun rises 23 degrees north of east: it gets no farther in front of a
// wall that faces 105 degrees than 90 - (105 - 66.6) at sunrise; one that faces 150 it only grazes.
TEST(SunOnWall, RakingLightIsNoSunshine) {
  EXPECT_FALSE(SunOnWall(Day(2026, 6, 21), 0, 105).hours.empty());
  const SunWindow window = SunOnWall(Day(2026, 6, 21), 0, 150);
  EXPECT_TRUE(window.hours.empty());
  EXPECT_TRUE(window.grazes);
}

TEST(SunOnWall, PolarDayAndNight) {
  EXPECT_TRUE(SunOnWall(Day(2026, 12, 21), 78, 180).hours.empty());
  const SunWindow midnight = SunOnWall(Day(2026, 6, 21), 78, 0);
  ASSERT_EQ(midnight.hours.size(), 2u);
  EXPECT_EQ(midnight.hours.front().from_h, 0);
  EXPECT_EQ(midnight.hours.back().to_h, 24);
}

TEST(SunDays, AreThreeOrTheOneAskedFor) {
  ASSERT_EQ(SunDays("").size(), 3u);
  const auto days = SunDays("2024-02-29");
  ASSERT_EQ(days.size(), 1u);
  EXPECT_EQ(days[0].date, std::chrono::year(2024) / 2 / 29);
}

TEST(SunDays, RefuseWhatIsNoDay) {
  for (const char* text : {"2026-02-29", "2026-13-01", "2026-6-21", "21.06.2026", "2026-06-2x",
                           "tomorrow", "1900-01-01", "2026-06-21 "}) {
    EXPECT_THROW(SunDays(text), Error) << text;
  }
}

}  // namespace
}  // namespace stucco::plan
