// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/solid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulate/city/footprints.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

Eigen::Vector3d AreaOfRing(const Solid& solid, const std::vector<int>& ring) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    area += (solid.vertices[ring[i]] - solid.vertices[ring[0]])
                .cross(solid.vertices[ring[i + 1]] - solid.vertices[ring[0]]) /
            2;
  }
  return area;
}

// By the divergence theorem; right only where all faces look outwards.
double Volume(const Solid& solid) {
  double volume = 0;
  for (const Solid::Face& face : solid.faces) {
    Eigen::Vector3d area = AreaOfRing(solid, face.outer);
    for (const auto& hole : face.holes) area += AreaOfRing(solid, hole);
    volume += area.dot(solid.vertices[face.outer[0]]) / 3;
  }
  return volume;
}

double WorstDistanceFromPlane(const Solid& solid) {
  double worst = 0;
  for (const Solid::Face& face : solid.faces) {
    const Eigen::Vector3d normal = AreaOfRing(solid, face.outer).normalized();
    for (const int corner : face.outer) {
      worst = std::max(
          worst, std::abs(normal.dot(solid.vertices[corner] - solid.vertices[face.outer[0]])));
    }
  }
  return worst;
}

int Gables(const PitchedRoof& roof) {
  return static_cast<int>(
      std::count_if(roof.apex_of.begin(), roof.apex_of.end(), [](int apex) { return apex >= 0; }));
}

void ExpectSound(const Solid& solid) {
  EXPECT_FALSE(FindGap(solid)) << FindGap(solid).value_or("");
  EXPECT_LT(WorstDistanceFromPlane(solid), 1e-9);
}

TEST(Solid, FlatRoofGivesAPrism) {
  const Polygon outline = Placed(CourtyardShape(20, 16, 5), 0.4, {30, 40});
  const Solid solid = MakeSolid(outline, -1, 9, std::nullopt);
  ExpectSound(solid);
  EXPECT_NEAR(Volume(solid), Area(outline) * 10, 1e-6);
}

TEST(Solid, GabledRectangleHasTheVolumeOfItsSection) {
  const Polygon outline = Placed(Rectangle(12, 8), 0.3, {5, -7});
  const PitchedRoof roof = MakePitchedRoof(outline, RoofShape::kGabled, 0.5);
  const Solid solid = MakeSolid(outline, 0, 6, roof);
  ExpectSound(solid);
  EXPECT_EQ(roof.faces.size(), 2u);
  EXPECT_EQ(Gables(roof), 2);
  EXPECT_NEAR(Volume(solid), 12 * 8 * 6 + 12 * 8 * 2 / 2.0, 1e-9);
}

TEST(Solid, NamedGablesTurnTheRidgeAcross) {
  const Polygon outline = Rectangle(12, 8);
  const PitchedRoof roof =
      MakePitchedRoof(outline, RoofShape::kGabled, 0.5, {true, false, true, false});
  EXPECT_GE(roof.apex_of[0], 0);
  EXPECT_LT(roof.apex_of[1], 0);
  EXPECT_DOUBLE_EQ(roof.vertices[roof.apex_of[0]].z(), 3);
}

TEST(Solid, HippedRectangleHasTheVolumeOfItsWedge) {
  const Polygon outline = Placed(Rectangle(12, 8), 1.3, {5, -7});
  const PitchedRoof roof = MakePitchedRoof(outline, RoofShape::kHipped, 0.5);
  const Solid solid = MakeSolid(outline, 0, 6, roof);
  ExpectSound(solid);
  EXPECT_EQ(Gables(roof), 0);
  // A ridge of 4 m: a prism over it and a pyramid over the rest.
  EXPECT_NEAR(Volume(solid), 12 * 8 * 6 + 8 * 2 / 2.0 * 4 + 8 * 8 * 2 / 3.0, 1e-6);
}

TEST(Solid, SquareGetsAPyramid) {
  const Polygon outline = Rectangle(8, 8);
  const Solid solid = MakeSolid(outline, 0, 3, MakePitchedRoof(outline, RoofShape::kHipped, 1));
  ExpectSound(solid);
  EXPECT_NEAR(Volume(solid), 64 * 3 + 64 * 4 / 3.0, 1e-6);
}

TEST(Solid, WingsEndInGables) {
  const Polygon l = Placed(LShape(14, 12, 6), 0.2, {1, 2});
  const Polygon u = Placed(UShape(24, 18, 6), -0.9, {1, 2});
  const Polygon t = Placed(TShape(24, 18, 6), 2.9, {1, 2});
  const std::vector<std::pair<Polygon, int>> shapes = {{l, 2}, {u, 2}, {t, 3}};
  for (const auto& [outline, gables] : shapes) {
    const PitchedRoof roof = MakePitchedRoof(outline, RoofShape::kGabled, 0.7);
    EXPECT_EQ(Gables(roof), gables);
    ExpectSound(MakeSolid(outline, 0, 6, roof));
    ExpectSound(MakeSolid(outline, 0, 6, MakePitchedRoof(outline, RoofShape::kHipped, 0.7)));
  }
}

TEST(Solid, CourtyardKeepsItsRoofAround) {
  const Polygon outline = Placed(CourtyardShape(36, 44, 10), 0.5, {3, 3});
  const PitchedRoof roof = MakePitchedRoof(outline, RoofShape::kHipped, 0.6);
  EXPECT_EQ(roof.faces.size(), 8u);
  ExpectSound(MakeSolid(outline, 0, 12, roof));
}

TEST(Solid, FindGapSeesAMissingFace) {
  Solid solid = MakeSolid(Rectangle(5, 5), 0, 3, std::nullopt);
  solid.faces.pop_back();
  EXPECT_TRUE(FindGap(solid));
}

TEST(Solid, FindGapSeesAFaceTurnedInsideOut) {
  Solid solid = MakeSolid(Rectangle(5, 5), 0, 3, std::nullopt);
  std::reverse(solid.faces[0].outer.begin(), solid.faces[0].outer.end());
  EXPECT_TRUE(FindGap(solid));
}

}  // namespace
}  // namespace stucco::simulate
