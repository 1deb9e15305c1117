// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "plan/map/read_dem.h"
#include "survey/coordinate_system.h"
#include "tests/plan/made_map.h"

namespace stucco::plan {
namespace {

const Eigen::AlignedBox2d kBounds(Eigen::Vector2d(-101.3, -97.9), Eigen::Vector2d(103.1, 99.2));

// A raster whose pixels can be looked up, and what ReadDem makes of it.
class ReadDemTest : public testing::TestWithParam<MadeDem> {
 protected:
  // `height` of column, row.
  void Make(const std::function<double(int, int)>& height) {
    const int n = GetParam().pixels;
    z_.clear();
    WriteDem(folder_ / "dem.tif", GetParam(), [&](double, double) {
      const int i = static_cast<int>(z_.size());
      z_.push_back(static_cast<float>(height(i % n, i / n)));
      return z_.back();
    });
    read_ = ReadDem(folder_ / "dem.tif", origin_, kBounds);
  }

  // The bilinear surface of the raster.
  double Source(const Eigen::Vector2d& position) const {
    const MadeDem& dem = GetParam();
    const std::vector<Geodetic> places = {kMadePlace, GeodeticFromPlan(origin_, position)};
    const auto at = CrsFromGeodetic(dem.crs, places, "test");
    const Eigen::Vector2d shift = (at[1] - at[0]) / dem.step;
    const double column = dem.pixels / 2. + shift.x() - 0.5;
    const double row = dem.pixels / 2. - shift.y() - 0.5;
    const int i = static_cast<int>(std::floor(column));
    const int j = static_cast<int>(std::floor(row));
    const auto z = [&](int x, int y) { return double{z_.at(y * dem.pixels + x)}; };
    return std::lerp(std::lerp(z(i, j), z(i + 1, j), column - i),
                     std::lerp(z(i, j + 1), z(i + 1, j + 1), column - i), row - j);
  }

  // Least and most of the terrain above the raster.
  Interval Above() const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(kBounds.min().x(), kBounds.max().x());
    std::uniform_real_distribution<double> y(kBounds.min().y(), kBounds.max().y());
    Interval above{1e9, -1e9};
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector2d at(x(random), y(random));
      const double d = read_.terrain.HeightAt(at) + read_.origin_height_m - Source(at);
      above = {std::min(above.from_m, d), std::max(above.to_m, d)};
    }
    return above;
  }

  test::TemporaryFolder folder_;
  PlanOrigin origin_ = OriginNear(kMadePlace);
  std::vector<float> z_;
  ReadTerrain read_;
};

constexpr double kRounding = 0.001;  // floats of some hundred metres, bent projections

TEST_P(ReadDemTest, RidgesOfAPixelAreNotCut) {
  const int n = GetParam().pixels;
  Make([&](int column, int row) {
    return 300 + (column % 8 == 3 ? 40 : 0) + (row == n / 2 ? 25 : 0);
  });
  EXPECT_GE(Above().from_m, -kRounding);
  EXPECT_LE(Above().to_m, 65 + kRounding);  // not higher than the highest
}

TEST_P(ReadDemTest, NoiseIsCovered) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(0, 30);
  Make([&](int, int) { return 100 + noise(random); });
  EXPECT_GE(Above().from_m, -kRounding);
  Make([&](int column, int row) { return 100 + 2 * column - 3 * row + noise(random); });
  EXPECT_GE(Above().from_m, -kRounding);
}

TEST_P(ReadDemTest, EvenGroundStays) {
  Make([](int column, int row) { return 250 + 0.5 * column - 0.3 * row; });
  EXPECT_GE(Above().from_m, -kRounding);
  EXPECT_LE(Above().to_m, 0.01);
  const double per_pixel = 2 * std::numbers::pi / 40;
  Make([&](int column, int row) {
    return 250 + 2 * std::sin(column * per_pixel) * std::cos(row * per_pixel);
  });
  EXPECT_GE(Above().from_m, -kRounding);
  EXPECT_LE(Above().to_m, 0.4);  // hills of 40 pixels and +-2 m
}

TEST_P(ReadDemTest, GapsBesideRidgesAreCovered) {
  Make([](int column, int) { return column % 10 == 4 ? std::nan("") : column % 10 == 5 ? 50 : 0; });
  double highest = 0;
  for (double x = -50; x < 50; ++x) {
    const double z = read_.terrain.HeightAt({x, 3}) + read_.origin_height_m;
    EXPECT_TRUE(z >= 0 && z < 75) << z;
    highest = std::max(highest, z);
  }
  EXPECT_GE(highest, 50 - kRounding);
}

TEST_P(ReadDemTest, TheGroundIsNotRaised) {
  Make([&](int column, int) { return 300 + (column % 8 == 3 ? 40 : 0); });
  double ground = 0;
  double terrain = 0;
  for (size_t i = 0; i < read_.ground.z_m.size(); ++i) {
    ground += read_.ground.z_m[i] / read_.ground.z_m.size();
    terrain += read_.terrain.z_m[i] / read_.ground.z_m.size();
  }
  EXPECT_NEAR(ground + read_.origin_height_m, 305, 1);  // 40 / 8
  EXPECT_GT(terrain, ground + 5);
}

// UTM turns the raster against the frame by half a degree; degrees make pixels that are no squares.
INSTANTIATE_TEST_SUITE_P(Rasters, ReadDemTest,
                         testing::Values(MadeDem{.pixels = 300, .step = 1},
                                         MadeDem{.pixels = 120, .step = 2},
                                         MadeDem{.pixels = 50, .step = 7.3},
                                         MadeDem{.crs = "EPSG:4326", .pixels = 80, .step = 5e-5}),
                         [](const auto& test) { return std::to_string(test.param.pixels) + "px"; });

}  // namespace
}  // namespace stucco::plan
