// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/new_plants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace stucco {
namespace {

constexpr int kWallWidth = 240, kWallHeight = 160;

// A wall of bricks that one photo shows, with a bush from this column on.
FacetPicture Wall(int bush_from) {
  FacetPicture wall{
      {kWallWidth, kWallHeight, 3, std::vector<uint8_t>(3 * kWallWidth * kWallHeight)},
      std::vector<uint8_t>(kWallWidth * kWallHeight, 1)};
  for (int y = 0; y < kWallHeight; ++y) {
    for (int x = 0; x < kWallWidth; ++x) {
      const int shade = (x / 8 * 37 + y / 8 * 61) % 5;  // another one in each cell of 8 texels
      uint8_t* rgb = wall.picture.Pixel(x, y);
      const bool bush = x >= bush_from;
      rgb[0] = static_cast<uint8_t>(bush ? 30 + 12 * shade : 150 + 8 * shade);
      rgb[1] = static_cast<uint8_t>(bush ? 60 + 25 * shade : 90 + 5 * shade);
      rgb[2] = static_cast<uint8_t>(bush ? 20 + 8 * shade : 80 + 5 * shade);
    }
  }
  return wall;
}

uint8_t LabelAt(const FacetPicture& picture, int x) {
  return picture.labels[static_cast<size_t>(kWallHeight / 2) * kWallWidth + x];
}

double Shown(const FacetPicture& picture) {
  return static_cast<double>(std::ranges::count(picture.labels, 1)) / (kWallWidth * kWallHeight);
}

TEST(LeaveOutNewPlants, ABushBeforePartOfAWall) {
  FacetPicture after = Wall(160);
  EXPECT_FALSE(LeaveOutNewPlants(Wall(kWallWidth), after));
  EXPECT_EQ(LabelAt(after, 60), 1);
  EXPECT_EQ(LabelAt(after, 210), 255);
}

TEST(LeaveOutNewPlants, ABushBeforeMostOfAWallHidesIt) {
  FacetPicture after = Wall(80);
  EXPECT_TRUE(LeaveOutNewPlants(Wall(kWallWidth), after));
  EXPECT_EQ(Shown(after), 0);
}

TEST(LeaveOutNewPlants, WhatGrewThereThenStays) {
  FacetPicture after = Wall(80);
  EXPECT_FALSE(LeaveOutNewPlants(Wall(80), after));
  EXPECT_EQ(Shown(after), 1);
}

}  // namespace
}  // namespace stucco
