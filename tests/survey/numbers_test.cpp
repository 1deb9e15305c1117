// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace stucco {
namespace {

using testing::ContainsRegex;
using testing::Not;

TEST(RoundTo, GivesTheNearestMultipleAndNoNegativeZero) {
  EXPECT_EQ(RoundTo(1.23456, 1e3), 1.235);
  EXPECT_EQ(RoundTo(-1.23456, 1e3), -1.235);
  EXPECT_FALSE(std::signbit(RoundTo(-1e-9, 1e3)));
  EXPECT_TRUE(std::isnan(RoundTo(NAN, 1e3)));
}

TEST(Percent, DoesNotRoundToAllOrNothing) {
  EXPECT_EQ(Percent(0.54), "54 %");
  EXPECT_EQ(Percent(1), "100 %");
  EXPECT_EQ(Percent(0), "0 %");
  EXPECT_EQ(Percent(0.9999), "99.9 %");
  EXPECT_EQ(Percent(0.0001), "0.1 %");
  EXPECT_EQ(Percent(NAN), "-");
}

TEST(Lengths, AreMetresOnlyWhenMetric) {
  EXPECT_EQ(PixelSize(0.0124, true), "1.24 cm");
  EXPECT_EQ(PixelSize(0.004, true), "4.0 mm");
  EXPECT_EQ(PixelSize(0, true), "-");
  EXPECT_EQ(Length(3.417, true), "3.42 m");
  EXPECT_EQ(Length(0.043, true), "4.3 cm");
  EXPECT_EQ(Area(34.21, true), "34.2 m²");
  for (const std::string& text :
       {PixelSize(0.0124, false), Length(3.417, false), Length(0.001, false), Area(34.21, false)}) {
    EXPECT_THAT(text, ContainsRegex("^[0-9.]+ units"));
    EXPECT_THAT(text, Not(ContainsRegex("[0-9] [cm]?m")));
  }
  EXPECT_EQ(Length(INFINITY, true), "-");
}

TEST(Duration, IsReadable) {
  EXPECT_EQ(Duration(4.21), "4.2 s");
  EXPECT_EQ(Duration(200), "3 min 20 s");
  EXPECT_EQ(Duration(7500), "2 h 05 min");
  EXPECT_EQ(Duration(-1), "-");
}

TEST(Count, KnowsOne) {
  EXPECT_EQ(Count(1, "photo", "photos"), "1 photo");
  EXPECT_EQ(Count(0, "photo", "photos"), "0 photos");
}

}  // namespace
}  // namespace stucco
