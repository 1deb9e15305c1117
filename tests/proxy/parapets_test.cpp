// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/parapets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stucco {
namespace {

constexpr double kLevelOfDetail_m = 0.3;

// A level roof of 20 by 10 m at 10 m, and what is found besides.
class ParapetsTest : public testing::Test {
 protected:
  ParapetsTest() {
    building_.parts = {Polygon{{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}}}};
    AddLevel(0, 8);
    planes_.front().area = 160;
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

  // Another level roof, whose normals are off by this, and its samples up or down by that.
  void AddRough(double from, double to, double off_deg, double off_m) {
    constexpr double kHeight_m = 12.5;
    AddUpper(from, to, kHeight_m);
    planes_.back().area = 20 * (to - from);
    const double off = off_deg * std::numbers::pi / 180;
    for (const int i : planes_.back().points) {
      samples_.normals[i] = {std::sin(off), 0, std::cos(off)};
      samples_.positions[i].z() += i % 2 == 0 ? off_m : -off_m;
    }
  }

  size_t LeftAfterDrop(double coarseness = 1) const {
    std::vector<Plane> planes = planes_;
    DropParapets(samples_, building_,
                 {.level_of_detail = kLevelOfDetail_m, .coarseness = coarseness}, planes);
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
        samples_.normals.push_back(plane.normal);
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

// Heads of staircases are as smooth as roofs are, what stereo smears around them is not.
TEST_F(ParapetsTest, WhatIsRougherThanTheRoofIsSmeared) {
  AddRough(4, 6, 9, 0.06);
  EXPECT_EQ(LeftAfterDrop(), 2u);
  AddRough(6, 8, 13, 0.06);
  EXPECT_EQ(LeftAfterDrop(), 2u);
  constexpr double kThin = 1.2;
  EXPECT_EQ(LeftAfterDrop(kThin), 3u);
}

// Where a cloud is thin, normals are off near edges.
TEST_F(ParapetsTest, WhatIsFlatIsNotRough) {
  AddRough(6, 8, 13, 0.02);
  EXPECT_EQ(LeftAfterDrop(), 2u);
}

// Nothing larger says that roofs are smoother there.
TEST_F(ParapetsTest, ARoughRoofStays) {
  AddRough(2, 8, 13, 0.06);
  EXPECT_EQ(LeftAfterDrop(), 2u);
}

}  // namespace
}  // namespace stucco
