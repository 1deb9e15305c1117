// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/plan_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco::evaluate {
namespace {

std::filesystem::path Written(const std::string& text) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "stucco_plan_figures.json";
  WriteFile(path, text);
  return path;
}

std::string Refusal(const std::string& text) {
  try {
    ReadPlanFigures(Written(text));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return error.what();
  }
  return "";
}

TEST(ReadPlanFigures, TakesWhatTheFileSays) {
  const PlanFigures figures = ReadPlanFigures(Written(
      R"({"version": 1, "method": "oblique", "photos": 13, "hovers": 9, "length_m": 812.5,
          "time_min": 6.25, "battery_percent": 21.5, "flights": 1,
          "mean": {"q_s": 0, "q_d": 0, "q_u": 0, "q_c": 0},
          "mean_by_length": {"q_s": 0.5, "q_d": 0.25, "q_u": 0.75, "q_c": 1}})"));
  EXPECT_EQ(figures.method, "oblique");
  EXPECT_EQ(figures.photos, 13);
  EXPECT_EQ(figures.hovers, 9);
  EXPECT_EQ(figures.length_m, 812.5);
  EXPECT_EQ(figures.time_min, 6.25);
  EXPECT_EQ(figures.battery_percent, 21.5);
  EXPECT_EQ(figures.q_s, 0.5);
  EXPECT_EQ(figures.q_d, 0.25);
  EXPECT_EQ(figures.q_u, 0.75);
  EXPECT_EQ(figures.q_c, 1);
}

TEST(ReadPlanFigures, RefusesWhatIsNoSuchFile) {
  EXPECT_THAT(Refusal("{"), ::testing::HasSubstr("stucco_plan_figures.json"));
  EXPECT_THAT(Refusal(R"({"version": 2})"), ::testing::HasSubstr("version 1"));
  EXPECT_THAT(Refusal(R"({"version": 1})"), ::testing::HasSubstr("mean_by_length"));
  EXPECT_THAT(Refusal("[]"), ::testing::HasSubstr("stucco_plan_figures.json"));
}

}  // namespace
}  // namespace stucco::evaluate
