// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/occluders.h"

#include <gtest/gtest.h>

#include <vector>

namespace stucco {
namespace {

using Eigen::Vector3d;

// An upright square of 2 m, 5 m to the east of `at`.
Occluders SquareEastOf(const Vector3d& at) {
  const std::vector<Vector3d> vertices = {at + Vector3d(5, -1, -1), at + Vector3d(5, 1, -1),
                                          at + Vector3d(5, 1, 1), at + Vector3d(5, -1, 1)};
  const std::vector<std::array<uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  return {vertices, triangles};
}

TEST(Occluders, BlockWhatLeadsThroughThemFromEitherSide) {
  const Occluders square = SquareEastOf(Vector3d::Zero());
  EXPECT_TRUE(square.Block({0, 0, 0}, {1, 0, 0}, 10));
  EXPECT_TRUE(square.Block({10, 0.5, -0.5}, {-1, 0, 0}, 10));
  EXPECT_TRUE(square.Block({0, 0, 0}, {10, 1, 1}, 1));  // the way need not have length 1
}

TEST(Occluders, BlockNothingBesideBeforeOrBehind) {
  const Occluders square = SquareEastOf(Vector3d::Zero());
  EXPECT_FALSE(square.Block({0, 1.01, 0}, {1, 0, 0}, 10));
  EXPECT_FALSE(square.Block({0, 0, -1.01}, {1, 0, 0}, 10));
  EXPECT_FALSE(square.Block({0, 0, 0}, {1, 0, 0}, 4.99));
  EXPECT_FALSE(square.Block({0, 0, 0}, {-1, 0, 0}, 10));
}

TEST(Occluders, SayHowFarTheFirstOneIs) {
  const Occluders square = SquareEastOf(Vector3d::Zero());
  EXPECT_NEAR(square.FirstHit({0, 0, 0}, {1, 0, 0}).value_or(-1), 5, 1e-6);
  EXPECT_NEAR(square.FirstHit({0, 0, 0}, {10, 1, 1}).value_or(-1), 0.5, 1e-6);
  EXPECT_NEAR(square.FirstHit({10, 0, 0}, {-1, 0, 0}).value_or(-1), 5, 1e-6);
  EXPECT_FALSE(square.FirstHit({0, 0, 0}, {-1, 0, 0}));
  EXPECT_FALSE(square.FirstHit({0, 3, 0}, {1, 0, 0}));
}

TEST(Occluders, KeepCentimetresFarFromTheOrigin) {
  const Vector3d far(4.5e5, 5.5e6, 300);
  const Occluders square = SquareEastOf(far);
  EXPECT_TRUE(square.Block(far + Vector3d(0, 0.99, 0.99), {1, 0, 0}, 5.01));
  EXPECT_FALSE(square.Block(far + Vector3d(0, 1.01, 0.99), {1, 0, 0}, 5.01));
  EXPECT_FALSE(square.Block(far + Vector3d(0, 0.99, 0.99), {1, 0, 0}, 4.99));
}

TEST(Occluders, OfNoTrianglesBlockNothing) {
  EXPECT_FALSE(Occluders({}, {}).Block({0, 0, 0}, {1, 0, 0}, 1e6));
}

TEST(Occluders, BlockAfterAMove) {
  Occluders from = SquareEastOf(Vector3d::Zero());
  Occluders to({}, {});
  to = std::move(from);
  EXPECT_TRUE(to.Block({0, 0, 0}, {1, 0, 0}, 10));
}

}  // namespace
}  // namespace stucco
