// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "simulate/flight/options.h"

namespace stucco::simulate {
namespace {

TEST(FlightOptions, EachIsSetByItsName) {
  FlightOptions options;
  OptionTable table("simulate");
  Describe(table, options);
  EXPECT_EQ(SetOptionFromText(table, "scale", "0.25"), "");
  EXPECT_EQ(options.scale, 0.25);
  EXPECT_EQ(SetOptionFromText(table, "rtk", "true"), "");
  EXPECT_TRUE(options.rtk);
  EXPECT_NE(SetOptionFromText(table, "lost_share", "1.5"), "");
  EXPECT_EQ(options.lost_share, 0);
}

}  // namespace
}  // namespace stucco::simulate
