// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/texture_figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/scene/scene_folder.h"
#include "tests/evaluate/made_walls.h"

namespace stucco::evaluate {
namespace {

TEST(WeightedMedian, HalvesTheWeight) {
  EXPECT_EQ(WeightedMedian({{5, 1}, {1, 1}, {3, 1}}), 3);
  EXPECT_EQ(WeightedMedian({{5, 10}, {1, 1}, {3, 1}}), 5);
  EXPECT_EQ(WeightedMedian({{std::nan(""), 100}, {2, 1}, {9, 0}}), 2);
  EXPECT_TRUE(std::isnan(WeightedMedian({})));
}

TEST(MiddleLight, IsOfThePhotosTheSurveyHas) {
  simulate::Flight flight;
  flight.photos.resize(7);
  for (size_t i = 0; i < 7; ++i) flight.photos[i].light.haze_m = static_cast<double>(i);
  flight.photos[0].lost = true;
  flight.photos[5].held_out = flight.photos[6].held_out = true;
  EXPECT_EQ(MiddleLight(flight).haze_m, 3);
  EXPECT_EQ(MiddleLight({}).haze_m, simulate::Light{}.haze_m);
}

TEST(FindOccluders, GoesByTheName) {
  simulate::Scene scene;
  scene.elements = {"B0001/F00", "occluder/tree-1", "G0"};
  EXPECT_EQ(FindOccluders(scene), (std::vector<bool>{false, true, false}));
}

TEST(TruthTexel, IsTheFinest) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "truth_texel";
  std::filesystem::create_directories(folder / "truth");
  std::filesystem::remove(folder / simulate::kTruthTextures);
  EXPECT_EQ(TruthTexel_m(folder), 0.01);
  TextureSet textures;
  textures.facets.resize(2);
  textures.facets[0].id = "a";
  textures.facets[0].metres_per_texel = 0.04;
  textures.facets[1].id = "b";
  textures.facets[1].metres_per_texel = 0.02;
  WriteTextureSet(textures, folder / simulate::kTruthTextures);
  EXPECT_EQ(TruthTexel_m(folder), 0.02);
}

TEST(MeasureTextures, TakesMeansByPaintedArea) {
  const simulate::Renderer scene(MadeHouseScene());
  const Proxy house = MadeHouse();
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "figures";
  TextureSet textures = PaintHouse(scene, {}, {.shift = 1.5}, folder);
  textures.facets[0].image.clear();
  Evaluation evaluation;
  MeasureTextures({.texture_folder = folder,
                   .proxy = house,
                   .textures = textures,
                   .truth = house,
                   .scene = scene,
                   .light = {},
                   .occluders = {},
                   .truth_from_world = {},
                   .output = folder / "evaluation",
                   .lpips_model = {},
                   .threads = 2},
                  {}, folder, evaluation);
  ASSERT_EQ(evaluation.facades.size(), 4u);
  const auto& f = evaluation.facades;
  double sum = 0;
  double area = 0;
  for (const FacadeFigures& facade : f) {
    if (facade.painted > 0) sum += facade.painted * facade.area_m2 * facade.picture.ssim;
    area += facade.painted * facade.area_m2;
  }
  EXPECT_NEAR(evaluation.texture_mean.ssim, sum / area, 1e-9);
  EXPECT_NEAR(evaluation.misregistration_px, 1.5, 0.1);
  EXPECT_TRUE(evaluation.views.empty());
  EXPECT_TRUE(std::isnan(evaluation.views_mean.psnr));
}

}  // namespace
}  // namespace stucco::evaluate
