// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>

#include "plan/output/coverage_map.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

constexpr char kUnseen[] = "#d7191c";

// A plan whose asked pixel is 20 mm.
Plan Asked20mm() {
  Plan plan = test::MakePlan();
  plan.camera.focal_m = 0.01;
  plan.camera.sensor_width_m = 0.02;
  plan.camera.width_px = 4000;
  plan.d_max_m = 40;
  return plan;
}

CoveredPlace Wall(double x, double z, int photos, double gsd_m) {
  return {{x, 0, z}, -Eigen::Vector3d::UnitY(), SurfaceKind::kWall, photos, gsd_m};
}

// Dots, or strokes, of one colour in both maps.
size_t Dots(const std::string& svg, const std::string& color, const char* cap) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  size_t dots = 0;
  for (const auto& found : xml.select_nodes("//path")) {
    if (found.node().attribute("stroke").value() != color) continue;
    if (found.node().attribute("stroke-linecap").value() != std::string(cap)) continue;
    const std::string data = found.node().attribute("d").value();
    dots += static_cast<size_t>(std::ranges::count(data, 'm'));
  }
  return dots;
}

std::string ColorOfKey(const std::string& svg, const std::string& label) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  const auto text = xml.select_node(("//text[.='" + label + "']").c_str()).node();
  return text.previous_sibling().attribute("fill").value();
}

TEST(CoverageSvg, AWallIsAsGoodAsItsWorstHeight) {
  const PhotoCoverage coverage{2.5, {Wall(5, 3, 6, 0.012), Wall(5, 6, 1, 0.03), Wall(20, 3, 0, 0)}};
  const std::string svg = CoverageSvg(Asked20mm(), coverage);
  EXPECT_EQ(Dots(svg, kUnseen, "round"), 2u);  // in both maps
  EXPECT_EQ(
      Dots(svg, ColorOfKey(svg, "1"), "round") + Dots(svg, ColorOfKey(svg, "to 40 mm"), "round"),
      2u);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "5 to 8"), "round"), 0u);
}

TEST(CoverageSvg, ClassesEndWhereTheKeySays) {
  const auto ground = [](double x, double gsd_m) {
    return CoveredPlace{{x, -20, 0}, Eigen::Vector3d::UnitZ(), SurfaceKind::kGround, 3, gsd_m};
  };
  const std::string svg =
      CoverageSvg(Asked20mm(), {2.5, {ground(0, 0.0199), ground(5, 0.0201), ground(10, 0.5)}});
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "to 20 mm"), "butt"), 1u);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "to 28 mm"), "butt"), 1u);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "over 80 mm"), "butt"), 1u);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "3, 4"), "butt"), 3u);
}

TEST(CoverageSvg, NeighboursOfOneClassAreOneStroke) {
  PhotoCoverage coverage{2.5, {}};
  for (const double x : {0.0, 2.5, 5.0, 7.5}) {
    coverage.places.push_back(
        {{x, -20, 0}, Eigen::Vector3d::UnitZ(), SurfaceKind::kGround, x == 5 ? 1 : 3, 0.015});
  }
  const std::string svg = CoverageSvg(Asked20mm(), coverage);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "to 20 mm"), "butt"), 1u);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "3, 4"), "butt"), 2u);
  EXPECT_EQ(Dots(svg, ColorOfKey(svg, "1"), "butt"), 1u);
}

TEST(CoverageSvg, OfNothingIsAPage) {
  const std::string svg = CoverageSvg({}, {});
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace stucco::plan
