// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/arrangement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace stucco {
namespace {

using Eigen::Vector2d;

const Eigen::AlignedBox2d kBox(Vector2d(0, 0), Vector2d(4, 3));

CutLine Line(double x, double y, double angle_deg) {
  const double a = angle_deg * std::numbers::pi / 180;
  return {.point = {x, y}, .direction = {std::cos(a), std::sin(a)}};
}

double AreaOfFace(const Arrangement& arrangement, size_t f) {
  return SignedArea(RingOf(arrangement, f));
}

Vector2d CenterOfFace(const Arrangement& arrangement, size_t f) {
  Vector2d sum = Vector2d::Zero();
  for (const int v : arrangement.faces[f]) sum += arrangement.vertices[v];
  return sum / double(arrangement.faces[f].size());
}

TEST(Arrange, CutsAGrid) {
  const std::vector<CutLine> lines = {Line(1, 0, 90), Line(2, 0, 90), Line(0, 1, 0)};
  const Arrangement arrangement = Arrange(kBox, lines);
  EXPECT_EQ(arrangement.faces.size(), 6u);
  EXPECT_EQ(arrangement.vertices.size(), 12u);
  EXPECT_EQ(arrangement.edges.size(), 17u);
}

TEST(Arrange, LinesThroughOnePointAndOutsideTheBox) {
  const std::vector<CutLine> lines = {Line(2, 1, 0), Line(2, 1, 60), Line(2, 1, 120),
                                      Line(0, 9, 3)};
  const Arrangement arrangement = Arrange(kBox, lines);
  EXPECT_EQ(arrangement.faces.size(), 6u);
}

TEST(Arrange, FacesFillTheBoxWhateverTheLines) {
  std::mt19937_64 engine(7);
  const auto uniform = [&](double high) { return high * double(engine() >> 11) * 0x1p-53; };
  for (int round = 0; round < 200; ++round) {
    std::vector<CutLine> lines;
    for (int i = 0; i < 8; ++i) {
      const double x = uniform(4), y = uniform(3), angle_deg = uniform(180);
      lines.push_back(Line(x, y, angle_deg));
      // In every other round a twin, which is the same in one of five.
      const double apart = uniform(1) < 0.2 ? 0 : std::pow(10, -uniform(16));
      if (round % 2 == 0) lines.push_back(Line(x + apart, y, angle_deg + uniform(2) * apart));
    }
    const Arrangement arrangement = Arrange(kBox, lines);
    double area = 0;
    for (size_t f = 0; f < arrangement.faces.size(); ++f) {
      EXPECT_GT(AreaOfFace(arrangement, f), 0);
      area += AreaOfFace(arrangement, f);
    }
    EXPECT_NEAR(area, 12, 1e-9);
    // Euler: without the outer face.
    EXPECT_EQ(int(arrangement.vertices.size()) - int(arrangement.edges.size()) +
                  int(arrangement.faces.size()),
              1);
  }
}

TEST(UnionOf, ARingHasAHoleAndNoStraightCorners) {
  std::vector<CutLine> lines;
  for (const double x : {1.0, 2.0, 3.0}) lines.push_back(Line(x, 0, 90));
  for (const double y : {1.0, 2.0}) lines.push_back(Line(0, y, 0));
  const Arrangement arrangement = Arrange(kBox, lines);
  std::vector<bool> inside(arrangement.faces.size());
  for (size_t f = 0; f < inside.size(); ++f) {
    const Vector2d c = CenterOfFace(arrangement, f);
    inside[f] = c.x() < 3 && !(c.x() > 1 && c.x() < 2 && c.y() > 1 && c.y() < 2);
  }
  const auto polygons = UnionOf(arrangement, inside);
  ASSERT_EQ(polygons.size(), 1u);
  EXPECT_EQ(polygons[0].rings[0].size(), 4u);
  ASSERT_EQ(polygons[0].rings.size(), 2u);
  EXPECT_EQ(polygons[0].rings[1].size(), 4u);
  EXPECT_GT(SignedArea(polygons[0].rings[0]), 0);
  EXPECT_LT(SignedArea(polygons[0].rings[1]), 0);
  EXPECT_NEAR(Area(polygons[0]), 8, 1e-12);
}

TEST(UnionOf, FacesThatTouchInACornerAreTwoPolygons) {
  const std::vector<CutLine> lines = {Line(2, 0, 90), Line(0, 1.5, 0)};
  const Arrangement arrangement = Arrange(kBox, lines);
  std::vector<bool> inside(4);
  for (size_t f = 0; f < 4; ++f) {
    const Vector2d c = CenterOfFace(arrangement, f);
    inside[f] = (c.x() < 2) == (c.y() < 1.5);
  }
  const auto polygons = UnionOf(arrangement, inside);
  ASSERT_EQ(polygons.size(), 2u);
  for (const auto& polygon : polygons) EXPECT_EQ(polygon.rings[0].size(), 4u);
}

TEST(UnionOf, NothingInsideIsNoPolygon) {
  EXPECT_TRUE(UnionOf(Arrange(kBox, {}), {false}).empty());
}

}  // namespace
}  // namespace stucco
