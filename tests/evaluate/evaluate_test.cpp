// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "simulate/flight/flight_folder.h"
#include "simulate/scene/scene_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"
#include "tests/evaluate/made_survey.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

fs::path Root() {
  return fs::path(::testing::TempDir()) / "stucco_evaluate_test";
}

EvaluateRequest RequestFor(const MadeSurvey& made) {
  EvaluateRequest request;
  request.survey = made.survey;
  request.scene = made.scene;
  request.tolerance_m = 0.3;  // 70 random points a square metre: the chance of a gap is 1e-9
  request.threads = 2;
  return request;
}

void ExpectNoError(const Evaluation& found) {
  EXPECT_EQ(found.poses.posed, 13);
  EXPECT_NEAR(found.poses.position_max_m, 0, 1e-6);
  EXPECT_NEAR(found.poses.rotation_max_deg, 0, 1e-4);
  EXPECT_NEAR(found.dense.all.error95_m, 0, 1e-5);  // the model is in single precision
  EXPECT_EQ(found.dense.all.completeness, 1);
  EXPECT_NEAR(found.proxy.surface.all.error95_m, 0, 1e-5);
  EXPECT_EQ(found.proxy.surface.all.completeness, 1);
  EXPECT_EQ(found.proxy.watertight, 2);
  EXPECT_NEAR(found.proxy.facade_id_rate, 1, 1e-6);
}

TEST(Evaluate, TruthHasNoErrorInAnyMeasure) {
  const Evaluation found = Evaluate(RequestFor(WriteMadeSurvey(Root(), {})));
  ExpectNoError(found);
  EXPECT_NEAR(found.poses.georeferenced_mean_m, 0, 1e-6);
  EXPECT_EQ(found.survey, "survey");
  EXPECT_EQ(found.scene, "scene");
  EXPECT_TRUE(found.has_plan);
  EXPECT_EQ(found.plan.method, "cocapture");
  EXPECT_EQ(found.plan.hovers, 9);
  EXPECT_EQ(found.plan.q_u, 0.75);
  EXPECT_TRUE(std::isnan(found.mesh.all.error95_m));
}

TEST(Evaluate, AnotherWorldIsBroughtBack) {
  ExpectNoError(Evaluate(RequestFor(WriteMadeSurvey(Root(), AnySimilarity()))));
}

TEST(Evaluate, TheSameAtAnyNumberOfThreads) {
  EvaluateRequest request = RequestFor(WriteMadeSurvey(Root(), AnySimilarity()));
  const std::string two = EvaluationJson(Evaluate(request));
  request.threads = 1;
  EXPECT_EQ(two, EvaluationJson(Evaluate(request)));
}

TEST(Evaluate, AMeshCountsLikeACloud) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  WriteFile(made.survey / "dense/mesh.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
            "end_header\n0 0 6.2\n10 0 6.2\n10 8 6.2\n0 8 6.2\n4 0 1 2 3\n");
  const Evaluation found = Evaluate(RequestFor(made));
  EXPECT_NEAR(found.mesh.all.error95_m, 0.2, 1e-5);
  EXPECT_GT(found.mesh.all.completeness_all, 0.02);
}

TEST(Evaluate, WhatIsNotThereIsNotedAndNotMeasured) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  fs::remove_all(made.survey / "dense");
  fs::remove_all(made.survey / "plan");
  Evaluation found = Evaluate(RequestFor(made));
  EXPECT_TRUE(std::isnan(found.dense.all.error95_m));
  EXPECT_FALSE(found.has_plan);
  EXPECT_EQ(found.proxy.watertight, 2);
  EXPECT_THAT(
      found.notes,
      Contains("the cloud is not measured: there is no dense/cloud.ply; stucco run makes it"));
  EXPECT_THAT(
      found.notes,
      Contains("the plan is not measured: there is no plan/stats.json; stucco plan makes it"));
  fs::remove_all(made.survey / "calib");
  found = Evaluate(RequestFor(made));
  EXPECT_EQ(found.poses.posed, 0);
  EXPECT_EQ(found.poses.total, 13);
  EXPECT_TRUE(std::isnan(found.proxy.surface.all.error95_m));
  EXPECT_THAT(found.notes, Contains(HasSubstr("there is no calib/sparse/0")));
}

TEST(Evaluate, WhatIsDamagedIsNotedAndTheRestIsMeasured) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  for (const char* file : {"plan/stats.json", "dense/cloud.ply", "texture/textures.json"}) {
    fs::create_directories((made.survey / file).parent_path());
    WriteFile(made.survey / file, "not what it should be");
  }
  Evaluation found = Evaluate(RequestFor(made));
  EXPECT_FALSE(found.has_plan);
  EXPECT_TRUE(std::isnan(found.dense.all.error95_m));
  EXPECT_NEAR(found.proxy.surface.all.error95_m, 0, 1e-5);
  for (const char* what : {"the plan is not measured: ", "the cloud is not measured: ",
                           "textures and views are not measured: "}) {
    EXPECT_THAT(found.notes, Contains(HasSubstr(what)));
  }
  EXPECT_THAT(found.notes, Contains(HasSubstr("cloud.ply")));
  WriteFile(made.scene / simulate::kSceneModel, "no model");
  found = Evaluate(RequestFor(made));
  EXPECT_EQ(found.poses.posed, 13);
  EXPECT_THAT(found.notes, Contains(HasSubstr("scene.glb")));
  WriteFile(made.survey / kGeorefFile, "{");
  found = Evaluate(RequestFor(made));
  EXPECT_NEAR(found.poses.position_max_m, 0, 1e-6);
  EXPECT_TRUE(std::isnan(found.poses.georeferenced_mean_m));
  EXPECT_THAT(found.notes, Contains(HasSubstr("georef.json")));
  fs::remove_all(made.survey / kSparseFolder);
  WriteFile(made.survey / kSparseFolder, "no folder");
  found = Evaluate(RequestFor(made));
  EXPECT_EQ(found.poses.total, 13);
  EXPECT_THAT(found.notes, Contains(HasSubstr("poses, and what lies in their frame, are not")));
}

void ExpectRefused(const EvaluateRequest& request, ErrorKind kind, const std::string& reason) {
  try {
    Evaluate(request);
    FAIL() << "was not refused: " << reason;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind);
    EXPECT_THAT(error.what(), HasSubstr(reason));
  }
}

TEST(Evaluate, RefusesWhatHasNoTruth) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  EvaluateRequest request = RequestFor(made);
  request.scene = made.scene / "scene.glb";
  ExpectRefused(request, ErrorKind::kBadInput, "no truth");
  request = RequestFor(made);
  request.scene = Root() / "nowhere";
  ExpectRefused(request, ErrorKind::kBadInput, "nowhere");
  request = RequestFor(made);
  request.survey = Root() / "nowhere";
  ExpectRefused(request, ErrorKind::kBadInput, "no such survey");
  request = RequestFor(made);
  request.tolerance_m = std::nan("");
  ExpectRefused(request, ErrorKind::kUsage, "tolerance");
  fs::remove(made.survey / simulate::kFlightFile);
  ExpectRefused(RequestFor(made), ErrorKind::kBadInput, "flight.json");
}

TEST(Evaluate, RefusesAFlightInAnotherScene) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  simulate::Flight flight = simulate::ReadFlight(made.survey);
  flight.photos[3].cam_from_world.translation.x() += 1e5;
  simulate::WriteFlight(flight, made.survey);
  ExpectRefused(RequestFor(made), ErrorKind::kBadInput, "was flown in");
  const MadeSurvey again = WriteMadeSurvey(Root(), {});
  const fs::path other = Root() / "other";
  fs::copy(again.scene, other, fs::copy_options::recursive);
  simulate::SceneInfo info = simulate::ReadSceneInfo(other);
  info.seed = 8;
  simulate::WriteSceneInfo(info, other);
  EvaluateRequest request = RequestFor(again);
  request.scene = other;
  ExpectRefused(request, ErrorKind::kBadInput, "was flown in");
}

TEST(Evaluate, RefusesASceneWithoutItsTruth) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  fs::remove(made.scene / simulate::kTruthFacets);
  ExpectRefused(RequestFor(made), ErrorKind::kBadInput, "there is no truth/facets.json in it");
}

TEST(Evaluate, RefusesASceneThatWasMadeAnewSince) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  simulate::Flight flight = simulate::ReadFlight(made.survey);
  flight.scene = "elsewhere";
  flight.scene_hash = HashFile(made.scene / simulate::kSceneModel);
  simulate::WriteFlight(flight, made.survey);
  EXPECT_EQ(Evaluate(RequestFor(made)).poses.posed, 13);
  WriteFile(made.scene / simulate::kSceneModel, "another model");
  ExpectRefused(RequestFor(made), ErrorKind::kBadInput, "was flown in elsewhere");
}

TEST(Evaluate, FindsOutAboutOptionsThatAreOfNoUseBeforeItMeasures) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  fs::remove(made.survey / simulate::kFlightFile);  // would be found out next
  EvaluateRequest request = RequestFor(made);
  request.lpips_model = Root() / "no.onnx";
  ExpectRefused(request, ErrorKind::kBadInput, "no.onnx");
  request = RequestFor(made);
  request.output = Root() / "out";
  ExpectRefused(request, ErrorKind::kBadInput, "flight.json");
  EXPECT_FALSE(fs::exists(request.output)) << "for nothing";
  request = RequestFor(WriteMadeSurvey(Root(), {}));
  request.output = made.scene / simulate::kSceneModel / "in a file";
  ExpectRefused(request, ErrorKind::kBadInput, "cannot be created");
}

TEST(Evaluate, RefusesTruthOfAnotherVersion) {
  const MadeSurvey made = WriteMadeSurvey(Root(), {});
  const fs::path facets = made.scene / simulate::kTruthFacets;
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(ReadFile(facets));
  json["version"] = 2;
  WriteFile(facets, json.dump());
  ExpectRefused(RequestFor(made), ErrorKind::kBadInput, "\"version\" is 2");
}

}  // namespace
}  // namespace stucco::evaluate
