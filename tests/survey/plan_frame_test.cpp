// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan_frame.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "survey/coordinate_system.h"

namespace stucco {
namespace {

TEST(Frame, AgreesWithProj) {
  for (const PlanOrigin origin :
       {PlanOrigin{50.10419, 14.40238, 0}, PlanOrigin{-33.85678, 151.21529, 0}, PlanOrigin{0, 0, 0},
        PlanOrigin{69.64921, -179.99995, 0}}) {
    std::mt19937 random(1);
    std::vector<Geodetic> places;
    for (int i = 0; i < 200; ++i) {
      places.push_back({origin.latitude_deg + (random() % 4001 - 2000.0) * 1e-4,
                        origin.longitude_deg + (random() % 4001 - 2000.0) * 1e-4});
    }
    const auto expected = CrsFromGeodetic(FrameCrs(origin), places, "frame");
    for (size_t i = 0; i < places.size(); ++i) {
      EXPECT_LT((PlanFromGeodetic(origin, places[i]) - expected[i]).norm(), 1e-6);
    }
  }
}

TEST(Frame, ThereAndBackAgain) {
  const PlanOrigin origin{52.01102, 4.35715, 0};
  for (double x = -15000; x <= 15000; x += 1234.5) {
    for (double y = -15000; y <= 15000; y += 2345.6) {
      const Geodetic place = GeodeticFromPlan(origin, {x, y});
      EXPECT_NEAR((PlanFromGeodetic(origin, place) - Eigen::Vector2d(x, y)).norm(), 0, 1e-6);
    }
  }
}

TEST(Frame, OriginIsZeroAndNorthIsNorth) {
  const PlanOrigin origin{47.37692, 8.54173, 400};
  EXPECT_NEAR(PlanFromGeodetic(origin, {47.37692, 8.54173}).norm(), 0, 1e-9);
  const Eigen::Vector2d north = PlanFromGeodetic(origin, {47.38692, 8.54173});
  EXPECT_NEAR(north.x(), 0, 1e-9);
  EXPECT_NEAR(north.y(), 1112, 2);
}

TEST(Frame, LiesInTheWorldFrameOfASurvey) {
  const PlanOrigin origin{47.05, 15.4, 0};
  Georef same;
  same.frame = "enu";
  same.origin_latitude_deg = 47.05;
  same.origin_longitude_deg = 15.4;
  // The map and the tangent plane touch here and part with the cube of the distance.
  EXPECT_NEAR((EnuFromPlan(origin, same, {300, -200}) - Eigen::Vector2d(300, -200)).norm(), 0,
              1e-3);
  // The survey's origin lies 100 m north and 50 m east of the plan's.
  const Geodetic place = GeodeticFromPlan(origin, {50, 100});
  Georef other = same;
  other.origin_latitude_deg = place.latitude_deg;
  other.origin_longitude_deg = place.longitude_deg;
  other.origin_height_m = 400;
  EXPECT_NEAR((EnuFromPlan(origin, other, {80, 90}) - Eigen::Vector2d(30, -10)).norm(), 0, 5e-3);
}

TEST(Frame, SpansTheDateLine) {
  const PlanOrigin origin{-18.0, 179.9999, 0};
  const Eigen::Vector2d east = PlanFromGeodetic(origin, {-18.0, -179.9999});
  EXPECT_NEAR(east.x(), 21.2, 0.1);
  EXPECT_NEAR(GeodeticFromPlan(origin, east).longitude_deg, -179.9999, 1e-9);
}

TEST(Frame, OriginLiesOnALattice) {
  const PlanOrigin origin = OriginNear({50.1041234567, 14.4023987654});
  EXPECT_EQ(origin.latitude_deg, 50.10412);
  EXPECT_EQ(origin.longitude_deg, 14.40240);
  const PlanOrigin moved = OriginNear({50.1041234967, 14.4023987354});
  EXPECT_EQ(origin.latitude_deg, moved.latitude_deg);
  EXPECT_EQ(origin.longitude_deg, moved.longitude_deg);
}

}  // namespace
}  // namespace stucco
