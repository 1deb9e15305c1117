// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/solid_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

std::vector<Facet> Box() {
  return MadeBox("B", {0, 0, 0}, {10, 8, 6}).facets;
}

std::vector<Facet> Together(std::vector<Facet> a, const std::vector<Facet>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Facet Reversed(Facet facet) {
  std::reverse(facet.outer.begin(), facet.outer.end());
  return MadeFacet(facet.id, facet.facet_class, facet.outer);
}

TEST(CheckSolid, ABoxIsSound) {
  const SolidCheck check = CheckSolid(Box());
  EXPECT_TRUE(check.watertight());
  EXPECT_FALSE(check.crosses_itself);
}

TEST(CheckSolid, AMissingFacetOpensIt) {
  std::vector<Facet> facets = Box();
  facets.pop_back();
  const SolidCheck check = CheckSolid(facets);
  EXPECT_FALSE(check.closed);
  EXPECT_FALSE(check.watertight());
  EXPECT_TRUE(check.manifold);
  EXPECT_TRUE(check.oriented);
  EXPECT_FALSE(check.crosses_itself);
}

TEST(CheckSolid, AGapOfATenthOfAMillimetreIsAGap) {
  std::vector<Facet> facets = Box();
  for (Eigen::Vector3d& corner : facets[4].outer) corner.z() += 1e-4;
  EXPECT_FALSE(CheckSolid(facets).closed);
}

TEST(CheckSolid, ATurnedFacetIsNotOriented) {
  std::vector<Facet> facets = Box();
  facets[2] = Reversed(facets[2]);
  const SolidCheck check = CheckSolid(facets);
  EXPECT_TRUE(check.closed);
  EXPECT_TRUE(check.manifold);
  EXPECT_FALSE(check.oriented);
  EXPECT_FALSE(check.crosses_itself);
}

TEST(CheckSolid, ABoxInsideOutIsNotOriented) {
  std::vector<Facet> facets = Box();
  for (Facet& facet : facets) facet = Reversed(facet);
  EXPECT_TRUE(CheckSolid(facets).closed);
  EXPECT_FALSE(CheckSolid(facets).watertight());
}

TEST(CheckSolid, TwoBoxesThatCross) {
  const SolidCheck check = CheckSolid(Together(Box(), MadeBox("C", {5, 4, 1}, {15, 12, 5}).facets));
  EXPECT_TRUE(check.watertight());
  EXPECT_TRUE(check.crosses_itself);
}

TEST(CheckSolid, TwoBoxesThatShareAnEdgeAreNoManifold) {
  const SolidCheck check =
      CheckSolid(Together(Box(), MadeBox("C", {10, 8, 0}, {15, 12, 6}).facets));
  EXPECT_TRUE(check.closed);
  EXPECT_FALSE(check.manifold);
  EXPECT_FALSE(check.watertight());
}

TEST(CheckSolid, TwoBoxesThatShareACornerAreNoManifold) {
  EXPECT_FALSE(CheckSolid(Together(Box(), MadeBox("C", {10, 8, 6}, {15, 12, 9}).facets)).manifold);
}

TEST(CheckSolid, NothingIsNoSolid) {
  EXPECT_FALSE(CheckSolid({}).watertight());
  EXPECT_FALSE(CheckSolid({}).crosses_itself);
}

}  // namespace
}  // namespace stucco::evaluate
