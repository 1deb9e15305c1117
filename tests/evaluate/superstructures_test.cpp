// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/superstructures.h"

#include <gtest/gtest.h>

#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

Surface AllOf(const Proxy& proxy) {
  Surface surface;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) Append(facet, surface);
  }
  return surface;
}

Proxy With(const Building& more) {
  Proxy proxy = MadeTruth();
  proxy.buildings.push_back(more);
  return proxy;
}

// On the roof of B0001, which is 6 m up.
Building HeadOfStairs() {
  return MadeBox("B0001b", {3, 2, 6}, {6, 5, 8.5});
}

int Count(const Proxy& result, const Proxy& scene) {
  return CountSuperstructures(result, AllOf(MadeTruth()), SurfaceIndex(AllOf(scene)));
}

TEST(Superstructures, WhatStandsOnARoofIsCountedWhereTheSceneHasIt) {
  EXPECT_EQ(Count(With(HeadOfStairs()), With(HeadOfStairs())), 5);  // without its underside
  EXPECT_EQ(Count(MadeTruth(), With(HeadOfStairs())), 0);
}

TEST(Superstructures, WhatNothingIsThereForIsNot) {
  EXPECT_EQ(Count(With(HeadOfStairs()), MadeTruth()), 0);
}

TEST(Superstructures, WhatStandsOutFromAWallIsNot) {
  const Building balcony = MadeBox("B0001b", {3, -1.2, 3}, {6, 0, 4});
  EXPECT_EQ(Count(With(balcony), With(balcony)), 0);
}

}  // namespace
}  // namespace stucco::evaluate
