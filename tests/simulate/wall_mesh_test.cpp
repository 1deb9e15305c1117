// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/wall_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWidth_m = 6;
constexpr double kHeight_m = 5;
constexpr int kWall = 0;
constexpr int kPane = 1;
constexpr int kTrim = 2;

WallPart Part(PartKind kind, const Vector2d& top_left, const Vector2d& bottom_right,
              double relief) {
  WallPart part;
  part.kind = kind;
  part.top_left = top_left;
  part.bottom_right = bottom_right;
  part.relief_m = relief;
  return part;
}

// A wall that looks south-west, at a place of its own.
WallShape Shape() {
  WallShape shape;
  const Eigen::Rotation2Dd turn(-0.7);
  const Vector2d u = turn * Vector2d::UnitX();
  shape.sheet.element = 3;
  shape.sheet.material = kWall;
  shape.sheet.origin = {10, -20, 7};
  shape.sheet.u = {u.x(), u.y(), 0};
  shape.sheet.width_m = kWidth_m;
  shape.sheet.height_m = kHeight_m;
  shape.pane_material = kPane;
  shape.trim = {.element = 3, .material = kTrim, .size_m = 2};
  shape.outline = {{0, kHeight_m}, {kWidth_m, kHeight_m}, {kWidth_m, 0}, {0, 0}};
  return shape;
}

struct Hit {
  double out = 0;  // of the wall's plane
  int material = 0;
  Vector2d uv = Vector2d::Zero();
  bool front = false;  // of the triangle
};

// What one sees of the model at (x, y) of the wall's picture from far before it.
std::optional<Hit> Seen(const CityModel& model, const Sheet& sheet, const Vector2d& at) {
  std::optional<Hit> nearest;
  const Scene& scene = model.scene;
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    std::array<Vector2d, 3> p;
    std::array<double, 3> out;
    for (int k = 0; k < 3; ++k) {
      const Vector3d from = scene.positions[scene.triangles[i][k]].cast<double>() - sheet.origin;
      p[k] = {from.dot(sheet.u), from.dot(sheet.v)};
      out[k] = from.dot(sheet.normal());
    }
    Eigen::Matrix2d edges;
    edges << p[1] - p[0], p[2] - p[0];
    if (std::abs(edges.determinant()) < 1e-6) continue;
    const Vector2d b = edges.inverse() * (at - p[0]);
    if (b.minCoeff() < 0 || b.sum() > 1) continue;
    const double depth = out[0] + b.x() * (out[1] - out[0]) + b.y() * (out[2] - out[0]);
    if (nearest && nearest->out >= depth) continue;
    const auto uv = [&](int k) -> Vector2d {
      return scene.uv[scene.triangles[i][k]].cast<double>();
    };
    // On the picture y runs down, so that what faces the viewer turns clockwise in (x, y).
    nearest =
        Hit{depth, scene.materials_of[i], uv(0) + b.x() * (uv(1) - uv(0)) + b.y() * (uv(2) - uv(0)),
            edges.determinant() < 0};
  }
  return nearest;
}

// Every place of the wall shows what the design has there, at its depth, with the picture's own
// texel.
void ExpectAsDesigned(const WallDesign& design) {
  const WallShape shape = Shape();
  CityModel model;
  AddWall(shape, design, model);
  for (double y = 0.053; y < kHeight_m; y += 0.1) {
    for (double x = 0.047; x < kWidth_m; x += 0.1) {
      double relief = 0;
      bool glass = false;
      for (const WallPart& part : design.parts) {
        if (x < part.top_left.x() || x > part.bottom_right.x() || y < part.top_left.y() ||
            y > part.bottom_right.y()) {
          continue;
        }
        if (part.relief_m < relief || part.relief_m > 0) {
          relief = part.relief_m;
          const double to_frame = std::min({x - part.top_left.x(), part.bottom_right.x() - x,
                                            y - part.top_left.y(), part.bottom_right.y() - y});
          glass = HasPane(part) && to_frame > 0.07;
        }
      }
      const auto hit = Seen(model, shape.sheet, {x, y});
      ASSERT_TRUE(hit) << "a hole at " << x << " " << y;
      ASSERT_NEAR(hit->out, relief, 1e-5) << x << " " << y;
      ASSERT_TRUE(hit->front) << x << " " << y;
      ASSERT_EQ(hit->material, glass ? kPane : kWall) << x << " " << y;
      ASSERT_NEAR(hit->uv.x(), x / kWidth_m, 1e-5);
      ASSERT_NEAR(hit->uv.y(), y / kHeight_m, 1e-5);
    }
  }
}

TEST(WallMesh, BareWallIsItsOutline) {
  ExpectAsDesigned({});
}

TEST(WallMesh, RecessesLieBehindTheWall) {
  WallDesign design;
  design.parts = {Part(PartKind::kWindow, {0.5, 0.5}, {1.7, 2}, -0.2),
                  Part(PartKind::kDoor, {2.5, 2.6}, {3.6, 4.8}, -0.3),
                  Part(PartKind::kShopWindow, {4, 3}, {5.5, 4.5}, -0.25),
                  Part(PartKind::kWindow, {4, 0.5}, {5.5, 2.1}, -1.5)};
  ExpectAsDesigned(design);
}

TEST(WallMesh, BalconiesStandOutAndHideTheFootOfTheirDoor) {
  WallDesign design;
  design.parts = {Part(PartKind::kBalconyDoor, {2.3, 1}, {3.5, 3.1}, -0.2),
                  Part(PartKind::kBalcony, {1.5, 2.1}, {4.3, 3.3}, 1.2)};
  ExpectAsDesigned(design);
}

TEST(WallMesh, BandsRunAlongTheWall) {
  WallDesign design;
  design.parts = {Part(PartKind::kCornice, {0, 0.1}, {kWidth_m, 0.45}, 0.3),
                  Part(PartKind::kLedge, {0, 2.4}, {kWidth_m, 2.6}, 0.1)};
  ExpectAsDesigned(design);
}

// A frame as wide as the opening leaves no room for a pane.
TEST(WallMesh, TinyWindowsAreAllFrame) {
  WallDesign design;
  design.parts = {Part(PartKind::kWindow, {1, 1}, {1.1, 2}, -0.2)};
  ExpectAsDesigned(design);
}

}  // namespace
}  // namespace stucco::simulate
