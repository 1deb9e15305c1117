// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::LookFrom;
using test::MakeWall;

class Quality : public ::testing::Test {
 protected:
  Quality() {
    raster_ = MakeGrid(MakeWall(4, 3), Eigen::Vector3d::UnitZ(), 0.1, 1000);
    inside_.assign(raster_.size(), 1);
  }
  RasterView View(int photo, float cos_angle, float footprint) const {
    RasterView view{photo, std::vector<TexelView>(raster_.size())};
    for (TexelView& texel : view.texels) {
      texel.sight = Sight::kFree;
      texel.footprint = footprint;
      texel.cos_angle = cos_angle;
    }
    return view;
  }
  AchievedQuality Measure(const std::vector<RasterView>& views, const std::vector<int>& owner,
                          double texel) const {
    return MeasureQuality(views, photos_, {raster_, inside_, 1}, owner, texel);
  }

  TexelGrid raster_;
  std::vector<uint16_t> inside_;
  // Frontal from very far, and from 60 degrees to the left and to the right.
  std::vector<SurveyPhoto> photos_ = {
      LookFrom("a", {2, -1000, 1.5}, {2, 0, 1.5}, {100, 100, 100}),
      LookFrom("b", {2 - 866, -500, 1.5}, {2, 0, 1.5}, {100, 100, 100}),
      LookFrom("c", {2 + 866, -500, 1.5}, {2, 0, 1.5}, {100, 100, 100})};
};

TEST_F(Quality, OfOneFrontalPhotoIsOne) {
  const auto q = Measure({View(0, 1, 0.01f)}, std::vector<int>(raster_.size(), 0), 0.01);
  EXPECT_NEAR(q.q_s, 1, 1e-3);
  EXPECT_NEAR(q.q_d, 1, 1e-3);
  EXPECT_NEAR(q.q_u, 1, 1e-9);
  EXPECT_NEAR(q.q_c, 1, 1e-9);
  EXPECT_NEAR(q.footprint, 0.01, 1e-6);
}

TEST_F(Quality, FallsWithOppositeDirectionsAndUnequalDistances) {
  std::vector<int> owner(raster_.size());
  for (size_t i = 0; i < owner.size(); ++i) owner[i] = static_cast<int>(i % 2);
  const auto q = Measure({View(1, 0.5f, 0.01f), View(2, 0.5f, 0.03f)}, owner, 0.01);
  // Both 60 degrees off; their mean direction is half as long.
  EXPECT_NEAR(q.q_s, (0.5 + 0.5) / 2, 0.01);
  // Half at full, half at a third of the resolution; footprints 1 and 3, mean 2, deviation 1.
  EXPECT_NEAR(q.q_d, ((1 + 1.0 / 3) / 2 + 1 - 0.5) / 2, 0.01);
  EXPECT_NEAR(q.q_u, 0.5, 1e-9);
  EXPECT_NEAR(q.q_c, 1, 1e-9);
}

TEST_F(Quality, CountsWhatIsPainted) {
  std::vector<int> owner(raster_.size(), -1);
  for (size_t i = 0; i < owner.size() / 4; ++i) owner[i] = 0;
  const auto q = Measure({View(0, 1, 0.01f)}, owner, 0.01);
  EXPECT_NEAR(q.q_c, 0.25, 1e-9);
  EXPECT_NEAR(q.q_u, 0.25, 1e-9);
  const auto none = Measure({}, std::vector<int>(raster_.size(), -1), 0.01);
  EXPECT_EQ(none.q_s + none.q_d + none.q_u + none.q_c, 0);
}

TEST(MeasureSharpness, IsTheVarianceOfTheLaplacian) {
  Image image;
  image.width_px = 20;
  image.height_px = 20;
  image.data.assign(1200, 77);
  std::vector<uint8_t> painted(400, 1);
  EXPECT_NEAR(MeasureSharpness(image, painted), 0, 1e-9);
  for (int i = 0; i < 400; ++i) {
    const uint8_t value = (i % 20 + i / 20) % 2 == 0 ? 110 : 90;
    std::fill_n(&image.data[3 * i], 3, value);
  }
  EXPECT_NEAR(MeasureSharpness(image, painted), 80 * 80, 1e-6);
  painted.assign(400, 0);
  EXPECT_EQ(MeasureSharpness(image, painted), 0);
}

}  // namespace
}  // namespace stucco
