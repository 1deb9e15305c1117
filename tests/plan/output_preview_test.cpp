// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <sstream>

#include "plan/output/internal/svg.h"
#include "plan/output/preview.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

using internal::EscapeXml;
using internal::PathData;

std::string Preview(const Plan& plan) {
  return PreviewSvg(plan, StatsOf(plan, 1, 0.02));
}

TEST(PreviewSvg, ShowsWarningsAboveTheMap) {
  const Plan plan = test::MakePlan();
  PlanStats stats = StatsOf(plan, 1, 0.02);
  const std::string without = PreviewSvg(plan, stats);
  EXPECT_EQ(without.find("Warning: "), std::string::npos);
  stats.warnings = {"mind the <crane>", std::string(150, 'a') + " " + std::string(150, 'b')};
  const std::string with = PreviewSvg(plan, stats);
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(with.c_str()));
  EXPECT_EQ(xml.select_nodes("//text[starts-with(@class,'warning')]").size(), 3u);
  EXPECT_EQ(xml.select_nodes("//path[@fill='#cfe3c4']").size(), 0u);
  EXPECT_NE(with.find("Warning: mind the &lt;crane&gt;"), std::string::npos);
}

TEST(PreviewSvg, ObstaclesAreNoBuildings) {
  Plan plan = test::MakePlan();
  const std::string before = Preview(plan);
  EXPECT_NE(before.find("2 buildings"), std::string::npos);
  EXPECT_EQ(before.find("obstacle"), std::string::npos);
  plan.footprints[1].is_obstacle = true;
  const std::string after = Preview(plan);
  EXPECT_NE(after.find("1 building,"), std::string::npos);
  EXPECT_NE(after.find("obstacle: tree"), std::string::npos);
}

// Paths of one look.
std::vector<std::string> Paths(const std::string& svg, const std::string& attribute,
                               const std::string& value) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  std::vector<std::string> paths;
  for (const auto& found : xml.select_nodes("//path")) {
    if (found.node().attribute(attribute.c_str()).value() == value) {
      paths.emplace_back(found.node().attribute("d").value());
    }
  }
  return paths;
}

// Corners of a path of m and l commands.
std::vector<Eigen::Vector2d> Corners(std::string data) {
  for (char& c : data) c = c == 'm' || c == 'l' || c == 'z' ? ' ' : c;
  std::vector<Eigen::Vector2d> corners;
  Eigen::Vector2d at(0, 0);
  const char* p = data.c_str();
  for (char* end = nullptr;; p = end) {
    const double x = strtod(p, &end);
    if (end == p) return corners;
    p = end;
    const double y = strtod(p, &end);
    at += Eigen::Vector2d(x, y);
    corners.push_back(at);
  }
}

TEST(PathData, RoundingDoesNotAddUp) {
  PathData path;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.003 + i * 0.00377, -5.5 + i * 0.1234567);
  path.Polyline(points);
  const auto corners = Corners(path.text());
  ASSERT_EQ(corners.size(), points.size());
  for (size_t i = 0; i < points.size(); ++i) EXPECT_LT((corners[i] - points[i]).norm(), 0.0072);
}

TEST(PathData, IsShortAndGoesOnFromTheStartOfAClosedRing) {
  PathData path;
  path.Ring({{10, 10}, {10.5, 10}, {10.5, 9.25}});
  path.Dot({11, 10});
  EXPECT_EQ(path.text(), "m10 10l.5 0l0-.75zm1 0h0");
}

TEST(EscapeXml, KeepsTextWhole) {
  EXPECT_EQ(EscapeXml("a<b & \"c\" > 'd'"), "a&lt;b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(EscapeXml("Gebäude №1"), "Gebäude №1");
  EXPECT_EQ(EscapeXml(std::string("a\0b\n\xff", 5)), "a?b??");
  EXPECT_EQ(EscapeXml(""), "");
}

TEST(Colors, RunFromDarkToBright) {
  EXPECT_EQ(Hex(QualityColor(0)), "#440154");
  EXPECT_EQ(Hex(QualityColor(1)), "#fde725");
  EXPECT_EQ(QualityColor(-1), QualityColor(0));
  EXPECT_EQ(QualityColor(std::nan("")), QualityColor(0));
  EXPECT_EQ(QualityColor(7), QualityColor(1));
  double before = -1;
  for (int i = 0; i <= 20; ++i) {
    const Rgb color = QualityColor(i / 20.0);
    const double lightness = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
    EXPECT_GT(lightness, before);
    before = lightness;
  }
  EXPECT_EQ(FlightColor(6), FlightColor(0));
  EXPECT_NE(FlightColor(1), FlightColor(0));
}

TEST(Preview, IsWellFormedAndNamesWhatItShows) {
  const std::string svg = Preview(test::MakePlan());
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(svg.c_str()));
  EXPECT_NE(svg.find("Flight plan: 2 buildings, 8 facades"), std::string::npos);
  EXPECT_NE(svg.find("9 photos at 3 hovers"), std::string::npos);
  EXPECT_NE(svg.find("B&lt;2&gt;&amp;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Preview, SaysWhereEachFlightStarts) {
  Plan plan = test::MakePlan();
  const std::string one = Preview(plan);
  EXPECT_EQ(one.find("H1"), std::string::npos);
  plan.flights[1].home_m = Eigen::Vector3d(100, -40, 0);
  const std::string two = Preview(plan);
  EXPECT_NE(two.find(">H1<"), std::string::npos);
  EXPECT_NE(two.find(">H2<"), std::string::npos);
  EXPECT_NE(two.find("6 % battery, H2"), std::string::npos);
}

// The map in metres again: its scale is that of the dilation, which is 2 d_min wide.
TEST(Preview, DrawsBuildingsWhereTheyStand) {
  const Plan plan = test::MakePlan();
  const std::string svg = Preview(plan);
  const auto zones = Paths(svg, "fill", "#f6ead6");
  const auto buildings = Paths(svg, "fill", "#cfd2d8");
  ASSERT_EQ(zones.size(), 1u);
  ASSERT_EQ(buildings.size(), 1u);
  EXPECT_EQ(zones, buildings);
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(svg.c_str()));
  const double width =
      xml.select_node("//path[@fill='#f6ead6']").node().attribute("stroke-width").as_double();
  const double px_per_m = width / (2 * plan.d_min_m);
  const auto corners = Corners(buildings[0].substr(0, buildings[0].find('z')));
  ASSERT_EQ(corners.size(), 4u);
  EXPECT_NEAR((corners[1] - corners[0]).x(), 40 * px_per_m, 0.05);
  EXPECT_NEAR((corners[2] - corners[1]).y(), -25 * px_per_m, 0.05);  // north is up
}

TEST(Preview, MarksWallsThatNothingSees) {
  Plan plan = test::MakePlan();
  EXPECT_EQ(Corners(Paths(Preview(plan), "stroke", "#fff").at(0)).size(), 4u);  // two parts
  for (PlannedFacade& facade : plan.facades) facade.unobservable_m.clear();
  for (const std::string& path : Paths(Preview(plan), "stroke", "#d7191c")) {
    EXPECT_EQ(path.front(), 'M') << "only the legend has one";
  }
}

TEST(Preview, ShowsViewsAboveEachOtherOnce) {
  Plan plan = test::MakePlan();
  const std::string before = Paths(Preview(plan), "fill", "#1b1b1f").at(0);
  PlannedView view = plan.views[0];
  view.position_m.z() -= 3;
  plan.views.push_back(view);
  EXPECT_EQ(Paths(Preview(plan), "fill", "#1b1b1f").at(0), before);
  plan.views.back().yaw_deg += 40;
  EXPECT_GT(Paths(Preview(plan), "fill", "#1b1b1f").at(0).size(), before.size());
}

TEST(Preview, RingsPhotosThatHangLoose) {
  Plan plan = test::MakePlan();
  const std::string tied = Preview(plan);
  EXPECT_EQ(tied.find("class=\"loose\""), std::string::npos);
  EXPECT_EQ(tied.find("too few"), std::string::npos);
  plan.views[0].is_loose = true;
  const std::string loose = Preview(plan);
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(loose.c_str()));
  EXPECT_EQ(xml.select_nodes("//circle[@class='loose']").size(), 2u);  // on the map, in the legend
  EXPECT_NE(loose.find("1 photo that too few should match"), std::string::npos);
}

TEST(Preview, LinkPhotosHaveALookOfTheirOwn) {
  Plan plan = test::MakePlan();
  EXPECT_TRUE(Paths(Preview(plan), "fill", "#7b3294").empty());
  plan.views[0].kind = ViewKind::kLink;
  const auto paths = Paths(Preview(plan), "fill", "#7b3294");
  EXPECT_EQ(paths.size(), 2u);  // on the map, in the legend
}

TEST(Preview, OfNothingIsAPage) {
  const std::string svg = Preview({});
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

// Large sites stay readable and small enough for a browser.
TEST(Preview, GrowsSlowlyWithTheSite) {
  const Plan one = test::MakePlan();
  Plan plan = one;
  for (int i = 1; i < 600; ++i) {
    const Eigen::Vector2d shift(150 * (i % 25), 90 * (i / 25));
    for (PlannedFootprint footprint : one.footprints) {
      for (auto& ring : footprint.rings_m) {
        for (Eigen::Vector2d& corner : ring) corner += shift;
      }
      plan.footprints.push_back(footprint);
    }
    for (PlannedFacade facade : one.facades) {
      facade.id += fmt::format("x{}", i);
      facade.a_m += shift;
      facade.b_m += shift;
      plan.facades.push_back(facade);
    }
  }
  const std::string svg = Preview(plan);
  EXPECT_LT(svg.size(), 400'000u);
  EXPECT_LT(svg.size(), 600 * Preview(one).size() / 10);
}

}  // namespace
}  // namespace stucco::plan
