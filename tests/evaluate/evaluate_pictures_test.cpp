// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "evaluate/evaluate.h"
#include "simulate/scene/scene_folder.h"
#include "survey/colmap_io.h"
#include "survey/files.h"
#include "survey/survey_folder.h"
#include "tests/evaluate/made_truth.h"
#include "tests/evaluate/made_walls.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;

constexpr double kTruthTexel_m = 0.01;

// A scene folder with the house, and a survey of it that has made everything but a cloud.
class SurveyedHouse : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(root_);
    for (const char* folder : {"scene/truth", "survey/calib/sparse/0", "survey/proxy",
                               "survey/texture", "survey/truth/held_out"}) {
      fs::create_directories(root_ / folder);
    }
    WriteScene();
    WriteFlight();
    WriteColmapText(MadeReconstruction(flight_), survey_ / kSparseFolder);
    WriteGeoref(MadeGeoref(), survey_ / kGeorefFile);
    WriteProxy(MadeHouse(), survey_ / kFacetsFile);
    Paint({});
  }

  void WriteScene() {
    simulate::SceneInfo info;
    info.style = "hamlet";
    info.georef = MadeGeoref();
    info.has_truth = true;
    simulate::WriteSceneInfo(info, scene_);
    simulate::WriteGlb(MadeHouseScene(), scene_ / simulate::kSceneModel);
    WriteProxy(MadeHouse(), scene_ / simulate::kTruthFacets);
  }

  void WriteFlight() {
    const simulate::Renderer house(simulate::ReadScene(scene_));
    flight_ = MadeFlight();
    flight_.scene = scene_.string();
    flight_.georef = MadeGeoref();
    for (const char* name : {"a", "b"}) {
      flight_.photos.push_back(HeldOutPhoto(std::string("held_out/") + name + ".jpg", 0.9));
      const simulate::FlownPhoto& photo = flight_.photos.back();
      WriteImage(Recorded(house, photo), survey_ / "truth" / photo.path, 100);
    }
    simulate::WriteFlight(flight_, survey_);
  }

  // As the flight's light shows the house.
  void Paint(const Painting& painting) {
    const simulate::Renderer house(simulate::ReadScene(scene_));
    TextureSet textures = PaintHouse(house, simulate::Light{}, painting, survey_ / "texture");
    textures.model_glb = "model.glb";
    simulate::WriteGlb(MadeHouseScene(), survey_ / "texture/model.glb");
    WriteTextureSet(textures, survey_ / kTexturesFile);
  }

  EvaluateRequest Request() const {
    EvaluateRequest request;
    request.survey = survey_;
    request.scene = scene_;
    request.output = root_ / "out";
    request.threads = 2;
    return request;
  }

  fs::path root_ = fs::path(::testing::TempDir()) / "stucco_surveyed_house";
  fs::path scene_ = root_ / "scene";
  fs::path survey_ = root_ / "survey";
  simulate::Flight flight_;
};

TEST_F(SurveyedHouse, TruthHasNoErrorInAnyPicture) {
  const Evaluation found = Evaluate(Request());
  EXPECT_THAT(found.notes, ::testing::Contains(::testing::HasSubstr("the cloud is not measured")));
  ASSERT_EQ(found.facades.size(), 4u);
  EXPECT_NEAR(found.painted, 1, 0.002);
  EXPECT_GT(found.texture_mean.ssim, 0.999);
  EXPECT_GT(found.texture_mean.psnr, 50);
  EXPECT_NEAR(found.misregistration_px, 0, 0.02);
  EXPECT_NEAR(found.facades[0].texel_m, kTruthTexel_m, 1e-9);
  ASSERT_EQ(found.views.size(), 2u);
  EXPECT_GT(found.views_compared, 0.995);
  EXPECT_GT(found.views_mean.ssim, 0.97);  // held-out photos are JPEGs
  for (const FacadeFigures& facade : found.facades) {
    EXPECT_TRUE(fs::exists(root_ / "out" / facade.error_picture));
  }
}

TEST_F(SurveyedHouse, ADisplacedTextureIsOffByAsMuch) {
  Paint({.texel_m = 0.02, .shift = 1.5});
  const Evaluation found = Evaluate(Request());
  EXPECT_NEAR(found.misregistration_px, 1.5, 0.05);
  EXPECT_NEAR(found.misregistration_m, 0.03, 0.001);
  EXPECT_LT(found.texture_mean.ssim, 0.9);
  EXPECT_GT(found.views_mean.ssim, 0.97);  // the model has pictures of its own
}

TEST_F(SurveyedHouse, WhatIsNotPaintedLowersTheShareAndNotTheRest) {
  TextureSet textures = ReadTextureSet(survey_ / kTexturesFile);
  std::erase_if(textures.facets, [](const auto& facet) { return facet.id == "B0001/F00"; });
  WriteTextureSet(textures, survey_ / kTexturesFile);
  const Evaluation found = Evaluate(Request());
  EXPECT_NEAR(found.painted, 1 - 3.0 / (2 * 3 + 2 * 2), 0.002);  // the south wall of four
  EXPECT_GT(found.texture_mean.ssim, 0.999);
}

TEST_F(SurveyedHouse, TheFlightMayLieElsewhere) {
  const Evaluation before = Evaluate(Request());
  const fs::path elsewhere = root_ / "elsewhere";
  fs::create_directories(elsewhere);
  fs::rename(survey_ / "truth", elsewhere / "truth");
  EvaluateRequest request = Request();
  request.flight = elsewhere;
  EXPECT_EQ(EvaluationJson(Evaluate(request)), EvaluationJson(before));
}

TEST_F(SurveyedHouse, TheSecondTimeGivesTheSameAndNoMorePictures) {
  WriteEvaluation(Evaluate(Request()), root_ / "out");
  const auto count = [&] {
    return std::distance(fs::directory_iterator(root_ / "out/pictures"), fs::directory_iterator());
  };
  const auto pictures = count();
  WriteFile(root_ / "out/pictures/0099-B0009_F00-truth.jpg", "of another model");
  const std::string json = ReadFile(root_ / "out/evaluation.json");
  WriteEvaluation(Evaluate(Request()), root_ / "out");
  EXPECT_EQ(ReadFile(root_ / "out/evaluation.json"), json);
  EXPECT_EQ(count(), pictures);
}

}  // namespace
}  // namespace stucco::evaluate
