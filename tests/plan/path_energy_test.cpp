// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plan/path/energy.h"

namespace stucco::plan {
namespace {

struct RealFlight {
  double length_m;
  int hovers;
  double battery_percent;
  double time_min;
};

// Xiong et al. (2025), the comparison of hovering positions (2 flights) and that of real scenes
// (Hitech, ArtSci, Polytech, SEng: oblique, DroneScan and co-capture each).
const std::vector<RealFlight> kRealFlights{
    {895, 250, 86, 29},      {895, 119, 57, 16},      {2085, 72, 44, 13},      {7629, 567, 214, 76},
    {2806, 87, 51, 15},      {4908, 97, 103, 31},     {20498, 1722, 825, 241}, {9737, 302, 206, 63},
    {6261, 240, 140, 45},    {18521, 1337, 530, 162}, {10499, 334, 212, 65},   {5960, 220, 123, 38},
    {26248, 1850, 783, 217}, {11710, 417, 230, 74},
};

TEST(Energy, ReproducesThePublishedFlights) {
  double energy_error = 0;
  double time_error = 0;
  for (const RealFlight& flight : kRealFlights) {
    const Effort effort = EstimateEffort(flight.length_m, flight.hovers, 1);
    energy_error += std::abs(effort.battery_percent / flight.battery_percent - 1);
    time_error += std::abs(effort.time_min / flight.time_min - 1);
  }
  EXPECT_LT(energy_error / 14, 0.10);
  EXPECT_LT(time_error / 14, 0.10);
}

// The derivative of the sum of squared relative errors vanishes at a best fit.
TEST(Energy, NoOtherFactorsFitBetter) {
  const auto squares = [](double length_factor, double hover_factor) {
    double sum = 0;
    for (const RealFlight& flight : kRealFlights) {
      const Effort length = EstimateEffort(flight.length_m * length_factor, 0, 1);
      const Effort hover = EstimateEffort(0, flight.hovers, 1);
      const double energy = length.battery_percent + hover_factor * hover.battery_percent;
      const double time = length.time_min + hover_factor * hover.time_min;
      sum += std::pow(energy / flight.battery_percent - 1, 2);
      sum += std::pow(time / flight.time_min - 1, 2);
    }
    return sum;
  };
  for (const double change : {0.98, 1.02}) {
    EXPECT_GT(squares(change, 1), squares(1, 1));
    EXPECT_GT(squares(1, change), squares(1, 1));
    EXPECT_GT(squares(change, 2 - change), squares(1, 1));
  }
}

TEST(Energy, ABiggerBatteryLastsLonger) {
  const Effort one = EstimateEffort(1000, 10, 1);
  const Effort two = EstimateEffort(1000, 10, 2);
  EXPECT_DOUBLE_EQ(one.battery_percent, 10.7 + 2.93);
  EXPECT_DOUBLE_EQ(two.battery_percent, one.battery_percent / 2);
  EXPECT_DOUBLE_EQ(two.time_min, one.time_min);
  EXPECT_EQ(EstimateEffort(0, 0, 1).battery_percent, 0);
}

}  // namespace
}  // namespace stucco::plan
