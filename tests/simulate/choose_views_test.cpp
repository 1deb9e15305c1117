// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/choose_views.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "survey/error.h"

namespace stucco::simulate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Views v0 ... v11: each even one for A, each odd one for B, every third also for C; the order of
// the flight is the opposite one. D is a facade that no view is for.
Plan TwelveViews() {
  Plan plan;
  for (const char* id : {"A", "B", "C", "D"}) plan.facades.emplace_back().id = id;
  for (int i = 0; i < 12; ++i) {
    PlannedView& view = plan.views.emplace_back();
    view.position_m = {1000, 1000, 100};  // too far to look at anything
    view.id = fmt::format("v{}", i);
    view.order = 11 - i;
    view.targets.emplace_back().facade = i % 2 == 0 ? "A" : "B";
    if (i % 3 == 0) view.targets.emplace_back().facade = "C";
  }
  return plan;
}

std::vector<std::string> Chosen(const std::string& facades, int most) {
  FlightOptions options;
  options.facades = facades;
  options.most_photos = most;
  std::vector<std::string> ids;
  for (const PlannedView& view : ChooseViews(TwelveViews(), options).views) ids.push_back(view.id);
  return ids;
}

TEST(ChooseViews, TakesAllUnlessAsked) {
  EXPECT_EQ(Chosen("", 0).size(), 12u);
  EXPECT_EQ(Chosen("", 50).size(), 12u);
}

TEST(ChooseViews, TakesTheViewsOfTheFacades) {
  EXPECT_THAT(Chosen("C", 0), ElementsAre("v0", "v3", "v6", "v9"));
  EXPECT_THAT(Chosen("A,C", 0), ElementsAre("v0", "v2", "v3", "v4", "v6", "v8", "v9", "v10"));
}

TEST(ChooseViews, SpreadsFewPhotosOverFacadesAndTheirViews) {
  EXPECT_THAT(Chosen("A", 2), ElementsAre("v2", "v8"));
  EXPECT_THAT(Chosen("", 3), ElementsAre("v1", "v5", "v9"));
  // Two of C, and two of A that are left.
  EXPECT_THAT(Chosen("A,C", 4), ElementsAre("v0", "v2", "v6", "v8"));
  EXPECT_EQ(Chosen("C", 9).size(), 4u);
  // What one has too few of, another gets.
  EXPECT_EQ(Chosen("A,C", 8).size(), 8u);
  EXPECT_EQ(Chosen("A,C", 7).size(), 7u);
}

// One view is not meant for the wall and looks at it; the others look past it, at its back, from
// aside or from too far away.
TEST(ChooseViews, TakesWhatLooksAtTheFacadeToo) {
  Plan plan;
  plan.camera = {"mavic-3e", "Mavic", 12.29e-3, 17.3e-3, 13e-3, 5280, 3956};
  plan.d_max_m = 40;
  PlannedFacade& wall = plan.facades.emplace_back();
  wall.id = "A";
  wall.b_m = {12, 0};  // seen from the south
  wall.z_m = {0, 6};
  const auto add = [&](const Eigen::Vector3d& position, double yaw_deg, double pitch_deg) {
    PlannedView& view = plan.views.emplace_back();
    view.position_m = position;
    view.yaw_deg = yaw_deg;
    view.pitch_deg = pitch_deg;
    view.order = static_cast<int>(plan.views.size());
  };
  add({6, -15, 18}, 0, -45);
  add({6, -15, 18}, 180, -45);
  add({6, -15, 3}, 0, 60);
  add({6, 15, 3}, 180, 0);
  add({-30, -5, 3}, 80, 0);
  add({6, -60, 3}, 0, 0);
  FlightOptions options;
  options.facades = "A";
  const Plan chosen = ChooseViews(plan, options);
  ASSERT_EQ(chosen.views.size(), 1u);
  EXPECT_EQ(chosen.views[0].order, 1);
}

TEST(ChooseViews, RefusesFacadesThatCannotBePhotographed) {
  const auto why = [](const std::string& facades) -> std::string {
    try {
      Chosen(facades, 0);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(why("A,E"), HasSubstr("no facade E"));
  EXPECT_THAT(why("D"), HasSubstr("no view of D"));
}

}  // namespace
}  // namespace stucco::simulate
