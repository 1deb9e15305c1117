// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/closed_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace stucco {
namespace {

using Eigen::Vector3d;

Facet MakeFacet(std::vector<Vector3d> ring) {
  Facet facet;
  facet.normal = (ring[1] - ring[0]).cross(ring[2] - ring[1]).normalized();
  facet.offset = facet.normal.dot(ring[0]);
  facet.outer = std::move(ring);
  return facet;
}

std::vector<Facet> Cube(const Vector3d& low, double side) {
  std::vector<Vector3d> v;
  for (int i = 0; i < 8; ++i) {
    v.push_back(low + side * Vector3d(i & 1, i >> 1 & 1, i >> 2 & 1));
  }
  const std::array<std::array<int, 4>, 6> rings = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  std::vector<Facet> facets;
  for (const auto& r : rings) facets.push_back(MakeFacet({v[r[0]], v[r[1]], v[r[2]], v[r[3]]}));
  return facets;
}

TEST(FindOpening, ACubeIsClosed) {
  EXPECT_EQ(FindOpening(Cube({0, 0, 0}, 2)), std::nullopt);
}

TEST(FindOpening, SeesAMissingFacet) {
  auto cube = Cube({0, 0, 0}, 2);
  cube.pop_back();
  ASSERT_TRUE(FindOpening(cube));
  EXPECT_THAT(*FindOpening(cube), ::testing::HasSubstr("open at an edge"));
}

std::vector<Facet> InsideOut(std::vector<Facet> facets) {
  for (Facet& facet : facets) {
    std::reverse(facet.outer.begin(), facet.outer.end());
    facet.normal = -facet.normal;
  }
  return facets;
}

TEST(FindOpening, SeesAPartThatFacesInwards) {
  for (const double z : {-5.0, 5.0}) {
    for (const bool turned : {false, true}) {
      auto two = Cube({0, 0, 0}, 2);
      auto other = Cube({8, 0, z}, 2);
      if (turned) other = InsideOut(std::move(other));
      two.insert(two.end(), other.begin(), other.end());
      EXPECT_EQ(FindOpening(two).has_value(), turned) << z;
    }
  }
}

TEST(FindOpening, SeesFacetsThatFaceInwards) {
  const auto cube = InsideOut(Cube({0, 0, 0}, 2));
  ASSERT_TRUE(FindOpening(cube));
  EXPECT_THAT(*FindOpening(cube), ::testing::HasSubstr("inwards"));
}

TEST(FindOpening, SeesOneFacetTurnedAround) {
  auto cube = Cube({0, 0, 0}, 2);
  std::reverse(cube[0].outer.begin(), cube[0].outer.end());
  cube[0].normal = -cube[0].normal;
  EXPECT_TRUE(FindOpening(cube));
}

TEST(FindOpening, SeesSolidsThatCrossOrTouch) {
  for (const Vector3d& low : {Vector3d(1, 1, 1), Vector3d(2, 2, 2), Vector3d(2, 2, 0)}) {
    auto two = Cube({0, 0, 0}, 2);
    const auto other = Cube(low, 2);
    two.insert(two.end(), other.begin(), other.end());
    EXPECT_TRUE(FindOpening(two)) << low.transpose();
  }
}

TEST(FindOpening, NothingIsNotClosed) {
  EXPECT_TRUE(FindOpening({}));
}

}  // namespace
}  // namespace stucco
