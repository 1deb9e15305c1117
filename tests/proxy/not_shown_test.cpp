// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/not_shown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "proxy/abstract.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

class NotShownOfAHouse : public testing::Test {
 protected:
  NotShownOfAHouse() {
    const test::Captured captured =
        test::Capture({test::GableHouse()}, {test::GroundSquare(20)}, {.noise = 0.02});
    ProxyFindings findings;
    const ProxyInput input = test::InputOf(captured, test::MapGeoref());
    scene_ = UnderstandCloud(input, {}, 2, findings);
    for (const auto& cluster : scene_.buildings) {
      std::ranges::copy(cluster, std::back_inserter(planes_));
    }
    proxy_ = AbstractCloud(input, {}, 2, findings);
    EXPECT_TRUE(findings.of_model.empty());
  }

  std::vector<NotShown> Find() const { return FindNotShown(scene_, planes_, proxy_.buildings, 2); }
  Facet& South() {
    return *std::ranges::find_if(proxy_.buildings[0].facets, [](const Facet& facet) {
      return facet.normal.dot(-Eigen::Vector3d::UnitY()) > 0.99;
    });
  }

  PlanarScene scene_;
  std::vector<Plane> planes_;
  Proxy proxy_;
};

TEST_F(NotShownOfAHouse, AllOfAHouseIsShown) {
  EXPECT_TRUE(Find().empty());
}

TEST_F(NotShownOfAHouse, AWallThatTheModelLacksIsNamed) {
  const Facet south = South();
  std::erase_if(proxy_.buildings[0].facets, [&](const Facet& f) { return f.id == south.id; });
  const auto found = Find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].building, "C0001");
  EXPECT_EQ(found[0].role, PlaneRole::kWall);
  EXPECT_NEAR(found[0].area, south.area, 0.15 * south.area);
  EXPECT_LT(std::abs(south.normal.dot(found[0].middle) - south.offset), 0.05);
  EXPECT_NEAR(found[0].middle.z(), 3, 0.5);
}

TEST_F(NotShownOfAHouse, APartOfAWallIsNamedWhereItIsLarge) {
  Facet& south = South();
  for (Eigen::Vector3d& p : south.outer) p.x() = std::min(p.x(), 4.6);  // a strip of 1.4 m
  EXPECT_TRUE(Find().empty());
  for (Eigen::Vector3d& p : south.outer) p.x() = std::min(p.x(), 1.0);
  const auto found = Find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].area, (5 - 0.6) * 6, 5);  // what lies beside the rest counts as shown
  EXPECT_NEAR(found[0].middle.x(), 3.8, 0.4);
}

TEST_F(NotShownOfAHouse, TheGroundBesideItIsNone) {
  Plane level;
  level.normal = Eigen::Vector3d::UnitZ();
  level.role = PlaneRole::kSlope;
  level.area = 1500;
  for (size_t i = 0; i < scene_.samples.size(); ++i) {
    if (scene_.samples.positions[i].z() < 0.1) level.points.push_back(static_cast<int>(i));
  }
  ASSERT_GT(level.points.size(), 1000u);
  planes_ = {level};
  EXPECT_TRUE(Find().empty());
  for (Facet& facet : proxy_.buildings[0].facets) {  // a house on posts, far above it
    for (Eigen::Vector3d& p : facet.outer) p.z() += 2.5;
    facet.offset += 2.5 * facet.normal.z();
  }
  EXPECT_TRUE(Find().empty());
  for (Facet& facet : proxy_.buildings[0].facets) {  // a house whose flat wing lacks
    for (Eigen::Vector3d& p : facet.outer) p.z() -= 7.5;
    facet.offset -= 7.5 * facet.normal.z();
  }
  EXPECT_EQ(Find().size(), 1u);
}

TEST_F(NotShownOfAHouse, WhatIsFarFromAllBuildingsIsNone) {
  for (Facet& facet : proxy_.buildings[0].facets) {
    for (Eigen::Vector3d& p : facet.outer) p.x() += 100;
    facet.offset += 100 * facet.normal.x();
  }
  EXPECT_TRUE(Find().empty());
}

}  // namespace
}  // namespace stucco
