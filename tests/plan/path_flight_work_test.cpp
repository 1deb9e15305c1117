// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "plan/path/flight_work.h"

namespace stucco::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Shot At(double yaw_deg, double pitch_deg) {
  Shot shot;
  shot.yaw_rad = yaw_deg * kDegree;
  shot.pitch_rad = pitch_deg * kDegree;
  return shot;
}

PlannedPace Pace() {
  PlannedPace pace;
  pace.speed_m_per_s = 5;
  pace.hold_s = 1.5;
  pace.shutter_s = 0.5;
  pace.yaw_deg_per_s = 90;
  pace.tilt_deg_per_s = 45;
  pace.stop_s = 6;
  pace.corner_s = 3;
  pace.wind_m_per_s = 0;
  return pace;
}

Route Straight(std::vector<Eigen::Vector3d> points) {
  Route route{std::move(points), 0};
  for (size_t k = 1; k < route.points.size(); ++k) {
    route.length_m += (route.points[k] - route.points[k - 1]).norm();
  }
  return route;
}

TEST(FlightWork, AStopCostsItsPhotosTurnsAndTilts) {
  const Hover one{{0, 0, 10}, {At(30, -20)}};
  EXPECT_NEAR(StopWork(one, Pace()).stops_s, 6, 1e-9);
  EXPECT_NEAR(StopWork(one, Pace()).photos_s, 2, 1e-9);
  const Hover three{{0, 0, 10}, {At(350, 0), At(80, -45), At(80, -90)}};
  EXPECT_NEAR(StopWork(three, Pace()).stops_s, 6 + 1 + 1 + 1, 1e-9);
  EXPECT_NEAR(StopWork(three, Pace()).photos_s, 6, 1e-9);
}

TEST(FlightWork, ADroneTurnsWhileItFliesAndTiltsWhenItIsThere) {
  const Hover from{{0, 0, 10}, {At(90, 0), At(0, 0)}};
  const Hover to{{20, 0, 10}, {At(180, -45)}};
  const Route far = Straight({from.position, to.position});
  EXPECT_NEAR(HopWork(from, far, to, Pace()).legs_s, 4, 1e-9);
  EXPECT_NEAR(HopWork(from, far, to, Pace()).stops_s, 1, 1e-9);
  const Route near = Straight({from.position, {1, 0, 10}});
  EXPECT_NEAR(HopWork(from, near, to, Pace()).legs_s, 2, 1e-9);  // 180 degrees take longer
}

TEST(FlightWork, CornersCostTimeAndClimbsAreCounted) {
  const Hover from{{0, 0, 10}, {At(0, 0)}};
  const Hover to{{20, 20, 15}, {At(0, 0)}};
  const Route bent = Straight({from.position, {20, 0, 10}, {20, 20, 10}, to.position});
  const FlightWork hop = HopWork(from, bent, to, Pace());
  EXPECT_NEAR(hop.legs_s, 4 + 3 + 4 + 3 + 1, 1e-9);
  EXPECT_NEAR(hop.climbed_m, 5, 1e-9);
  EXPECT_NEAR(TransferWork(bent, Pace()).transfer_s, hop.legs_s, 1e-9);
  EXPECT_NEAR(FirstTiltWork({{0, 0, 10}, {At(0, -90)}}, Pace()).stops_s, 2, 1e-9);
}

}  // namespace
}  // namespace stucco::plan
