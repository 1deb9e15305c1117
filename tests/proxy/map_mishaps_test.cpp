// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings of which the cloud or the map has less than the whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::Captured;
using test::ClosedIn;
using test::MadeModel;
using test::MakeModel;
using test::OfClass;
using test::Rectangle;
using test::VolumeOf;

constexpr double kVolume_m3 = 12 * 9 * 6;

const Ring& HouseOutline() {
  static const Ring ring = Rectangle(-6, -4.5, 6, 4.5);
  return ring;
}

Captured CaptureBox(std::vector<std::string> hide, bool front_only = false) {
  test::CaptureOptions options{.spacing = 0.2, .noise = 0.02};
  options.hide = std::move(hide);
  options.front_only = front_only;
  return test::Capture({test::BoxHouse(12, 9, 6)}, {test::GroundSquare(25)}, options);
}

TEST(MapMishaps, TheHalfThatTheMapLacksIsBuiltAndNamed) {
  const MadeModel made = MakeModel(CaptureBox({}), {{"B0001", {Rectangle(-6, -4.5, 0, 4.5)}, 6}});
  const Building* rest = test::Find(made.proxy, "C0001");
  ASSERT_TRUE(rest != nullptr && rest->watertight);
  EXPECT_NEAR(VolumeOf(ClosedIn(made, "B0001")) + VolumeOf(*rest), kVolume_m3, 10);
  EXPECT_TRUE(std::ranges::any_of(made.findings.of_map, [](const ProxyFindings::OfMap& finding) {
    return finding.text.starts_with("C0001: stands on no footprint of the map");
  }));
}

TEST(MapMishaps, CrownsOverAHouseAreNotItsRoof) {
  Captured captured = CaptureBox({"roof"});  // nobody sees it
  for (const double x : {-5.0, -2.0, 1.0, 4.0}) {
    for (const double y : {-3.0, 0.0, 3.0}) test::AddTree({x, y, 8.5}, 2.4, 2500, 3, captured);
  }
  const MadeModel made = MakeModel(captured, {{"B0001", {HouseOutline()}, 9}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_NEAR(VolumeOf(house), kVolume_m3, 30);
  ASSERT_EQ(OfClass(house, FacetClass::kRoof).size(), 1u);
  EXPECT_EQ(OfClass(house, FacetClass::kRoof)[0]->seen, 0);
}

// Of a house of which photos show nothing but the crowns above it nobody knows more than the map.
TEST(MapMishaps, AHouseBelowCrownsIsAsThePlanHasIt) {
  const Ring other = Rectangle(18, -5, 30, 5);
  Captured captured = test::Capture({test::FlatHouse(other, 6)}, {test::GroundSquare(40)},
                                    {.spacing = 0.2, .noise = 0.02});
  const auto below = [](const Eigen::Vector3d& p) {
    return std::abs(p.x()) < 6.5 && std::abs(p.y()) < 5;
  };
  test::EraseIf(below, captured);
  for (const double x : {-4.0, 0.0, 4.0}) {
    for (const double y : {-2.5, 2.5}) test::AddTree({x, y, 12}, 2.4, 2500, 3, captured);
  }
  const MadeModel made =
      MakeModel(captured, {{"B0001", {HouseOutline()}, 7}, {"B0002", {other}, 6}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_NEAR(VolumeOf(house), 12 * 9 * 7, 12 * 9 * 0.3);
  EXPECT_EQ(house.facets.size(), 6u);
  EXPECT_TRUE(std::ranges::any_of(made.findings.of_map, [](const ProxyFindings::OfMap& finding) {
    return finding.text.starts_with("B0001: the cloud shows too little of it");
  }));
}

TEST(MapMishaps, AHouseSeenFromOneSideIsClosed) {
  const MadeModel made = MakeModel(CaptureBox({}, true), {{"B0001", {HouseOutline()}, 9}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(house.facets.size(), 6u);
  EXPECT_NEAR(VolumeOf(house), kVolume_m3, 50);
  EXPECT_TRUE(std::ranges::any_of(OfClass(house, FacetClass::kWall),
                                  [](const Facet* wall) { return wall->seen == 0; }));
}

TEST(MapMishaps, AHouseWhoseGroundNobodySawEndsAtItsFoot) {
  const MadeModel made = MakeModel(CaptureBox({"ground"}), {{"B0001", {HouseOutline()}, 6}});
  EXPECT_NEAR(VolumeOf(ClosedIn(made, "B0001")), kVolume_m3, 30);
}

// Of nine houses wall to wall nobody sees the ground beside the one in the middle, whose roof may
// be as high as theirs.
TEST(MapMishaps, AHouseThatOthersEncloseStandsOnTheirGround) {
  for (const double top : {6.0, 9.0}) {
    std::vector<test::House> houses;
    std::vector<test::MapEntry> map;
    for (int i = 0; i < 9; ++i) {
      const double x = 9.0 * (i % 3) - 13.5, y = 9.0 * (i / 3) - 13.5;
      const Ring ring = Rectangle(x, y, x + 9, y + 9);
      const double height = i == 4 ? top : 6;
      houses.push_back(test::FlatHouse(ring, height));
      // The map has its heights above another zero than the survey.
      map.push_back({"B000" + std::to_string(i + 1), {ring}, 100 + height, 100});
    }
    const auto captured = test::Capture(houses, {test::GroundSquare(30)}, test::kDenseCapture);
    const MadeModel made = MakeModel(captured, map);
    const Building& middle = ClosedIn(made, "B0005");
    EXPECT_NEAR(VolumeOf(middle), 81 * top, 12);
  }
}

}  // namespace
}  // namespace stucco
