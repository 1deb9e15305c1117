// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/registration.h"

#include <gtest/gtest.h>

#include <random>

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStep_m = 0.65;  // what two million samples leave of a town of 600 houses
constexpr double kHeight_m = 9;
constexpr double kAround_m = 3;

// Houses in rows, none exactly where a regular town would have it.
std::vector<Eigen::AlignedBox2d> Houses(int rows) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-2, 2);
  std::vector<Eigen::AlignedBox2d> houses;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < rows; ++column) {
      const Vector2d low(24 * column + jitter(random), 21 * row + jitter(random));
      houses.emplace_back(low, low + Vector2d(12 + jitter(random), 9 + jitter(random)));
    }
  }
  return houses;
}

Ring RingOf(const Eigen::AlignedBox2d& box) {
  return {box.min(), {box.max().x(), box.min().y()}, box.max(), {box.min().x(), box.max().y()}};
}

OutlineMap MapOf(const std::vector<Eigen::AlignedBox2d>& houses, const Vector2d& off) {
  OutlineMap map;
  for (const Eigen::AlignedBox2d& house : houses) {
    const Ring ring = RingOf(Eigen::AlignedBox2d(house).translate(off));
    map.buildings.emplace_back().parts.push_back(Polygon{{ring}});
    for (size_t i = 0; i < ring.size(); ++i) {
      Facade& facade = map.facades.emplace_back();
      facade.a = ring[i];
      facade.b = ring[(i + 1) % ring.size()];
    }
  }
  return map;
}

void Add(const Vector3d& position, const Vector3d& normal, Samples& samples) {
  samples.positions.push_back(position);
  samples.normals.push_back(normal);
  samples.weights.push_back(1);
  samples.cameras.push_back(-1);
}

// A scan without cameras, which does not know the inside of a wall from its outside.
UprightSurvey ScanOf(const std::vector<Eigen::AlignedBox2d>& houses) {
  std::mt19937 random(6);
  Samples samples;
  samples.cell = kStep_m;
  for (const Eigen::AlignedBox2d& house : houses) {
    const Ring ring = RingOf(house);
    for (size_t i = 0; i < ring.size(); ++i) {
      const Segment2d edge = EdgeOf(ring, i);
      const double length = (edge.b - edge.a).norm();
      const Vector2d along = (edge.b - edge.a) / length;
      for (double at = kStep_m / 2; at < length; at += kStep_m) {
        for (double z = kStep_m / 2; z < kHeight_m; z += kStep_m) {
          const Vector2d p = edge.a + at * along;
          const double side = random() % 2 == 0 ? 1 : -1;
          Add({p.x(), p.y(), z}, side * Vector3d(along.y(), -along.x(), 0), samples);
        }
      }
    }
    const Vector2d low = house.min().array() - kAround_m;
    const Vector2d high = house.max().array() + kAround_m;
    for (double x = low.x(); x < high.x(); x += kStep_m) {
      for (double y = low.y(); y < high.y(); y += kStep_m) {
        Add({x, y, house.contains(Vector2d(x, y)) ? kHeight_m : 0}, Vector3d::UnitZ(), samples);
      }
    }
  }
  return UprightSurveyOf(std::move(samples), {.spacing = kStep_m}, Vector3d::UnitZ());
}

TEST(RegisterMap, FindsATownOfManyHouses) {
  const auto houses = Houses(20);
  const Vector2d off(-2, 1.5);
  const MapRegistration found = RegisterMap(ScanOf(houses), MapOf(houses, off));
  EXPECT_EQ(found.refused, "");
  EXPECT_LT((found.shift_m + off).norm(), 0.1);
  EXPECT_NEAR(found.turn_rad, 0, 1e-3);
  EXPECT_GT(found.raised_inside, 0.95);
}

TEST(RegisterMap, RefusesTheMapOfAnotherTown) {
  const auto houses = Houses(10);
  std::vector<Eigen::AlignedBox2d> others;
  others.reserve(houses.size());
  for (const Eigen::AlignedBox2d& house : houses) {
    others.emplace_back(1.3 * house.min(), 1.3 * house.min() + Vector2d(16, 7));
  }
  EXPECT_NE(RegisterMap(ScanOf(houses), MapOf(others, {0, 0})).refused, "");
}

}  // namespace
}  // namespace stucco
