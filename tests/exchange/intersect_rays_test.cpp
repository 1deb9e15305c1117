// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/intersect_rays.h"

#include <gtest/gtest.h>

#include "tests/exchange/made_model.h"

namespace stucco {
namespace {

ExchangedPoint SeenAt(const Reconstruction& model, const Eigen::Vector3d& position) {
  ExchangedPoint point;
  for (const auto& [id, photo] : model.photos) {
    point.pixels.emplace_back(
        id, *model.cameras.at(photo.camera).Project(photo.cam_from_world * position));
  }
  return point;
}

TEST(IntersectRays, FindsTheirPoint) {
  const Reconstruction model = MadeModel();
  const Eigen::Vector3d position(1, 2, 30);
  ExchangedPoint point = SeenAt(model, position);
  EXPECT_LT((*IntersectRays(point, model) - position).norm(), 1e-6);
  for (auto& [id, pixel] : point.pixels) pixel.x() += id.value == 2 ? 0.5 : -0.5;
  // Half a pixel of 160 over a base of 10 at a distance of 30.
  EXPECT_LT((*IntersectRays(point, model) - position).norm(), 1);
}

TEST(IntersectRays, NothingWhereTheyTellNoDepth) {
  Reconstruction model = MadeModel();
  ExchangedPoint point = SeenAt(model, {1, 2, 3000});
  EXPECT_FALSE(IntersectRays(point, model));
  point = SeenAt(model, {1, 2, 30});
  point.pixels.resize(1);
  EXPECT_FALSE(IntersectRays(point, model));
  // Rays that part ahead of the cameras meet behind them.
  point = SeenAt(model, {1, 2, 30});
  for (auto& [id, pixel] : point.pixels) pixel.x() -= 60.0 * id.value;
  EXPECT_FALSE(IntersectRays(point, model));
}

}  // namespace
}  // namespace stucco
