// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "evaluate/picture/compare_textures.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/evaluate/made_pictures.h"
#include "tests/evaluate/made_walls.h"

namespace stucco::evaluate {
namespace {

using simulate::FlownPhoto;
using simulate::Renderer;

struct PosedSurvey {
  std::filesystem::path folder;
  Proxy proxy = MadeHouse();
  TextureSet textures;
  simulate::Flight flight;
  Similarity truth_from_world;
};

// OBJ with y up, as the reader takes it: x east, y up, z south.
void WriteModel(const simulate::Scene& scene, const std::filesystem::path& folder) {
  std::string obj = "mtllib model.mtl\n";
  std::string mtl;
  for (const Eigen::Vector3f& p : scene.positions) {
    obj += fmt::format("v {} {} {}\n", p.x(), p.z(), -p.y());
  }
  for (const Eigen::Vector2f& uv : scene.uv) obj += fmt::format("vt {} {}\n", uv.x(), 1 - uv.y());
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    const Eigen::Vector3i t = scene.triangles[i].array() + 1;
    obj += fmt::format("usemtl m{0}\nf {1}/{1} {2}/{2} {3}/{3}\n", scene.materials_of[i], t.x(),
                       t.y(), t.z());
  }
  for (size_t i = 0; i < scene.textures.size(); ++i) {
    mtl += fmt::format("newmtl m{0}\nKd 1 1 1\nmap_Kd wall{0}.png\n", i);
    WriteImage(scene.textures[i], folder / fmt::format("wall{}.png", i));
  }
  WriteFile(folder / "model.obj", obj);
  WriteFile(folder / "model.mtl", mtl);
}

void WriteModelInWorld(simulate::Scene model, const PosedSurvey& survey) {
  const Similarity world_from_truth = survey.truth_from_world.Inverse();
  for (Eigen::Vector3f& position : model.positions) {
    const Eigen::Vector3d world = world_from_truth * position.cast<double>();
    position = (world - survey.textures.model_offset).cast<float>();
  }
  WriteModel(model, survey.folder);
}

// The house as a model in a world that is turned, moved and offset against the scene, and two
// photos of it.
PosedSurvey PosedHouse(const std::string& name, const Renderer& scene) {
  PosedSurvey survey;
  survey.folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::create_directories(survey.folder / "truth/held_out");
  survey.truth_from_world.scale = 0.5;
  survey.truth_from_world.rotation = Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitZ());
  survey.truth_from_world.translation = {-3000, 700, 12};
  survey.textures.model_glb = "model.obj";
  survey.textures.model_offset = {2000, -6000, 0};
  WriteModelInWorld(MadeHouseScene(), survey);
  survey.flight.photos = {HeldOutPhoto("held_out/a.jpg", 0.9), HeldOutPhoto("held_out/b.jpg", 1.1)};
  for (const FlownPhoto& photo : survey.flight.photos) {
    WriteImage(Recorded(scene, photo), survey.folder / "truth" / photo.path, 100);
  }
  return survey;
}

std::vector<HeldOutFigures> CompareWith(const PosedSurvey& survey, const Renderer& scene,
                                        const std::vector<bool>& occluders = {}) {
  const Proxy truth = MadeHouse();
  return CompareViews({.texture_folder = survey.folder,
                       .proxy = survey.proxy,
                       .textures = survey.textures,
                       .truth = truth,
                       .scene = scene,
                       .light = {},
                       .flight = survey.flight,
                       .occluders = occluders,
                       .truth_from_world = survey.truth_from_world,
                       .output = survey.folder / "evaluation",
                       .lpips_model = {},
                       .threads = 2},
                      survey.folder);
}

TEST(CompareViews, APerfectModelLooksLikeThePhotos) {
  const Renderer scene(MadeHouseScene());
  const PosedSurvey survey = PosedHouse("views", scene);
  const auto figures = CompareWith(survey, scene);
  ASSERT_EQ(figures.size(), 2u);
  for (const HeldOutFigures& view : figures) {
    // JPEG takes a little of the photo: it keeps a quarter of the colours.
    EXPECT_GT(view.picture.ssim, 0.97) << view.photo;
    EXPECT_GT(view.picture.psnr, 33) << view.photo;
    EXPECT_LT(view.picture.flip, 0.08) << view.photo;
    EXPECT_GT(view.buildings.ssim, 0.97) << view.photo;
    EXPECT_TRUE(std::filesystem::exists(survey.folder / "evaluation" / view.error_picture));
  }
  EXPECT_EQ(figures[1].photo, "held_out/b.jpg");
}

TEST(CompareViews, AModelElsewhereDoesNot) {
  const Renderer scene(MadeHouseScene());
  PosedSurvey survey = PosedHouse("views_off", scene);
  const double right = CompareWith(survey, scene)[0].picture.ssim;
  survey.truth_from_world.translation.x() += 0.05;
  EXPECT_LT(CompareWith(survey, scene)[0].picture.ssim, right - 0.1);
}

TEST(CompareViews, WhatHidesTheModelIsLeftOut) {
  const Renderer bare(MadeHouseScene());
  PosedSurvey survey = PosedHouse("views_tree", bare);
  simulate::Scene with_tree = MadeHouseScene();
  AddBoard("occluder/tree-1", 1, with_tree);
  const Renderer scene(with_tree);
  for (const FlownPhoto& photo : survey.flight.photos) {
    WriteImage(Recorded(scene, photo), survey.folder / "truth" / photo.path, 100);
  }
  std::vector<bool> occluders(scene.scene().elements.size(), false);
  const HeldOutFigures unknown = CompareWith(survey, scene, occluders)[0];
  const double with = unknown.picture.psnr;
  occluders.back() = true;
  const double without = CompareWith(survey, scene, occluders)[0].picture.psnr;
  EXPECT_LT(with, 22);
  EXPECT_GT(without, 30);
  EXPECT_GT(unknown.buildings.psnr, 30);  // the board is none
}

TEST(CompareViews, SaysHowMuchOfTheBuildingsTheModelHas) {
  const Renderer scene(MadeHouseScene());
  const PosedSurvey survey = PosedHouse("views_share", scene);
  EXPECT_GT(CompareWith(survey, scene)[0].compared, 0.995);
  simulate::Scene part = MadeHouseScene();
  part.triangles.resize(1);
  part.materials_of.resize(1);
  part.elements_of.resize(1);
  WriteModelInWorld(part, survey);
  const HeldOutFigures found = CompareWith(survey, scene)[0];
  EXPECT_GT(found.compared, 0.05);
  EXPECT_LT(found.compared, 0.6);
}

TEST(CompareViews, NothingHeldOutIsNothing) {
  const Renderer scene(MadeHouseScene());
  PosedSurvey survey = PosedHouse("views_none", scene);
  for (FlownPhoto& photo : survey.flight.photos) photo.held_out = false;
  EXPECT_TRUE(CompareWith(survey, scene).empty());
}

TEST(CompareViews, AMissingPhotoIsNamedAndTheOtherIsMeasured) {
  const Renderer scene(MadeHouseScene());
  PosedSurvey survey = PosedHouse("views_missing", scene);
  survey.flight.photos[0].path = "held_out/gone.jpg";
  const auto figures = CompareWith(survey, scene);
  EXPECT_THAT(figures[0].problem, testing::HasSubstr("gone.jpg"));
  EXPECT_TRUE(std::isnan(figures[0].picture.psnr));
  EXPECT_EQ(figures[1].problem, "");
  EXPECT_GT(figures[1].picture.psnr, 33);
}

TEST(CompareViews, AMissingModelIsAnErrorThatNamesIt) {
  const Renderer scene(MadeHouseScene());
  PosedSurvey survey = PosedHouse("views_missing", scene);
  survey.textures.model_glb = "gone.glb";
  try {
    CompareWith(survey, scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("gone.glb"));
  }
}

}  // namespace
}  // namespace stucco::evaluate
