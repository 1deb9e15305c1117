// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/facet_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A wall 4 m wide and 3 m high that faces south, with its foot at z = 10.
Facet Wall() {
  Facet wall;
  wall.normal = -Vector3d::UnitY();
  wall.offset = -7;
  wall.outer = {{100, 7, 10}, {104, 7, 10}, {104, 7, 13}, {100, 7, 13}};
  return wall;
}

// Texels of 0.1 m; the last column sticks out to the right of the wall, the last two rows below.
TexturedFacet Picture() {
  TexturedFacet picture;
  picture.width_px = 41;
  picture.height_px = 32;
  picture.metres_per_texel = 0.1;
  picture.origin = {100, 7, 13};
  picture.v_axis = -Vector3d::UnitZ();
  return picture;
}

TEST(OnPicture, CountsFromTheUpperLeftCorner) {
  EXPECT_LT((OnPicture(Picture(), {100, 7, 13}) - Vector2d(0, 0)).norm(), 1e-12);
  EXPECT_LT((OnPicture(Picture(), {104, 7, 13}) - Vector2d(40. / 41, 0)).norm(), 1e-12);
  EXPECT_LT((OnPicture(Picture(), {104.1, 7, 9.8}) - Vector2d(1, 1)).norm(), 1e-12);
  EXPECT_LT((OnPicture(Picture(), {99.9, 7, 10}) - Vector2d(-1. / 41, 30. / 32)).norm(), 1e-12);
}

TEST(OnPicture, FollowsTiltedAxes) {
  TexturedFacet picture = Picture();
  picture.v_axis = Vector3d(0, -0.6, -0.8);  // down a roof
  const Vector3d texel = picture.origin + 0.1 * (20.5 * picture.u_axis + 16 * picture.v_axis);
  EXPECT_LT((OnPicture(picture, texel) - Vector2d(0.5, 0.5)).norm(), 1e-12);
}

#ifndef NDEBUG
TEST(OnPictureDeathTest, RequiresASize) {
  EXPECT_DEATH(OnPicture(TexturedFacet(), {0, 0, 0}), "HasSize");
}
#endif

TEST(FitsFacet, ThePictureThatWasPaintedOnIt) {
  EXPECT_TRUE(FitsFacet(Picture(), Wall()));
}

TEST(FitsFacet, RefusesPicturesOfAnotherFacet) {
  TexturedFacet before = Picture(), beside = Picture(), turned = Picture(), wider = Picture();
  before.origin.y() -= 0.3;
  beside.origin.x() += 0.3;
  turned.u_axis = -turned.u_axis;  // of a wall that faces north
  turned.origin.x() += 4;
  wider.width_px += 3;
  for (const TexturedFacet& picture : {before, beside, turned, wider, TexturedFacet()}) {
    EXPECT_FALSE(FitsFacet(picture, Wall()));
  }
  Facet nowhere = Wall();
  nowhere.offset = std::nan("");
  EXPECT_FALSE(FitsFacet(Picture(), nowhere));
}

}  // namespace
}  // namespace stucco
