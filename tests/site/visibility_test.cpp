// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/visibility.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace stucco {
namespace {

using Eigen::Vector2d;

constexpr double kFar = 1000;

// The walls of a counter-clockwise contour; facades are numbered on from `first`.
void AddContour(const std::vector<Vector2d>& corners, int first, std::vector<MapWall>& walls) {
  for (size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()], first + static_cast<int>(i)});
  }
}

std::vector<Vector2d> Box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

const SeenFacade* Find(const std::vector<SeenFacade>& seen, int facade) {
  for (const SeenFacade& f : seen) {
    if (f.facade == facade) return &f;
  }
  return nullptr;
}

TEST(Visibility, OneBoxShowsTheSideThatFacesTheViewer) {
  std::vector<MapWall> walls;
  AddContour(Box(0, 0, 10, 10), 0, walls);
  const auto seen = Visibility(walls).From({5, -20}, kFar);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].facade, 0);
  EXPECT_EQ(seen[0].seen, (Intervals{{0, 10}}));
}

TEST(Visibility, EveryDirectionOfTheFirstRayIsSeamless) {
  std::vector<MapWall> walls;
  AddContour(Box(-10, -5, 0, 5), 0, walls);  // west of the viewer: the sweep starts on its wall
  const auto seen = Visibility(walls).From({10, 0}, kFar);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].facade, 1);
  EXPECT_EQ(seen[0].seen, (Intervals{{0, 10}}));
}

TEST(Visibility, ABoxInFrontCastsItsShadow) {
  std::vector<MapWall> walls;
  AddContour(Box(-50, 20, 50, 30), 0, walls);
  AddContour(Box(-1, 9, 1, 10), 4, walls);
  const auto seen = Visibility(walls).From({0, 0}, kFar);
  const SeenFacade* back = Find(seen, 0);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->seen.size(), 2u);
  const double half = 20.0 / 9;  // of the shadow of the box's front corners
  EXPECT_NEAR(back->seen[0].to_m, 50 - half, 1e-12);
  EXPECT_NEAR(back->seen[1].from_m, 50 + half, 1e-12);
  EXPECT_EQ(Find(seen, 4)->seen, (Intervals{{0, 2}}));
}

TEST(Visibility, NothingBeyondTheRadiusIsSeen) {
  std::vector<MapWall> walls;
  AddContour(Box(-50, 30, 50, 40), 0, walls);
  const auto seen = Visibility(walls).From({0, 0}, 50);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].seen[0].from_m, 10, 1e-12);
  EXPECT_NEAR(seen[0].seen[0].to_m, 90, 1e-12);
  EXPECT_TRUE(Visibility(walls).From({0, 0}, 30).empty());
}

TEST(Visibility, ACourtyardIsSeenFromInsideOnly) {
  std::vector<MapWall> walls;
  AddContour(Box(0, 0, 40, 40), 0, walls);
  AddContour({{10, 10}, {10, 30}, {30, 30}, {30, 10}}, 4, walls);  // clockwise: a hole
  const Visibility visibility(walls);
  const auto inside = visibility.From({20, 20}, kFar);
  ASSERT_EQ(inside.size(), 4u);
  for (const SeenFacade& facade : inside) {
    EXPECT_GE(facade.facade, 4);
    EXPECT_NEAR(Length(facade.seen), 20, 1e-12);
  }
  for (const SeenFacade& facade : visibility.From({-20, 20}, kFar)) EXPECT_LT(facade.facade, 4);
}

TEST(Visibility, AViewerInLineWithAWallDoesNotSeeIt) {
  std::vector<MapWall> walls;
  AddContour(Box(0, 0, 10, 10), 0, walls);
  const auto seen = Visibility(walls).From({-5, 0}, kFar);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].facade, 3);
}

TEST(Visibility, HousesThatShareACornerLeaveNoGap) {
  std::vector<MapWall> walls;
  AddContour(Box(0, 10, 10, 20), 0, walls);
  AddContour(Box(10, 20, 20, 30), 4, walls);
  AddContour(Box(-100, 60, 100, 70), 8, walls);  // behind them
  const auto seen = Visibility(walls).From({10, 0}, kFar);
  ASSERT_TRUE(Find(seen, 8));
  for (const Interval& part : Find(seen, 8)->seen) {
    const bool left = part.to_m <= 100 - 0 + 1e-9 && part.to_m < 60;
    const bool right = part.from_m > 130;
    EXPECT_TRUE(left || right) << part.from_m << " " << part.to_m;
  }
}

TEST(Visibility, FirstHitMeetsOnlyFacingWalls) {
  std::vector<MapWall> walls;
  AddContour(Box(0, 10, 10, 20), 0, walls);
  const Visibility visibility(walls);
  EXPECT_NEAR(visibility.FirstHit({5, 0}, {0, 1}, 100), 10, 1e-12);
  EXPECT_NEAR(visibility.FirstHit({5, 40}, {0, -1}, 100), 20, 1e-12);
  EXPECT_EQ(visibility.FirstHit({5, 0}, {0, -1}, 100), 100);
  EXPECT_EQ(visibility.FirstHit({5, 0}, {0, 1}, 6), 6);
  EXPECT_EQ(visibility.FirstHit({5, 12}, {0, 1}, 100), 100);  // leaves from inside
}

// Cleaned maps may hold crossings of less than they are rounded to; with crossing walls there is no
// right answer, but there has to be one.
TEST(Visibility, CrossingWallsDoNoHarm) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-50, 50);
  for (int round = 0; round < 300; ++round) {
    std::vector<MapWall> walls;
    for (int i = 0; i < 30; ++i) {
      walls.push_back({{uniform(random), uniform(random)}, {uniform(random), uniform(random)}, i});
    }
    walls.push_back(walls[3]);  // twice the same
    for (const SeenFacade& facade : Visibility(walls).From({0, 0}, kFar)) {
      const MapWall& wall = walls[facade.facade];
      for (const Interval& part : facade.seen) {
        EXPECT_GE(part.from_m, 0);
        EXPECT_LE(part.to_m, (wall.b - wall.a).norm() + 1e-9);
      }
    }
  }
}

// A town of separate boxes turned by many angles; every wall point is checked against all walls by
// brute force.
class RandomTown : public testing::TestWithParam<int> {
 protected:
  RandomTown() : random_(GetParam()) {
    std::uniform_real_distribution<double> uniform(0, 1);
    int facade = 0;
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) {
        const double turn = uniform(random_) * 2 * std::numbers::pi,
                     half = 3 + 4 * uniform(random_);
        const Vector2d centre(25 * column, 25 * row);
        const Eigen::Rotation2Dd rotation(GetParam() % 2 ? turn : 0);  // half of them in line
        std::vector<Vector2d> corners;
        for (const Vector2d& corner : Box(-half, -half / 2, half, half / 2)) {
          corners.push_back(centre + rotation * corner);
        }
        AddContour(corners, facade, walls_);
        facade += 4;
      }
    }
  }

  bool IsHidden(const Vector2d& p, const Vector2d& x, size_t own) const {
    const auto cross = [](const Vector2d& u, const Vector2d& v) {
      return u.x() * v.y() - u.y() * v.x();
    };
    for (size_t i = 0; i < walls_.size(); ++i) {
      const MapWall& wall = walls_[i];
      if (i == own) continue;
      const Vector2d d = x - p, u = wall.b - wall.a;
      const double turn = cross(d, u);
      if (turn == 0) continue;
      const double s = cross(wall.a - p, u) / turn, t = cross(wall.a - p, d) / turn;
      if (s > 1e-9 && s < 1 - 1e-9 && t >= 0 && t <= 1) return true;
    }
    return false;
  }

  std::mt19937 random_;
  std::vector<MapWall> walls_;
};

TEST_P(RandomTown, AgreesWithBruteForce) {
  const Visibility visibility(walls_);
  std::uniform_real_distribution<double> uniform(0, 1);
  int checked = 0, seen_points = 0;
  for (int round = 0; round < 30; ++round) {
    const Vector2d p(25 * std::floor(5 * uniform(random_)) + 12.5,
                     25 * std::floor(5 * uniform(random_)) + 12.5 + uniform(random_));
    const auto seen = visibility.From(p, 80);
    for (size_t i = 0; i < walls_.size(); ++i) {
      const MapWall& wall = walls_[i];
      const double length = (wall.b - wall.a).norm(), at = uniform(random_) * length;
      const Vector2d x = wall.a + (wall.b - wall.a) * (at / length);
      const Vector2d u = (wall.b - wall.a) / length;
      const bool faces = Vector2d(u.y(), -u.x()).dot(p - x) > 0;
      const bool expected = faces && (x - p).norm() < 80 && !IsHidden(p, x, i);
      bool found = false, near_end = false;
      if (const SeenFacade* facade = Find(seen, static_cast<int>(i))) {
        for (const Interval& part : facade->seen) {
          found |= part.from_m <= at && at <= part.to_m;
          near_end |= std::abs(part.from_m - at) < 1e-6 || std::abs(part.to_m - at) < 1e-6;
        }
      }
      if (near_end) continue;
      EXPECT_EQ(found, expected) << "wall " << i << " at " << at << " from " << p.transpose();
      ++checked;
      seen_points += expected;
    }
  }
  EXPECT_GT(checked, 4000);
  EXPECT_GT(seen_points, 200);
}

INSTANTIATE_TEST_SUITE_P(Towns, RandomTown, testing::Range(0, 6));

}  // namespace
}  // namespace stucco
