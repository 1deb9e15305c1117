// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/detect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "proxy/cloud/normals.h"
#include "proxy/planes/consolidate.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::Capture;
using test::Captured;
using test::CaptureOptions;

struct Found {
  Samples samples;
  std::vector<Plane> planes;
};

Found Find(const Captured& captured, double epsilon) {
  Found found;
  found.samples = ThinCloud(StreamOf(captured.cloud), captured.photos, 1000000, 0);
  const GridIndex index(found.samples.positions, 0.4);
  const auto agreement = SmoothNormals(found.samples, index, 0.4, 1);
  found.planes = DetectPlanes(found.samples, index, agreement,
                              {.radius = 0.4, .epsilon = epsilon, .min_points = 60});
  return found;
}

TEST(DetectPlanes, FindsTheSixSidesOfAHouse) {
  const auto house = test::GableHouse();
  const Found found = Find(Capture({house}, {}, {.noise = 0}), 0.05);
  ASSERT_EQ(found.planes.size(), 6u);
  for (const auto& polygon : house.polygons) {
    const Eigen::Vector4d truth = test::PlaneOf(polygon);
    const auto matches = [&](const Plane& plane) {
      return (plane.normal - truth.head<3>()).norm() < 2e-3 &&
             std::abs(plane.offset - truth[3]) < 5e-3;
    };
    EXPECT_EQ(std::count_if(found.planes.begin(), found.planes.end(), matches), 1) << polygon.name;
  }
}

TEST(DetectPlanes, BearsNoiseAndStrays) {
  const auto house = test::GableHouse();
  const Found found = Find(Capture({house}, {}, {.noise = 0.04, .outliers = 0.2}), 0.15);
  ASSERT_GE(found.planes.size(), 6u);
  for (const auto& polygon : house.polygons) {
    const Eigen::Vector4d truth = test::PlaneOf(polygon);
    double best_deg = 180;
    for (size_t p = 0; p < 6; ++p) {
      best_deg =
          std::min(best_deg, std::acos(std::min(1.0, found.planes[p].normal.dot(truth.head<3>()))) *
                                 180 / std::numbers::pi);
    }
    EXPECT_LT(best_deg, 0.4) << polygon.name;
  }
}

TEST(DetectPlanes, KeepsTheTwoSidesOfAThinWallApart) {
  Captured captured;
  for (int x = 0; x < 40; ++x) {
    for (int z = 0; z < 40; ++z) {
      for (const float side : {-1.F, 1.F}) {
        captured.cloud.positions.emplace_back(0.1 * x, 0.02 * side, 0.1 * z);
        captured.cloud.normals.emplace_back(0.F, side, 0.F);
      }
    }
  }
  const Found found = Find(captured, 0.1);
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_LT(found.planes[0].normal.dot(found.planes[1].normal), -0.99);
}

TEST(DetectPlanes, FindsNothingInNothing) {
  EXPECT_TRUE(Find({}, 0.1).planes.empty());
}

TEST(DropClutter, DropsTreesAndKeepsWalls) {
  Captured captured = Capture({test::BoxHouse(8, 6, 5)}, {}, {.noise = 0.03});
  test::AddTree({0, -9, 4}, 2.5, 12000, 5, captured);
  Found found = Find(captured, 0.15);
  const Tolerances tolerances{.level_of_detail = 0.3,
                              .epsilon = 0.15,
                              .min_area = 1.44,
                              .fill_gap = 1.5,
                              .spacing = 0.12,
                              .radius = 0.4};
  DropClutter(found.samples, tolerances, 35, found.planes);
  EXPECT_EQ(found.planes.size(), 5u);
}

TEST(MergeCoplanar, JoinsThePartsOfAWallAndNothingElse) {
  // A wall in two parts with a gap, and a third part set back by a metre.
  CaptureOptions options{.noise = 0.01};
  std::vector<test::TruePolygon> walls;
  for (const auto& [x, y] : {std::pair{-4.0, 0.0}, {4.0, 0.0}, {0.0, 1.0}}) {
    walls.push_back({"wall", {{x - 1.5, y, 0}, {x + 1.5, y, 0}, {x + 1.5, y, 3}, {x - 1.5, y, 3}}});
  }
  Found found = Find(Capture({}, walls, options), 0.1);
  ASSERT_EQ(found.planes.size(), 3u);
  MergeCoplanar(found.samples, {.epsilon = 0.1}, 35, found.planes);
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_GT(found.planes[0].points.size(), 1.8 * double(found.planes[1].points.size()));
}

// A wall in the plane y = 0 that looks at y < 0, with what stands beside its right end: `depth`
// behind the wall, turned by `turn_deg`, after a gap. Planes are in this order.
Found WallWithPart(double depth, double turn_deg, double gap) {
  Captured captured;
  const double turn = turn_deg * std::numbers::pi / 180;
  const auto add = [&](double x, double y, double z, const Eigen::Vector3f& normal) {
    captured.cloud.positions.emplace_back(x, y, z);
    captured.cloud.normals.push_back(normal);
  };
  for (int z = 0; z < 20; ++z) {
    for (int x = 0; x < 40; ++x) add(0.1 * x, 0, 0.1 * z, {0, -1, 0});
    for (int x = 0; x < 10; ++x) {
      const double along = 0.1 * x;
      add(4 + gap + along * std::cos(turn), depth + along * std::sin(turn), 0.1 * z,
          {float(std::sin(turn)), -float(std::cos(turn)), 0});
    }
  }
  Found found;
  found.samples = ThinCloud(StreamOf(captured.cloud), captured.photos, 1000000, 0);
  found.planes.resize(2);
  for (size_t i = 0; i < found.samples.size(); ++i) {
    found.planes[found.samples.positions[i].x() < 3.95 ? 0 : 1].points.push_back(int(i));
  }
  found.planes[0].normal = found.planes[1].normal = -Eigen::Vector3d::UnitY();
  for (Plane& plane : found.planes) Refit(found.samples, plane);
  return found;
}

// How many points each plane of such a wall is left with.
std::pair<size_t, size_t> LeftTo(Found found, bool part_is_idle, int part_building = 0) {
  TakeApartIdle(found.samples, {.level_of_detail = 0.3, .spacing = 0.1, .radius = 0.4}, 35,
                {.idle = {false, part_is_idle}, .building = {0, part_building}}, found.planes);
  return {found.planes[0].points.size(), found.planes[1].points.size()};
}

TEST(TakeApartIdle, AWallTakesWhatStandsBackInItByLessThanADetail) {
  EXPECT_EQ(LeftTo(WallWithPart(0.2, 0, 0), true), (std::pair<size_t, size_t>{1000, 0}));
  EXPECT_EQ(LeftTo(WallWithPart(0, 12, 0), true), (std::pair<size_t, size_t>{1000, 0}));
}

TEST(TakeApartIdle, PointsBeyondADetailAreNobodys) {
  // Turned by 25 degrees the part is farther than 0.3 m behind the wall after 0.71 m of its 0.9 m.
  EXPECT_EQ(LeftTo(WallWithPart(0, 25, 0), true), (std::pair<size_t, size_t>{960, 0}));
}

TEST(TakeApartIdle, LeavesWhatIsFartherApartOrMadeAFacet) {
  const std::pair<size_t, size_t> as_they_were{800, 200};
  EXPECT_EQ(LeftTo(WallWithPart(0.4, 0, 0), true), as_they_were);  // a step of its own
  EXPECT_EQ(LeftTo(WallWithPart(0, 60, 0), true), as_they_were);   // another wall
  EXPECT_EQ(LeftTo(WallWithPart(0.2, 0, 2), true), as_they_were);  // not beside it
  EXPECT_EQ(LeftTo(WallWithPart(0.2, 0, 0), false), as_they_were);
  EXPECT_EQ(LeftTo(WallWithPart(0.2, 0, 0), true, 1), as_they_were);  // another building's
}

}  // namespace
}  // namespace stucco
