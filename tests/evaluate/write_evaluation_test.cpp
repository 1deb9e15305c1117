// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "evaluate/evaluate.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco::evaluate {
namespace {

using Json = nlohmann::json;

TEST(EvaluationJson, KeepsTheNamesThatOthersRelyOn) {
  const Json json = Json::parse(EvaluationJson({}));
  EXPECT_EQ(json["version"], 1);
  for (const char* name : {"/poses/posed",
                           "/poses/total",
                           "/poses/position_mean_m",
                           "/poses/position_max_m",
                           "/poses/rotation_mean_deg",
                           "/dense/error95_m",
                           "/dense/completeness",
                           "/proxy/buildings",
                           "/proxy/watertight",
                           "/proxy/error95_m",
                           "/proxy/wall_error95_m",
                           "/proxy/completeness",
                           "/proxy/facets",
                           "/proxy/truth_facets",
                           "/proxy/superstructure_facets",
                           "/proxy/facade_id_rate",
                           "/dense/wall_completeness",
                           "/proxy/building_error95_m",
                           "/poses/georeferenced_rotation_mean_deg",
                           "/texture/painted",
                           "/texture/misregistration_m",
                           "/views/compared",
                           "/texture/ssim_mean",
                           "/texture/psnr_mean",
                           "/texture/flip_mean",
                           "/texture/misregistration_px",
                           "/texture/facades",
                           "/texture/ceiling/ssim",
                           "/texture/plane/share",
                           "/texture/plane/shift_m",
                           "/texture/plane/ceiling/ssim",
                           "/texture/relief/ceiling/psnr",
                           "/views/ssim_mean",
                           "/views/psnr_mean",
                           "/plan",
                           "/notes"}) {
    EXPECT_TRUE(json.contains(Json::json_pointer(name))) << name;
  }
}

TEST(EvaluationJson, WhatWasNotMeasuredIsNull) {
  Evaluation evaluation;
  evaluation.proxy.surface.wall.error95_m = 0.125;
  const Json json = Json::parse(EvaluationJson(evaluation));
  EXPECT_EQ(json["proxy"]["wall_error95_m"], 0.125);
  EXPECT_TRUE(json["proxy"]["error95_m"].is_null());
  EXPECT_TRUE(json["plan"].is_null());
}

TEST(WriteEvaluation, LeavesTheFilesOfOthersAlone) {
  const auto output = std::filesystem::path(::testing::TempDir()) / "stucco_report_folder";
  std::filesystem::remove_all(output);
  std::filesystem::create_directories(output);
  WriteFile(output / "facades.csv", "the report's");
  EXPECT_THROW(WriteEvaluation({}, output), Error);
  EXPECT_EQ(ReadFile(output / "facades.csv"), "the report's");
}

TEST(WriteEvaluation, WritesAFacadePerLine) {
  Evaluation evaluation;
  evaluation.facades.resize(2);
  evaluation.facades[0].id = "B0001/F00";
  evaluation.facades[0].area_m2 = 60;
  evaluation.facades[0].picture.ssim = 0.75;
  evaluation.facades[0].ceiling.ssim = 0.875;
  evaluation.facades[0].plane.share = 0.5;
  evaluation.facades[0].plane.result.shift_m = 0.125;
  evaluation.facades[0].relief.ceiling.ssim = 0.25;
  evaluation.facades[0].occluded = {40, 5};
  evaluation.facades[1].id = "a \"b\", c";
  const auto output = std::filesystem::path(::testing::TempDir()) / "stucco_write_evaluation";
  std::filesystem::remove_all(output);
  WriteEvaluation(evaluation, output);
  EXPECT_EQ(ReadFile(output / "facades.csv"),
            "id,facet,area_m2,painted,ssim,ms_ssim,psnr,gmsd,flip,lpips,texel_m,misregistration_px,"
            "ceiling_ssim,plane_share,plane_ssim,plane_ceiling_ssim,plane_shift_m,relief_ssim,"
            "relief_ceiling_ssim,occluded\r\n"
            "B0001/F00,,60,0,0.75,,,,,,,,0.875,0.5,,,0.125,,0.25,0.125\r\n"
            "\"a \"\"b\"\", c\",,0,0,,,,,,,,,,,,,,,,\r\n");
  EXPECT_EQ(Json::parse(ReadFile(output / "evaluation.json"))["texture"]["facades"][0]["id"],
            "B0001/F00");
}

}  // namespace
}  // namespace stucco::evaluate
