// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "simulate/flight/daylight.h"
#include "simulate/flight/schedule.h"
#include "survey/error.h"
#include "tests/simulate/made_flight.h"

namespace stucco::simulate {
namespace {

TEST(Schedule, WithoutNoiseItIsThePlan) {
  FlightOptions options;
  options.position_sigma_m = 0;
  options.gimbal_sigma_deg = 0;
  Plan plan = MadePlan(8);
  std::reverse(plan.views.begin(), plan.views.end());  // the order is in `order`
  const auto shots = ScheduleShots(plan, options);
  ASSERT_EQ(shots.size(), 8u);
  for (size_t i = 0; i < shots.size(); ++i) {
    const PlannedView& view = plan.views[shots[i].view];
    EXPECT_EQ(view.order, static_cast<int>(i));
    EXPECT_EQ(shots[i].position_m, view.position_m);
    EXPECT_EQ(shots[i].angles.yaw_deg, view.yaw_deg);
    EXPECT_EQ(shots[i].angles.pitch_deg, view.pitch_deg);
    EXPECT_EQ(shots[i].angles.roll_deg, 0);
    EXPECT_EQ(shots[i].number, static_cast<int>(i) + 1);
    if (i > 0) {
      EXPECT_GT(shots[i].time_s, shots[i - 1].time_s + 1);
    }
  }
  EXPECT_EQ(shots[0].hour, 10);
}

TEST(Schedule, NoiseHasItsSizeAndAStopItsOwn) {
  const Plan plan = MadePlan(4000);
  FlightOptions options;
  options.position_sigma_m = 0.3;
  options.gimbal_sigma_deg = 0.5;
  const auto shots = ScheduleShots(plan, options);
  double position2 = 0, yaw2 = 0, within2 = 0;
  for (size_t i = 0; i < shots.size(); ++i) {
    const PlannedView& view = plan.views[shots[i].view];
    const Eigen::Vector3d moved = shots[i].position_m - view.position_m;
    position2 += moved.squaredNorm() / 3;
    yaw2 += std::pow(shots[i].angles.yaw_deg - view.yaw_deg, 2);
    if (i % 2 == 1) {
      const PlannedView& first = plan.views[shots[i - 1].view];
      within2 += (moved - (shots[i - 1].position_m - first.position_m)).squaredNorm() / 3;
    }
  }
  EXPECT_NEAR(std::sqrt(position2 / 4000), 0.3, 0.015);
  EXPECT_NEAR(std::sqrt(yaw2 / 4000), 0.5, 0.02);
  EXPECT_NEAR(std::sqrt(within2 / 2000), 0.3 * 0.1 * std::sqrt(2), 0.003);
}

TEST(Schedule, LosesAndRepeatsExactlyTheShare) {
  FlightOptions options;
  options.lost_share = 0.1;
  options.duplicate_share = 0.2;
  const auto shots = ScheduleShots(MadePlan(100), options);
  const auto lost = std::count_if(shots.begin(), shots.end(), [](auto& s) { return s.lost; });
  EXPECT_EQ(lost, 10);
  EXPECT_EQ(shots.size(), 100u + 18u);
  std::set<int> numbers;
  for (size_t i = 0; i < shots.size(); ++i) {
    numbers.insert(shots[i].number);
    if (shots[i].duplicate_of < 0) continue;
    EXPECT_EQ(shots[i].duplicate_of, static_cast<int>(i) - 1);
    EXPECT_EQ(shots[i].position_m, shots[i - 1].position_m);
    EXPECT_EQ(shots[i].view, shots[i - 1].view);
    EXPECT_FALSE(shots[i].lost);
    EXPECT_GT(shots[i].time_s, shots[i - 1].time_s);
  }
  EXPECT_EQ(numbers.size(), shots.size());
  options.seed = 2;
  const auto others = ScheduleShots(MadePlan(100), options);
  std::vector<int> first, second;
  for (const Shot& s : shots)
    if (s.lost) first.push_back(s.view);
  for (const Shot& s : others)
    if (s.lost) second.push_back(s.view);
  EXPECT_NE(first, second);
}

TEST(Schedule, FliesByDay) {
  FlightOptions options;
  options.start_hour = 16;
  Plan plan = MadePlan(5000);  // 2500 stops: hours
  const auto shots = ScheduleShots(plan, options);
  EXPECT_GT(shots.back().day, options.day_of_year);
  for (size_t i = 0; i < shots.size(); ++i) {
    EXPECT_GE(SunElevation_deg(50.1, shots[i].day, shots[i].hour), kLowestSun_deg);
    EXPECT_GE(shots[i].hour, 16);
    if (i > 0) {
      EXPECT_GT(shots[i].time_s, shots[i - 1].time_s);
    }
  }
  options.start_hour = 23;
  EXPECT_THROW(ScheduleShots(plan, options), Error);
  EXPECT_THROW(ScheduleShots(MadePlan(0), {}), Error);
}

// What scheduling says about the start; nothing where it works.
std::string ProblemOf(const Plan& plan, const FlightOptions& options) {
  try {
    ScheduleShots(plan, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return error.what();
  }
  return "";
}

TEST(Schedule, ADayThatGetsDarkBeforeItsStartEndsTheFlight) {
  FlightOptions options;
  options.day_of_year = 277;
  options.start_hour = 16.5;
  EXPECT_EQ(ProblemOf(MadePlan(20), options), "");
  EXPECT_THAT(ProblemOf(MadePlan(5000), options),
              testing::HasSubstr("start_hour 16.5: on day 279"));
  options.day_of_year = 280;
  EXPECT_THAT(ProblemOf(MadePlan(20), options), testing::HasSubstr("on day 280"));
  options.start_hour = 12;
  EXPECT_EQ(ProblemOf(MadePlan(5000), options), "");
}

TEST(Schedule, NamesAndTimesAreThoseOfTheDrone) {
  Shot shot;
  shot.day = 60;
  shot.hour = 10 + 5 / 60.0 + 7.25 / 3600;
  shot.number = 12;
  EXPECT_EQ(ExifTime(shot), "2026:03:01 10:05:07");
  EXPECT_EQ(Milliseconds(shot), 250);
  EXPECT_EQ(PhotoName(shot, "h0003v1"), "DJI_20260301100507_0012_D_h0003v1.JPG");
  shot.day = 365;
  shot.hour = 12;
  EXPECT_EQ(FileTime(shot), "20261231120000");
  shot.day = 366;
  EXPECT_EQ(FileTime(shot), "20270101120000");
  EXPECT_EQ(ExifTime(shot), "2027:01:01 12:00:00");
  shot.hour = 24.5;  // where the sun does not set
  EXPECT_EQ(ExifTime(shot), "2027:01:02 00:30:00");
}

TEST(Schedule, HeldOutPosesAreNearPlannedOnesAndDifferent) {
  const Plan plan = MadePlan(40);
  FlightOptions options;
  options.held_out = 8;
  const auto shots = ScheduleShots(plan, options);
  for (int number = 1; number <= 8; ++number) {
    const Shot shot = HeldOutShot(plan, shots, options, number, 0);
    EXPECT_EQ(shot.view, -1);
    double nearest = 1e9;
    for (const PlannedView& view : plan.views) {
      nearest = std::min(nearest, (view.position_m - shot.position_m).norm());
    }
    EXPECT_LT(nearest, 3.3);
    EXPECT_GT((HeldOutShot(plan, shots, options, number, 1).position_m - shot.position_m).norm(),
              0.01);
  }
}

TEST(Daylight, SunIsHighestAtNoonAndRedWhenLow) {
  FlightOptions options;
  EXPECT_GT(SunElevation_deg(50, 120, 12), SunElevation_deg(50, 120, 9));
  const Light noon = DaylightAt(options, 50, 172, 12);
  const Light evening = DaylightAt(options, 50, 172, 19);
  EXPECT_GT(noon.sun[1], evening.sun[1]);
  EXPECT_GT(evening.sun[0] / evening.sun[2], noon.sun[0] / noon.sun[2]);
  EXPECT_EQ(noon.haze_m, options.haze_m);
  // Balanced, the evening's white is nearer to grey than it was.
  const Eigen::Vector3d gains = NeutralGains(evening);
  EXPECT_LT(gains[0], gains[2]);
  EXPECT_DOUBLE_EQ(gains[1], 1);
  options.sun = false;
  EXPECT_EQ(DaylightAt(options, 50, 172, 12).sun.norm(), 0);
}

}  // namespace
}  // namespace stucco::simulate
