// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "texture/painting/composite.h"

namespace stucco {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 96;

Layer Flat(float value) {
  return {std::vector<float>(3 * kWidth * kHeight, value),
          std::vector<uint8_t>(kWidth * kHeight, 1)};
}

// Left half of the first layer, right half of the second.
std::vector<int> Halves() {
  std::vector<int> labels(kWidth * kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) labels[i] = i % kWidth < kWidth / 2 ? 0 : 1;
  return labels;
}

float At(const std::vector<float>& rgb, int x, int y) {
  return rgb[3 * (y * kWidth + x)];
}

TEST(BlendLayers, LeavesEqualPicturesAlone) {
  std::vector<Layer> layers = {Flat(0), Flat(0)};
  for (int i = 0; i < 3 * kWidth * kHeight; ++i) {
    layers[0].rgb[i] = layers[1].rgb[i] = static_cast<float>((i * 7919) % 256);
  }
  const auto blended = BlendLayers(layers, Halves(), kWidth, kHeight);
  for (size_t i = 0; i < blended.size(); ++i) EXPECT_NEAR(blended[i], layers[0].rgb[i], 0.01);
}

TEST(BlendLayers, TurnsAStepIntoAGentleSlope) {
  const auto blended =
      BlendLayers(std::vector<Layer>{Flat(100), Flat(140)}, Halves(), kWidth, kHeight);
  EXPECT_NEAR(At(blended, 10, 48), 100, 3);
  EXPECT_NEAR(At(blended, kWidth - 10, 48), 140, 3);
  EXPECT_NEAR(At(blended, kWidth / 2, 48), 120, 3);
  for (int x = 1; x < kWidth; ++x) {
    const float step = At(blended, x, 48) - At(blended, x - 1, 48);
    EXPECT_LT(step, 2);
    EXPECT_GT(step, -0.5);
  }
}

TEST(BlendLayers, KeepsFineDetailOnItsOwnSide) {
  std::vector<Layer> layers = {Flat(100), Flat(100)};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    for (int k = 0; k < 3; ++k) layers[1].rgb[3 * i + k] += (i % kWidth) % 2 == 0 ? 40.0f : -40.0f;
  }
  const auto blended = BlendLayers(layers, Halves(), kWidth, kHeight);
  EXPECT_NEAR(At(blended, kWidth / 2 - 10, 48), 100, 1);
  EXPECT_NEAR(std::abs(At(blended, kWidth / 2 + 10, 48) - 100), 40, 1);
}

TEST(BlendLayers, DoesNotLetUnseenPartsLeak) {
  std::vector<Layer> layers = {Flat(100), Flat(100)};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    if (i % kWidth >= kWidth / 2) continue;
    layers[1].valid[i] = 0;  // an occluder, or outside the photo
    for (int k = 0; k < 3; ++k) layers[1].rgb[3 * i + k] = 0;
  }
  for (float value : BlendLayers(layers, Halves(), kWidth, kHeight)) EXPECT_NEAR(value, 100, 0.1);
}

TEST(BlendLayers, ContinuesColoursWhereNobodyOwns) {
  std::vector<int> labels = Halves();
  for (int i = 0; i < kWidth * kHeight; ++i) {
    if (i / kWidth < 20) labels[i] = -1;
  }
  const auto blended = BlendLayers(std::vector<Layer>{Flat(80), Flat(80)}, labels, kWidth, kHeight);
  for (float value : blended) EXPECT_NEAR(value, 80, 0.01);
}

TEST(JoinLayers, TakesEachTexelFromItsOwner) {
  const auto joined =
      JoinLayers(std::vector<Layer>{Flat(100), Flat(140)}, Halves(), kWidth, kHeight);
  EXPECT_EQ(At(joined, kWidth / 2 - 1, 3), 100);
  EXPECT_EQ(At(joined, kWidth / 2, 3), 140);
}

// Two photos of a level plane, one brighter, joined along a crooked border: where tiles meet the
// picture must not show it.
TEST(ComposePicture, HasNoTraceOfItsTiles) {
  TexelGrid grid;
  grid.width = 1600;
  grid.height = 64;
  grid.u_axis = Eigen::Vector3d::UnitX();
  grid.v_axis = -Eigen::Vector3d::UnitY();
  grid.normal = Eigen::Vector3d::UnitZ();
  SurveyPhoto photo;
  photo.camera.width_px = 1700;
  photo.camera.height_px = 200;
  photo.camera.params = {1000, 1000, 850, 100};
  photo.cam_from_world.rotation = Eigen::Quaterniond(0, 1, 0, 0);  // looks down
  photo.cam_from_world.translation =
      -(photo.cam_from_world.rotation * Eigen::Vector3d(800, -32, 1000));
  Image flat;
  flat.width_px = 1700;
  flat.height_px = 200;
  flat.data.assign(3 * 1700 * 200, 120);
  const auto pyramid =
      std::make_shared<const PhotoPyramid>(BuildPyramid(std::move(flat), 1700, 200));
  const std::vector<uint8_t> mask(grid.size(), 1);
  Ownership ownership;
  ownership.step = 4;
  ownership.raster_width = 400;
  for (int i = 0; i < 400 * 16; ++i) ownership.owner.push_back(i % 400 < 190 + i / 400 ? 0 : 1);
  std::vector<PhotoLayer> chosen(2);
  for (int k = 0; k < 2; ++k) {
    chosen[k].photo = &photo;
    chosen[k].open = [=] { return pyramid; };
    chosen[k].gain = Eigen::Vector3d::Constant(1 + 0.3 * k);
    chosen[k].sight.assign(400 * 16, Sight::kFree);
  }
  const Composite composite = ComposePicture(grid, mask, chosen, ownership, true);
  EXPECT_EQ(composite.picture.Pixel(10, 30)[0], 120);
  EXPECT_EQ(composite.picture.Pixel(1590, 30)[0], 156);
  EXPECT_EQ(composite.labels[30 * 1600 + 10], 1);
  EXPECT_EQ(composite.labels[30 * 1600 + 1590], 2);
  for (int x = 1; x < grid.width; ++x) {
    EXPECT_LE(std::abs(composite.picture.Pixel(x, 30)[0] - composite.picture.Pixel(x - 1, 30)[0]),
              2)
        << x;
  }
}

}  // namespace
}  // namespace stucco
