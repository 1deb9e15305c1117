// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "simulate/flight/lens.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

PlannedCamera Mavic() {
  return {"mavic-3e", "Mavic", 12.29e-3, 17.3e-3, 13e-3, 5280, 3956};
}

TEST(Lens, EveryPixelHasOneRayAndComesBack) {
  for (const double distortion : {0.0, 1.0, 2.0}) {
    for (int seed = 1; seed <= 20; ++seed) {
      FlightOptions options;
      options.seed = seed;
      options.distortion = distortion;
      const Camera lens = MakeLens(Mavic(), options);
      for (double x = 0; x <= lens.width_px; x += lens.width_px / 12.0) {
        for (double y = 0; y <= lens.height_px; y += lens.height_px / 12.0) {
          const auto ray = lens.Unproject({x, y});
          ASSERT_TRUE(ray.has_value()) << seed << " " << x << " " << y;
          ASSERT_TRUE(lens.IsInvertibleAt(*ray));
          EXPECT_LT((lens.Distort(*ray) - Eigen::Vector2d(x, y)).norm(), 1e-6);
        }
      }
    }
  }
}

TEST(Lens, WithoutDistortionItIsTheDataSheets) {
  FlightOptions options;
  options.distortion = 0;
  options.scale = 0.25;
  const Camera lens = MakeLens(Mavic(), options);
  EXPECT_EQ(lens.width_px, 1320);
  EXPECT_EQ(lens.height_px, 989);
  EXPECT_DOUBLE_EQ(lens.FocalX(), 12.29 / 17.3 * 1320);
  EXPECT_EQ(lens.PrincipalPoint(), Eigen::Vector2d(660, 494.5));
  for (int i = 4; i < 8; ++i) EXPECT_EQ(lens.params[i], 0);
}

TEST(Lens, SeedsMakeDifferentBodiesCloseToTheDataSheet) {
  FlightOptions options;
  const Camera one = MakeLens(Mavic(), options);
  EXPECT_EQ(MakeLens(Mavic(), options).params, one.params);
  options.seed = 2;
  EXPECT_NE(MakeLens(Mavic(), options).params, one.params);
  const double nominal = 12.29 / 17.3 * 5280;
  EXPECT_GT(std::abs(one.FocalX() / nominal - 1), 0.004);
  EXPECT_LT(std::abs(one.FocalX() / nominal - 1), 0.016);
  // Some percent at the corner, as wide lenses of drones have.
  const Eigen::Vector2d corner(one.width_px, one.height_px);
  const Eigen::Vector2d straight =
      (corner - one.PrincipalPoint()).cwiseQuotient(Eigen::Vector2d(one.FocalX(), one.FocalY()));
  const double moved = (one.Distort(straight) - corner).norm() / (corner / 2).norm();
  EXPECT_GT(moved, 0.03);
  EXPECT_LT(moved, 0.1);
}

// Another compiler must not draw in another order.
TEST(Lens, SeedOneIsWhatItWas) {
  FlightOptions options;
  options.seed = 1;
  const Camera lens = MakeLens(Mavic(), options);
  EXPECT_NEAR(lens.FocalX(), 3776.7661, 1e-3);
  EXPECT_NEAR(lens.PrincipalPoint().y(), 1996.4081, 1e-3);
}

TEST(Lens, NeedsACamera) {
  EXPECT_THROW(MakeLens(PlannedCamera{}, {}), Error);
  EXPECT_EQ(FocalOn35mm_mm(Mavic()), 25);
}

}  // namespace
}  // namespace stucco::simulate
