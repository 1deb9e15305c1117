// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "plan/space/lift.h"
#include "plan/space/safe_space.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void ExpectSafe(const SafeSpace& space, const Route& route, const Vector3d& p, const Vector3d& q) {
  ASSERT_GE(route.points.size(), 2U);
  EXPECT_EQ(route.points.front(), p);
  EXPECT_EQ(route.points.back(), q);
  EXPECT_NEAR(route.length_m, Length(route.points), 1e-9);
  for (size_t k = 1; k < route.points.size(); ++k) {
    EXPECT_TRUE(space.obstacles().IsFreeBetween(route.points[k - 1], route.points[k]));
  }
}

TEST(Corners, ASquareHasFourArcs) {
  const auto corners = DilatedCorners({{Rectangle(0, 0, 10, 10)}}, 2, std::numbers::pi / 6);
  ASSERT_EQ(corners.size(), 12U);
  for (const Corner& corner : corners) {
    const Vector2d outside = (corner.position - Vector2d(5, 5)).cwiseAbs() - Vector2d(5, 5);
    EXPECT_GE(outside.norm(), 2);
    EXPECT_LE(outside.norm(), 2 / std::cos(std::numbers::pi / 12) + 1e-12);
    EXPECT_TRUE(corner.IsTangent(corner.in));
    EXPECT_TRUE(corner.IsTangent(-corner.out));
    EXPECT_FALSE(corner.IsTangent({corner.in.y(), -corner.in.x()}));
  }
}

TEST(Corners, InnerCornersAreNone) {
  // An L has five convex corners; a courtyard's corners all turn inwards.
  const Ring shape{{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}};
  EXPECT_EQ(DilatedCorners({{shape}}, 1, 2).size(), 5U);
  EXPECT_EQ(DilatedCorners({{Reversed(Rectangle(0, 0, 10, 10))}}, 1, 2).size(), 0U);
}

TEST(Corners, DegenerateRings) {
  EXPECT_TRUE(DilatedCorners({}, 1, 1).empty());
  EXPECT_TRUE(DilatedCorners({{{{0, 0}}}}, 1, 1).empty());
  EXPECT_TRUE(DilatedCorners({{{{0, 0}, {0, 0}}}}, 1, 1).empty());
  // A line turns back at both ends; repeated corners count once.
  EXPECT_EQ(DilatedCorners({{{{0, 0}, {9, 0}}}}, 1, 4).size(), 2U);
  EXPECT_EQ(DilatedCorners({{{{0, 0}, {9, 0}, {9, 0}, {0, 9}, {0, 0}}}}, 1, 4).size(), 3U);
}

TEST(Lift, PullsTheStringTightOverWhatIsBelow) {
  Site site = MadeSite({Rectangle(0, -5, 10, 5)}, {.safe_altitude_m = 40});
  const Obstacles obstacles(site);
  const Track track{{{-50, 0}, {60, 0}}, 20, 20};
  const auto path = Lift(obstacles, track, 1000);
  ASSERT_EQ(path.size(), 4U);
  EXPECT_NEAR(path[1].x(), -10, 0.01);
  EXPECT_EQ(path[1].z(), 40);
  EXPECT_NEAR(path[2].x(), 20, 0.01);
  EXPECT_NEAR(Length(path), 2 * std::hypot(40, 20) + 30, 0.01);
  EXPECT_EQ(Lift(obstacles, track, 20).size(), 2U);  // the track's own business
}

TEST(SafeSpace, StraightWhereNothingIsInTheWay) {
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  EXPECT_DOUBLE_EQ(space.Distance({-20, 0, 10}, {-20, 40, 20}), std::hypot(40, 10));
  EXPECT_DOUBLE_EQ(space.Distance({-20, 10, 60}, {40, 10, 60}), 60);
  EXPECT_EQ(space.Distance({-20, 0, 10}, {-20, 0, 10}), 0);
}

TEST(SafeSpace, RoundsACornerAlongTheArc) {
  const Site site = MadeSite({Rectangle(0, 0, 200, 200)}, {.safe_altitude_m = 500});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Vector3d p(-11, 100, 10);
  const Vector3d q(100, -11, 10);
  const auto route = space.ShortestRoute(p, q);
  ASSERT_TRUE(route);
  ExpectSafe(space, *route, p, q);
  // Tangents to the circle of radius 10 round (0, 0), and the arc between them.
  const double reach = std::hypot(11, 100);
  const double tangent = std::sqrt(reach * reach - 100);
  // Seen from (0, 0) the ends are this far apart on the free side.
  const double free_angle = std::numbers::pi / 2 + 2 * (std::numbers::pi / 2 - std::atan2(11, 100));
  const double expected = 2 * tangent + 10 * (free_angle - 2 * std::acos(10 / reach));
  EXPECT_GE(route->length_m, expected);
  EXPECT_LE(route->length_m, expected + 0.15);
}

TEST(SafeSpace, ClimbsWhereThatIsShorter) {
  const Site site = MadeSite({Rectangle(0, -500, 20, 500)}, {.safe_altitude_m = 30});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Vector3d p(-30, 0, 20);
  const Vector3d q(50, 0, 20);
  const auto route = space.ShortestRoute(p, q);
  ASSERT_TRUE(route);
  ExpectSafe(space, *route, p, q);
  EXPECT_NEAR(route->length_m, 2 * std::hypot(20, 10) + 40, 0.01);
}

TEST(SafeSpace, GoesRoundATowerAndOverTheHouse) {
  // A wall of houses 8 m high with a tower of 200 m in its middle.
  Site site =
      MadeSite({Rectangle(0, -500, 20, -10), Rectangle(0, -10, 20, 10), Rectangle(0, 10, 20, 500)},
               {.safe_altitude_m = 300, .heights_m = {8, 200, 8}});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Vector3d p(-30, 0, 40);
  const Vector3d q(50, 0, 30);
  const auto route = space.ShortestRoute(p, q);
  ASSERT_TRUE(route);
  ExpectSafe(space, *route, p, q);
  EXPECT_LT(route->length_m, 110);
}

TEST(SafeSpace, CourtyardsAreReachedFromAbove) {
  Site site = MadeSite(
      std::vector<Polygon>{{{Rectangle(0, 0, 100, 100), Reversed(Rectangle(20, 20, 80, 80))}}});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Vector3d p(50, 50, 10);
  const Vector3d q(-30, 50, 10);
  const auto route = space.ShortestRoute(p, q);
  ASSERT_TRUE(route);
  ExpectSafe(space, *route, p, q);
  double highest = 0;
  for (const Vector3d& point : route->points) highest = std::max(highest, point.z());
  EXPECT_EQ(highest, 60);
}

TEST(SafeSpace, GoesRoundNoFlyAtAnyHeight) {
  Site site = MadeSite({Rectangle(0, 0, 20, 20)}, {.no_fly = {{{Rectangle(50, -100, 60, 100)}}}});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Vector3d p(40, 0, 300);
  const Vector3d q(70, 0, 300);
  const auto route = space.ShortestRoute(p, q);
  ASSERT_TRUE(route);
  ExpectSafe(space, *route, p, q);
  EXPECT_NEAR(route->length_m, 2 * std::hypot(10, 100) + 10, 1);
}

TEST(SafeSpace, NoWayOutOfANoFlyRing) {
  const Polygon ring{{Rectangle(-100, -100, 100, 100), Reversed(Rectangle(-50, -50, 50, 50))}};
  const Site site = MadeSite({Rectangle(-5, -5, 5, 5)}, {.no_fly = {ring}});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  EXPECT_FALSE(space.ShortestRoute({30, 30, 20}, {200, 0, 20}));
  EXPECT_TRUE(space.ShortestRoute({30, 30, 20}, {-30, -30, 20}));
  EXPECT_TRUE(std::isinf(space.Distance({30, 30, 20}, {200, 0, 20})));
}

// More corners than a search among buildings may look at: there is no other way.
TEST(SafeSpace, GoesRoundANoFlyBorderOfFiveThousandCorners) {
  Ring border;
  for (int k = 0; k < 5000; ++k) {
    const double angle = 2 * std::numbers::pi * k / 5000;
    border.emplace_back(300 + 100 * std::cos(angle), 100 * std::sin(angle));
  }
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)}, {.no_fly = {{{border}}}});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Vector3d p(150, 0, 100);
  const Vector3d q(450, 0, 100);
  const auto route = space.ShortestRoute(p, q);
  ASSERT_TRUE(route);
  ExpectSafe(space, *route, p, q);
  const double tangent = std::sqrt(150.0 * 150 - 100 * 100);
  const double arc = 100 * (std::numbers::pi - 2 * std::acos(100.0 / 150));
  EXPECT_NEAR(route->length_m, 2 * tangent + arc, 1);
}

TEST(SafeSpace, NothingLeadsToWhereNothingIsFree) {
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(space.ShortestRoute({10, 10, 10}, {-30, 0, 10}));
  EXPECT_FALSE(space.ShortestRoute({-30, 0, 10}, {10, 10, 10}));
  EXPECT_FALSE(space.ShortestRoute({-30, 0, 1}, {-30, 10, 10}));
  EXPECT_FALSE(space.ShortestRoute({-30, 0, nan}, {-30, 10, 10}));
}

TEST(SafeSpace, FollowsTheGround) {
  MadeSiteOptions options;
  options.terrain.corner = {-200, -200};
  options.terrain.step_m = 20;
  options.terrain.columns = options.terrain.rows = 41;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      options.terrain.z_m.push_back(static_cast<float>(30 * std::sin(x * 0.7) * std::cos(y * 0.4)));
    }
  }
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)}, options);
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  for (int k = 0; k < 40; ++k) {
    const Vector2d from(-150 + 7.3 * k, -120 + 3.1 * k);
    const Vector2d to(300 - 6.1 * k, 150 + 2.7 * k);
    const Vector3d p(from.x(), from.y(), site.FloorAt(from));
    const Vector3d q(to.x(), to.y(), site.FloorAt(to) + 1);
    if (!obstacles.IsFree(p) || !obstacles.IsFree(q)) continue;
    const auto route = space.ShortestRoute(p, q);
    ASSERT_TRUE(route) << k;
    ExpectSafe(space, *route, p, q);
  }
}

}  // namespace
}  // namespace stucco::plan
