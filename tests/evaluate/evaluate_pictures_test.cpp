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
#include "tests/survey/temporary_folder.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;

constexpr double kTruthTexel_m = 0.01;

// A scene folder with the house, a survey of it that has made everything but a cloud, and its
// evaluation, made once; each test has a copy of the survey.
class SurveyedHouse : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::TemporaryFolder();
    for (const char* folder : {"scene/truth", "survey/calib/sparse/0", "survey/proxy",
                               "survey/texture", "survey/truth/held_out"}) {
      fs::create_directories(*folder_ / folder);
    }
    WriteHouse();
    const fs::path survey = *folder_ / "survey";
    const simulate::Flight flight = FlyAround(survey);
    WriteColmapText(MadeReconstruction(flight), survey / kSparseFolder);
    WriteGeoref(MadeGeoref(), survey / kGeorefFile);
    WriteProxy(MadeHouse(), survey / kFacetsFile);
    Paint({}, survey);
    right_ = new Evaluation(Evaluate(RequestIn(folder_->path())));
  }
  static void TearDownTestSuite() {
    delete right_;
    delete folder_;
  }

  void SetUp() override {
    for (const char* made : {"survey", "out"}) {
      fs::copy(*folder_ / made, root_ / made, fs::copy_options::recursive);
    }
  }

  static void WriteHouse() {
    simulate::SceneInfo info;
    info.style = "hamlet";
    info.georef = MadeGeoref();
    info.has_truth = true;
    simulate::WriteSceneInfo(info, Scene());
    simulate::WriteGlb(MadeHouseScene(), Scene() / simulate::kSceneModel);
    WriteProxy(MadeHouse(), Scene() / simulate::kTruthFacets);
  }

  static simulate::Flight FlyAround(const fs::path& survey) {
    const simulate::Renderer house(simulate::ReadScene(Scene()));
    simulate::Flight flight = MadeFlight();
    flight.scene = Scene().string();
    flight.georef = MadeGeoref();
    for (const char* name : {"a", "b"}) {
      flight.photos.push_back(HeldOutPhoto(std::string("held_out/") + name + ".jpg", 0.9));
      const simulate::FlownPhoto& photo = flight.photos.back();
      WriteImage(Recorded(house, photo), survey / "truth" / photo.path, 100);
    }
    simulate::WriteFlight(flight, survey);
    return flight;
  }

  // As the flight's light shows the house.
  static void Paint(const Painting& painting, const fs::path& survey) {
    const simulate::Renderer house(simulate::ReadScene(Scene()));
    TextureSet textures = PaintHouse(house, simulate::Light{}, painting, survey / "texture");
    textures.model_glb = "model.glb";
    simulate::WriteGlb(MadeHouseScene(), survey / "texture/model.glb");
    WriteTextureSet(textures, survey / kTexturesFile);
  }

  static EvaluateRequest RequestIn(const fs::path& root) {
    EvaluateRequest request;
    request.survey = root / "survey";
    request.scene = Scene();
    request.output = root / "out";
    request.threads = 2;
    return request;
  }

  static fs::path Scene() { return *folder_ / "scene"; }
  EvaluateRequest Request() const { return RequestIn(root_.path()); }

  static test::TemporaryFolder* folder_;
  static Evaluation* right_;
  test::TemporaryFolder root_;
  fs::path survey_ = root_ / "survey";
};

test::TemporaryFolder* SurveyedHouse::folder_ = nullptr;
Evaluation* SurveyedHouse::right_ = nullptr;

TEST_F(SurveyedHouse, TruthHasNoErrorInAnyPicture) {
  const Evaluation& found = *right_;
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
  Paint({.texel_m = 0.02, .shift = 1.5}, survey_);
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
  const fs::path elsewhere = root_ / "elsewhere";
  fs::create_directories(elsewhere);
  fs::rename(survey_ / "truth", elsewhere / "truth");
  EvaluateRequest request = Request();
  request.flight = elsewhere;
  EXPECT_EQ(EvaluationJson(Evaluate(request)), EvaluationJson(*right_));
}

TEST_F(SurveyedHouse, TheSecondTimeGivesTheSameAndNoMorePictures) {
  WriteEvaluation(*right_, root_ / "out");
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
