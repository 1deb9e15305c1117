// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/triangulate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace stucco {
namespace {

Facet MakeWall(double width, double height) {
  Facet facet;
  facet.normal = -Eigen::Vector3d::UnitY();
  facet.outer = {{0, 0, 0}, {width, 0, 0}, {width, 0, height}, {0, 0, height}};
  return facet;
}

// Sum of the triangles' areas, negative where they turn away from the normal.
double SignedArea(const FacetTriangles& shape, const Eigen::Vector3d& normal) {
  double area = 0;
  for (const auto& t : shape.triangles) {
    const Eigen::Vector3d& a = shape.vertices[t[0]];
    area += 0.5 * (shape.vertices[t[1]] - a).cross(shape.vertices[t[2]] - a).dot(normal);
  }
  return area;
}

TEST(TriangulateFacet, CoversAPolygonWithAHole) {
  Facet facet = MakeWall(4, 3);
  facet.holes = {{{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}}};
  const FacetTriangles shape = TriangulateFacet(facet);
  EXPECT_EQ(shape.vertices.size(), 8u);
  EXPECT_EQ(shape.triangles.size(), 8u);
  EXPECT_NEAR(SignedArea(shape, facet.normal), 11, 1e-9);
  facet.holes.clear();
  EXPECT_EQ(TriangulateFacet(facet).triangles.size(), 2u);
}

TEST(TriangulateFacet, TrianglesFaceTheNormal) {
  Facet facet = MakeWall(4, 3);
  facet.holes = {{{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}}};
  const FacetTriangles shape = TriangulateFacet(facet);
  for (const auto& t : shape.triangles) {
    const Eigen::Vector3d& a = shape.vertices[t[0]];
    EXPECT_GT((shape.vertices[t[1]] - a).cross(shape.vertices[t[2]] - a).dot(facet.normal), 0);
  }
}

TEST(TriangulateFacet, FollowsConcaveOutlines) {
  Facet facet = MakeWall(4, 3);
  facet.outer = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {2, 0, 0.5}, {0, 0, 3}};
  const FacetTriangles shape = TriangulateFacet(facet);
  EXPECT_EQ(shape.triangles.size(), 3u);
  EXPECT_NEAR(SignedArea(shape, facet.normal), 12 - 5, 1e-9);
}

TEST(TriangulateFacet, ResolvesCrossingEdgesByTheEvenOddRule) {
  Facet facet = MakeWall(2, 2);
  facet.outer = {{0, 0, 0}, {2, 0, 0}, {0, 0, 2}, {2, 0, 2}};
  const FacetTriangles shape = TriangulateFacet(facet);
  ASSERT_EQ(shape.vertices.size(), 5u);
  EXPECT_LT((shape.vertices[4] - Eigen::Vector3d(1, 0, 1)).norm(), 1e-9);
  EXPECT_NEAR(SignedArea(shape, facet.normal), 2, 1e-9);
  // A ring that touches itself in a corner.
  facet.outer = {{0, 0, 0}, {2, 0, 2}, {4, 0, 0}, {4, 0, 4}, {2, 0, 2}, {0, 0, 4}};
  EXPECT_NEAR(SignedArea(TriangulateFacet(facet), facet.normal), 8, 1e-9);
}

TEST(TriangulateFacet, OfTooFewVerticesOrALineIsEmpty) {
  Facet facet = MakeWall(2, 2);
  facet.outer = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_TRUE(TriangulateFacet(facet).triangles.empty());
  facet.outer.pop_back();
  EXPECT_TRUE(TriangulateFacet(facet).triangles.empty());
}

}  // namespace
}  // namespace stucco
