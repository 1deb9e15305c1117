// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "plan/field/ground_points.h"
#include "survey/geometry2d.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

// Ground every 2.5 m around the buildings of the fixture (0 to 95 m east, 0 to 25 m north), under
// the buildings too.
PhotoCoverage Ground(int photos) {
  PhotoCoverage coverage{2.5, {}};
  for (double y = -38.75; y < 65; y += 2.5) {
    for (double x = -38.75; x < 135; x += 2.5) {
      coverage.places.push_back(
          {{x, y, 0}, Eigen::Vector3d::UnitZ(), SurfaceKind::kGround, photos, 0.01});
    }
  }
  return coverage;
}

TEST(GroundPoints, LieInCornersMiddleAndShortSides) {
  const Plan plan = test::MakePlan();
  const auto points = ProposeGroundPoints(plan, Ground(6));
  ASSERT_EQ(points.size(), 7u);
  EXPECT_EQ(points[0].name, "G1");
  EXPECT_EQ(points[4].name, "G5");
  EXPECT_EQ(points[5].name, "C1");
  EXPECT_EQ(points[5].where, "west side");
  EXPECT_EQ(points[6].where, "east side");
  EXPECT_LT(points[0].place.position_m.x(), 95 / 3.0);  // south-west
  EXPECT_LT(points[0].place.position_m.y(), 5);
  EXPECT_GT(points[2].place.position_m.x(), 2 * 95 / 3.0);  // north-east
  EXPECT_GT(points[2].place.position_m.y(), 20);
}

TEST(GroundPoints, KeepOffBuildings) {
  const Plan plan = test::MakePlan();
  for (const GroundPoint& point : ProposeGroundPoints(plan, Ground(6))) {
    for (const PlannedFootprint& footprint : plan.footprints) {
      EXPECT_GE(
          Distance(Polygon{footprint.rings_m}, Eigen::Vector2d(point.place.position_m.head<2>())),
          3)
          << point.name;
    }
  }
}

TEST(GroundPoints, AreWhereMostPhotosLook) {
  PhotoCoverage coverage = Ground(6);
  const auto place = std::ranges::find_if(coverage.places, [](const CoveredPlace& at) {
    return at.position_m.x() == -8.75 && at.position_m.y() == -11.25;
  });
  ASSERT_NE(place, coverage.places.end());
  place->photos = 9;
  const auto points = ProposeGroundPoints(test::MakePlan(), coverage);
  EXPECT_EQ(points[0].place.position_m, place->position_m);
  EXPECT_EQ(points[0].place.photos, 9);
}

TEST(GroundPoints, NeedGroundInViewOfSeveralPhotos) {
  EXPECT_TRUE(ProposeGroundPoints(test::MakePlan(), Ground(3)).empty());
  EXPECT_TRUE(ProposeGroundPoints(test::MakePlan(), {}).empty());
  EXPECT_TRUE(ProposeGroundPoints({}, Ground(6)).empty());
  PhotoCoverage roofs = Ground(6);
  for (CoveredPlace& place : roofs.places) place.kind = SurfaceKind::kRoof;
  EXPECT_TRUE(ProposeGroundPoints(test::MakePlan(), roofs).empty());
}

}  // namespace
}  // namespace stucco::plan
