// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/parapets.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

constexpr double kRim_m = 0.6;

// A level roof of 20 by 10 m at 10 m, and what is found besides.
class ParapetsTest : public testing::Test {
 protected:
  ParapetsTest() {
    building_.parts = {Polygon{{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}}}};
    AddLevel(0, 8);
  }

  // From one y to another, over all of x.
  void AddLevel(double from, double to) { Add(planes_.front(), from, to, 10, 0); }
  // Another level roof.
  void AddUpper(double from, double to, double height) {
    Add(planes_.emplace_back(), from, to, height, 0);
  }

  // A strip whose height at its lower edge and slope along y are these.
  void AddStrip(double from, double to, double height, double slope) {
    Add(planes_.emplace_back(), from, to, height, slope);
  }

  size_t LeftAfterDrop() const {
    std::vector<Plane> planes = planes_;
    DropParapets(samples_, building_, kRim_m, planes);
    return planes.size();
  }

 private:
  void Add(Plane& plane, double from, double to, double height, double slope) {
    plane.normal = Eigen::Vector3d(0, -slope, 1).normalized();
    plane.offset = plane.normal.dot(Eigen::Vector3d(0, from, height));
    constexpr double kSpacing_m = 0.2;
    for (double x = 0.1; x < 20; x += kSpacing_m) {
      for (double y = from + 0.1; y < to; y += kSpacing_m) {
        plane.points.push_back(static_cast<int>(samples_.positions.size()));
        samples_.positions.emplace_back(x, y, height + slope * (y - from));
        samples_.weights.push_back(1);
      }
    }
  }

  Samples samples_;
  MapBuilding building_;
  std::vector<Plane> planes_ = std::vector<Plane>(1);
};

TEST_F(ParapetsTest, WhatRisesAtTheEndOfARoofIsSmeared) {
  AddStrip(8, 10, 10, 0.5);
  EXPECT_EQ(LeftAfterDrop(), 1u);
}

TEST_F(ParapetsTest, WhereTheRoofGoesOnBeyondItSomethingStands) {
  AddStrip(8, 9, 10, 1);
  AddLevel(9, 10);
  EXPECT_EQ(LeftAfterDrop(), 2u);
}

TEST_F(ParapetsTest, TheWallOfWhatStandsOnARoofIsSmeared) {
  AddStrip(8, 9, 10, 2.4);
  EXPECT_EQ(LeftAfterDrop(), 2u);
  AddUpper(9, 10, 12.4);
  EXPECT_EQ(LeftAfterDrop(), 2u);  // of three
}

TEST_F(ParapetsTest, APitchedRoofBetweenTwoLevelOnesStays) {
  AddStrip(8, 9.4, 10, 1);
  AddUpper(9.4, 10, 11.4);
  EXPECT_EQ(LeftAfterDrop(), 3u);
}

TEST_F(ParapetsTest, MansardsStay) {
  AddStrip(8, 10, 10, -0.6);
  EXPECT_EQ(LeftAfterDrop(), 2u);
}

TEST_F(ParapetsTest, WhatRisesHigherThanParapetsStays) {
  AddStrip(8, 10, 10, 1.2);
  EXPECT_EQ(LeftAfterDrop(), 2u);
}

TEST_F(ParapetsTest, WideRoofsStay) {
  AddStrip(5, 10, 10, 0.2);
  EXPECT_EQ(LeftAfterDrop(), 2u);
}

}  // namespace
}  // namespace stucco
