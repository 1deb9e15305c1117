// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/match_facets.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <utility>
#include <vector>

#include "evaluate/geometry/moved.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

Facet Rectangle(double x0, double x1, double z0, double z1, double y) {
  return MadeFacet("R", FacetClass::kWall, {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}});
}

Proxy OneBuilding(std::vector<Facet> facets) {
  Proxy proxy;
  proxy.buildings.resize(1);
  proxy.buildings[0].facets = std::move(facets);
  return proxy;
}

TEST(Moved, GoesThereAndBack) {
  const Proxy truth = MadeTruth();
  const Proxy moved = Moved(truth, AnySimilarity());
  EXPECT_EQ(FindProblem(moved), std::nullopt);
  EXPECT_NEAR(moved.buildings[0].facets[0].area, 60 * 0.16, 1e-9);
  const Facet back = Moved(moved.buildings[0].facets[0], AnySimilarity().Inverse());
  EXPECT_NEAR((back.outer[2] - truth.buildings[0].facets[0].outer[2]).norm(), 0, 1e-9);
  EXPECT_NEAR(back.offset, truth.buildings[0].facets[0].offset, 1e-9);
}

TEST(Overlap, IsTheCommonAreaAndTheDistanceOfBothPlanes) {
  const Facet wall = Rectangle(0, 10, 0, 6, 0);
  const FacetOverlap overlap = Overlap(wall, Rectangle(4, 20, 2, 9, 0.3));
  EXPECT_NEAR(overlap.area_m2, 6 * 4, 1e-9);
  EXPECT_NEAR(overlap.distance_m, 0.3, 1e-12);
  EXPECT_EQ(Overlap(wall, Rectangle(11, 20, 2, 9, 0)).area_m2, 0);
}

TEST(Overlap, LeavesHolesOut) {
  Facet wall = Rectangle(0, 10, 0, 6, 0);
  wall.holes = {{{2, 0, 1}, {2, 0, 3}, {5, 0, 3}, {5, 0, 1}}};
  EXPECT_NEAR(Overlap(wall, Rectangle(0, 10, 0, 6, 0)).area_m2, 60 - 6, 1e-9);
  EXPECT_NEAR(Overlap(Rectangle(0, 10, 0, 6, 0), wall).area_m2, 60 - 6, 1e-9);
}

TEST(Overlap, ATiltedPlaneIsFartherTheFartherItGoes) {
  // 10 m up at 5 degrees: 0 to 10 tan 5 along the wall's normal, half of it in the mean.
  const double rise = 10 * std::tan(5 * std::numbers::pi / 180);
  const Facet tilted =
      MadeFacet("T", FacetClass::kWall, {{0, 0, 0}, {10, 0, 0}, {10, rise, 10}, {0, rise, 10}});
  const FacetOverlap overlap = Overlap(Rectangle(0, 10, 0, 10, 0), tilted);
  EXPECT_NEAR(overlap.area_m2, 100, 1e-9);
  EXPECT_NEAR(overlap.distance_m, rise / 2, 1e-9);
}

TEST(Overlap, PlanesAtRightAnglesHaveNone) {
  const Facet roof =
      MadeFacet("R0", FacetClass::kRoof, {{0, 0, 3}, {10, 0, 3}, {10, 8, 3}, {0, 8, 3}});
  EXPECT_EQ(Overlap(Rectangle(0, 10, 0, 6, 0), roof).area_m2, 0);
}

TEST(MatchFacets, TruthMatchesItselfWhole) {
  const Proxy truth = MadeTruth();
  const auto matched = MatchFacets(truth, truth, {});
  ASSERT_EQ(matched.size(), 13u);
  for (const TruthFacet& facet : matched) {
    ASSERT_EQ(facet.matches.size(), 1u) << facet.truth->id;
    EXPECT_EQ(facet.matches[0].result, facet.truth);
    EXPECT_NEAR(facet.matches[0].overlap_m2, facet.truth->area, 1e-6);
    EXPECT_NEAR(facet.area_m2, facet.truth->area, 1e-6);
    EXPECT_NEAR(facet.matches[0].distance_m, 0, 1e-9);
    EXPECT_NEAR(facet.matches[0].angle_deg, 0, 1e-4);
  }
}

TEST(MatchFacets, LooksInTheFrameOfTheTruth) {
  const Proxy truth = MadeTruth();
  const Proxy result = Moved(truth, AnySimilarity().Inverse());
  const auto matched = MatchFacets(result, truth, AnySimilarity());
  ASSERT_EQ(matched[0].matches.size(), 1u);
  EXPECT_EQ(matched[0].matches[0].result, &result.buildings[0].facets[0]);
  EXPECT_NEAR(matched[0].matches[0].overlap_m2, 60, 1e-6);
  EXPECT_TRUE(MatchFacets(result, truth, {})[0].matches.empty());
}

TEST(MatchFacets, KnowsHowFarADisplacedResultIs) {
  const Proxy truth = MadeTruth();
  Similarity shift;
  shift.translation = {0, 0.2, 0};
  const auto matched = MatchFacets(truth, truth, shift);
  ASSERT_EQ(matched[0].matches.size(), 1u);
  EXPECT_NEAR(matched[0].matches[0].distance_m, 0.2, 1e-9);
  EXPECT_NEAR(matched[1].matches[0].distance_m, 0, 1e-9);
  EXPECT_NEAR(matched[1].matches[0].overlap_m2, 7.8 * 6, 1e-6);
  shift.translation = {0, 0.6, 0};
  EXPECT_TRUE(MatchFacets(truth, truth, shift)[0].matches.empty());
  EXPECT_FALSE(MatchFacets(truth, truth, shift)[1].matches.empty());
}

TEST(MatchFacets, TheBackOfAWallIsAnotherWall) {
  const Proxy truth = OneBuilding({Rectangle(0, 10, 0, 6, 0)});
  Facet back = Rectangle(0, 10, 0, 6, 0.2);
  std::reverse(back.outer.begin(), back.outer.end());
  const Proxy result = OneBuilding({MadeFacet("back", FacetClass::kWall, back.outer)});
  EXPECT_TRUE(MatchFacets(result, truth, {})[0].matches.empty());
}

TEST(MatchFacets, OrdersTheParts) {
  const Proxy truth = OneBuilding({Rectangle(0, 10, 0, 6, 0)});
  const Proxy result = OneBuilding({Rectangle(0, 3, 0, 6, 0.1), Rectangle(3, 10, 0, 6, 0.05)});
  const auto matched = MatchFacets(result, truth, {});
  ASSERT_EQ(matched[0].matches.size(), 2u);
  EXPECT_EQ(matched[0].matches[0].result, &result.buildings[0].facets[1]);
  EXPECT_NEAR(matched[0].matches[1].overlap_m2, 18, 1e-9);
}

TEST(MatchFacets, AnEmptyResultMatchesNothing) {
  const Proxy truth = MadeTruth();
  const auto matched = MatchFacets({}, truth, {});
  ASSERT_EQ(matched.size(), 13u);
  EXPECT_TRUE(matched[0].matches.empty());
}

}  // namespace
}  // namespace stucco::evaluate
