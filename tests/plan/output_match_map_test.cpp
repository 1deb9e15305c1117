// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>

#include "plan/output/match_map.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

// Four stops with a photo each, in a row.
Plan FourStops() {
  Plan plan = test::MakePlan();
  plan.views.clear();
  for (int i = 0; i < 4; ++i) {
    PlannedView view;
    view.id = "v" + std::to_string(i);
    view.position_m = {10. * i, -20, 30};
    view.hover = i;
    plan.views.push_back(view);
  }
  return plan;
}

std::string ColorOfKey(const pugi::xml_document& xml, const std::string& label) {
  const auto text = xml.select_node(("//text[.='" + label + "']").c_str()).node();
  return text.previous_sibling().attribute("fill").value();
}

struct Drawn {
  long lines = 0;
  long dots = 0;
};

// Of one class.
Drawn DrawnOf(const std::string& svg, const std::string& label) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  Drawn drawn;
  for (const auto& found : xml.select_nodes("//path")) {
    if (found.node().attribute("stroke").value() != ColorOfKey(xml, label)) continue;
    const std::string data = found.node().attribute("d").value();
    const bool is_dots = found.node().attribute("stroke-linecap").value() == std::string("round");
    (is_dots ? drawn.dots : drawn.lines) += std::ranges::count(data, 'm');
  }
  return drawn;
}

constexpr char kLoose[] = "too few partners";
constexpr char kWeak[] = "nine in ten such pairs match";
constexpr char kSure[] = "nearly all do";
constexpr char kSurest[] = "all do";

TEST(MatchSvg, AStopIsAsSureAsTheThirdPartnerOfItsWorstPhoto) {
  Plan plan = FourStops();
  plan.views[0].partners = {{"v1", 0.5}, {"v2", 0.3}, {"v3", 0.08}};
  plan.views[1].partners = {{"v0", 0.5}, {"v2", 0.2}, {"v3", 0.15}};
  plan.views[2].partners = {{"v0", 0.3}, {"v1", 0.2}};
  plan.views[3].partners = {{"v1", 0.4}, {"v0", 0.3}, {"v2", 0.15}};
  PlannedView second = plan.views[3];
  second.id = "v4";
  second.partners[2].strength = 0.13;
  plan.views.push_back(second);
  const std::string svg = MatchSvg(plan);
  EXPECT_EQ(DrawnOf(svg, kLoose).dots, 1);
  EXPECT_EQ(DrawnOf(svg, kWeak).dots, 1);
  EXPECT_EQ(DrawnOf(svg, kSure).dots, 2);
  EXPECT_EQ(DrawnOf(svg, kSurest).dots, 0);
}

TEST(MatchSvg, AStopThatLacksClosePartnersIsRed) {
  Plan plan = FourStops();
  for (PlannedView& view : plan.views) view.partners = {{"v1", 0.5}, {"v2", 0.4}, {"v3", 0.3}};
  EXPECT_EQ(DrawnOf(MatchSvg(plan), kLoose).dots, 0);
  plan.views[2].is_loose = true;
  EXPECT_EQ(DrawnOf(MatchSvg(plan), kLoose).dots, 1);
}

TEST(MatchSvg, ALineHasTheColourOfTheStrongestPair) {
  Plan plan = FourStops();
  plan.views[0].partners = {{"v1", 0.5}, {"v2", 0.08}};
  plan.views[1].partners = {{"v0", 0.07}};
  plan.views[2].partners = {{"v3", 0.15}, {"v0", 0.08}};
  const std::string svg = MatchSvg(plan);
  EXPECT_EQ(DrawnOf(svg, kSurest).lines, 1);
  EXPECT_EQ(DrawnOf(svg, kSure).lines, 1);
  EXPECT_EQ(DrawnOf(svg, kWeak).lines, 1);
}

TEST(MatchSvg, PartnersOfAnotherPlanAreLeftOut) {
  Plan plan = FourStops();
  plan.views[0].partners = {{"elsewhere", 0.5}};
  const std::string svg = MatchSvg(plan);
  EXPECT_EQ(DrawnOf(svg, kSurest).lines, 0);
  EXPECT_EQ(DrawnOf(svg, kLoose).dots, 4);
}

TEST(MatchSvg, OfNothingIsAPage) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(MatchSvg({}).c_str()));
}

}  // namespace
}  // namespace stucco::plan
