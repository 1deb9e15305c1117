// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/compare_proxy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "evaluate/geometry/moved.h"
#include "evaluate/geometry/seen.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

ProxyFigures Compare(const Proxy& result, const Proxy& truth, double tolerance_m, int threads = 2,
                     std::span<const std::string> planned = {}) {
  const simulate::Scene scene = MadeScene(truth);
  const simulate::Flight flight = MadeFlight();
  const Surface relief = ReliefOf(scene);
  const SceneIndex index{SurfaceIndex(SurfaceOf(scene)), SurfaceIndex(BuildingSurface(truth))};
  const auto photos = DeliveredPhotos(flight);
  return CompareProxy(result, {}, {truth, relief, index, photos, planned}, tolerance_m, threads);
}

Similarity Shift(const Vector3d& by) {
  return {.scale = 1, .rotation = Eigen::Quaterniond::Identity(), .translation = by};
}

TEST(CompareProxy, TruthHasNoError) {
  const ProxyFigures figures = Compare(MadeTruth(), MadeTruth(), 0.05);
  EXPECT_EQ(figures.buildings, 2);
  EXPECT_EQ(figures.truth_buildings, 2);
  EXPECT_EQ(figures.watertight, 2);
  EXPECT_EQ(figures.manifold, 2);
  EXPECT_EQ(figures.self_intersecting, 0);
  EXPECT_EQ(figures.facets, 12);
  EXPECT_EQ(figures.truth_facets, 12);
  for (const SurfaceFigures& part :
       {figures.surface.all, figures.surface.wall, figures.surface.roof, figures.surface.ground}) {
    EXPECT_NEAR(part.error95_m, 0, 1e-9);
    EXPECT_EQ(part.completeness, 1);
  }
  EXPECT_EQ(figures.surface.wall.completeness_all, 1);
  EXPECT_EQ(figures.facade_id_rate, 1);
}

TEST(CompareProxy, AShiftIsFoundInTheClassThatItMoves) {
  ProxyFigures figures = Compare(Moved(MadeTruth(), Shift({0, 0, 0.2})), MadeTruth(), 0.05);
  EXPECT_NEAR(figures.surface.roof.error95_m, 0.2, 1e-9);
  EXPECT_NEAR(figures.surface.ground.error95_m, 0.2, 1e-9);
  EXPECT_NEAR(figures.surface.wall.error95_m, 0, 1e-9);  // but for their upper 0.2 m, under 5 %
  EXPECT_LT(figures.surface.roof.completeness, 0.03);    // a rim of 5 cm where the walls end
  // A shift along x moves the eastern and western walls: 48 of 108 and 72 of 144 m2.
  figures = Compare(Moved(MadeTruth(), Shift({0.3, 0, 0})), MadeTruth(), 0.05);
  EXPECT_NEAR(figures.surface.wall.error95_m, 0.3, 1e-9);
  EXPECT_NEAR(figures.surface.roof.error95_m, 0, 1e-9);
  EXPECT_GT(figures.surface.wall.completeness, 0.45);
  EXPECT_LT(figures.surface.wall.completeness, 0.55);
}

TEST(CompareProxy, AScaleAndATurnGrowWithTheDistance) {
  const Proxy truth = MadeTruth();
  Similarity grow;
  grow.scale = 1.01;  // about the origin: B0002's eastern wall goes 0.3 m out, its roof 0.09 m up
  ProxyFigures figures = Compare(Moved(truth, grow), truth, 0.05);
  EXPECT_GT(figures.surface.wall.error95_m, 0.22);
  EXPECT_LE(figures.surface.wall.error95_m, 0.3 + 1e-9);
  EXPECT_NEAR(figures.surface.roof.error95_m, 0.09, 1e-9);
  Similarity turn;
  turn.rotation = Eigen::AngleAxisd(0.01, Vector3d::UnitZ());  // 0.3 m at B0002's corners
  figures = Compare(Moved(truth, turn), truth, 0.05);
  EXPECT_GT(figures.surface.wall.error95_m, 0.2);
  EXPECT_LE(figures.surface.wall.error95_m, 0.3);
  EXPECT_NEAR(figures.surface.ground.error95_m, 0, 1e-9);
}

TEST(CompareProxy, AMissingHouseIsMissing) {
  Proxy result = MadeTruth();
  result.buildings.erase(result.buildings.begin() + 1);
  const ProxyFigures figures = Compare(result, MadeTruth(), 0.05);
  EXPECT_EQ(figures.buildings, 1);
  EXPECT_EQ(figures.truth_buildings, 2);
  EXPECT_NEAR(figures.surface.all.error95_m, 0, 1e-9);
  EXPECT_NEAR(figures.surface.wall.completeness_all, 216.0 / (216 + 288),
              0.01);  // 5 cm at the foot
  EXPECT_NEAR(figures.facade_id_rate, 216.0 / (216 + 288), 1e-9);
}

TEST(CompareProxy, OpenAndCrossingBuildingsAreCounted) {
  Proxy result = MadeTruth();
  result.buildings[0].facets.pop_back();
  for (const Facet& facet : MadeBox("B0002b", {28, 3, 1}, {33, 5, 4}).facets) {
    result.buildings[1].facets.push_back(facet);
  }
  const ProxyFigures figures = Compare(result, MadeTruth(), 0.05);
  EXPECT_EQ(figures.watertight, 1);
  EXPECT_EQ(figures.manifold, 2);
  EXPECT_EQ(figures.self_intersecting, 1);
  EXPECT_EQ(figures.facets, 17);
}

TEST(CompareProxy, WrongIdsAreWrong) {
  Proxy result = MadeTruth();
  result.buildings[0].facets[0].planned_facades = {"B0007/F00"};  // 60 of 504 m2
  EXPECT_NEAR(Compare(result, MadeTruth(), 0.05).facade_id_rate, 444.0 / 504, 1e-9);
  for (Building& building : result.buildings) {
    for (Facet& facet : building.facets) {
      facet.id = "own/" + facet.id;
      facet.planned_facades.clear();
    }
  }
  EXPECT_EQ(Compare(result, MadeTruth(), 0.05).facade_id_rate, 0);
}

// The map of the plan lacks the second house: of 216 and 288 m2 of walls.
TEST(CompareProxy, WhatThePlanLacksHasNoId) {
  const auto name_walls = [](Building& building) {
    for (Facet& facet : building.facets) {
      if (facet.facet_class == FacetClass::kWall) facet.planned_facades = {facet.id};
    }
  };
  const auto rate = [&](const Proxy& result, std::span<const std::string> planned) {
    return Compare(result, MadeTruth(), 0.05, 2, planned).facade_id_rate;
  };
  Proxy result = MadeTruth();
  std::vector<std::string> planned;
  for (const Facet& facet : result.buildings[0].facets) planned.push_back(facet.id);
  name_walls(result.buildings[0]);
  for (Facet& facet : result.buildings[1].facets) {
    facet.id = "C0001/" + facet.id;
    facet.planned_facades.clear();
  }
  EXPECT_NEAR(rate(result, {}), 216.0 / 504, 1e-9);
  EXPECT_NEAR(rate(result, planned), 1, 1e-9);
  for (Facet& facet : result.buildings[1].facets) facet.planned_facades = {planned.front()};
  EXPECT_NEAR(rate(result, planned), 216.0 / 504, 1e-9);
}

TEST(CompareProxy, WallsToANeighbourNeedNoId) {
  Proxy result = MadeTruth();
  Proxy truth = MadeTruth();
  result.buildings[0].facets[0].id = "own/W00";
  truth.buildings[0].facets[0].seen = 0;
  EXPECT_NEAR(Compare(result, truth, 0.05).facade_id_rate, 1, 1e-9);
}

TEST(CompareProxy, WhatIsBelowTheGroundNeedsNoId) {
  Proxy result = MadeTruth();
  Proxy truth = MadeTruth();
  Facet& buried = truth.buildings[0].facets[0];  // 10 x 6 m
  buried.seen = 0.5;
  EXPECT_NEAR(Compare(result, truth, 0.05).facade_id_rate, 1, 1e-9);
  result.buildings[0].facets[0].planned_facades = {"B0007/F00"};
  EXPECT_NEAR(Compare(result, truth, 0.05).facade_id_rate, 444.0 / 474, 1e-9);
}

// Every rectangle as strips along its first side.
Proxy Cut(const Proxy& proxy, int strips) {
  Proxy cut = proxy;
  for (Building& building : cut.buildings) {
    std::vector<Facet> facets;
    for (const Facet& facet : building.facets) {
      if (!facet.holes.empty()) {
        facets.push_back(facet);
        continue;
      }
      const auto& o = facet.outer;
      const auto between = [&](int side, int i) -> Vector3d {
        const Vector3d &from = side == 0 ? o[0] : o[3], &to = side == 0 ? o[1] : o[2];
        return from + (to - from) * (static_cast<double>(i) / strips);
      };
      for (int i = 0; i < strips; ++i) {
        Facet strip =
            MadeFacet(facet.id + "-" + std::to_string(i), facet.facet_class,
                      {between(0, i), between(0, i + 1), between(1, i + 1), between(1, i)});
        strip.planned_facades = {FacadeName(facet)};
        facets.push_back(strip);
      }
    }
    building.facets = facets;
  }
  return cut;
}

TEST(CompareProxy, HowFacetsAreCutDoesNotMatter) {
  // The points are others then: shares may differ by their chance.
  const Proxy moved = Moved(MadeTruth(), Shift({0.1, 0, 0.2}));
  const ProxyFigures whole = Compare(moved, MadeTruth(), 0.05);
  const ProxyFigures cut = Compare(Cut(moved, 23), MadeTruth(), 0.05);
  const auto expect_same = [](const SurfaceFigures& a, const SurfaceFigures& b) {
    EXPECT_NEAR(a.error95_m, b.error95_m, 1e-9);
    EXPECT_NEAR(a.completeness, b.completeness, 1e-9);
  };
  expect_same(whole.surface.all, cut.surface.all);
  expect_same(whole.surface.wall, cut.surface.wall);
  expect_same(whole.surface.roof, cut.surface.roof);
  expect_same(whole.surface.ground, cut.surface.ground);
  EXPECT_NEAR(whole.facade_id_rate, cut.facade_id_rate, 1e-9);
  EXPECT_EQ(cut.facets, 12 * 23);
}

TEST(CompareProxy, AFacetThatSpansTwoFacadesNamesBoth) {
  Proxy truth = MadeTruth();  // of B0001's south wall two facades of 4 and 6 m
  Facet& west = truth.buildings[0].facets[0];
  const Proxy result = truth;
  Facet east = west;
  west.outer[1].x() = west.outer[2].x() = east.outer[0].x() = east.outer[3].x() = 4;
  east.id = "B0001/F09";
  truth.buildings[0].facets.push_back(east);
  EXPECT_NEAR(Compare(result, truth, 0.05).facade_id_rate, (504 - 36) / 504.0, 1e-9);
  Proxy named = result;
  named.buildings[0].facets[0].planned_facades = {result.buildings[0].facets[0].id, "B0009/F00",
                                                  "B0001/F09"};
  EXPECT_NEAR(Compare(named, truth, 0.05).facade_id_rate, 1, 1e-9);
}

TEST(CompareProxy, WhatNoPhotoShowsIsNotAskedFor) {
  const Proxy truth = MadeTruth();
  Proxy all = truth;  // a roof over the alley: below it nothing is seen from above
  all.buildings.push_back(MadeBox("B0003", {10.01, -15, 8}, {21.99, 23, 9}));
  const ProxyFigures figures = Compare(truth, all, 0.05);
  EXPECT_LT(figures.surface.roof.completeness, 0.5);
  EXPECT_EQ(figures.surface.ground.completeness, 1);
}

TEST(CompareProxy, HowFarOffIsWhatPhotosShow) {
  Proxy moved = MadeTruth();  // 120 of 504 m2 of walls 0.3 m out, which is more than 5 %
  moved = Moved(moved, Shift({0.3, 0, 0}));
  EXPECT_NEAR(Compare(moved, MadeTruth(), 0.05).surface.wall.seen95_m, 0.3, 1e-9);
  // What is too much is the error's business: a wall more between the houses.
  Proxy more = MadeTruth();
  more.buildings.push_back(MadeBox("B0003", {15, 0, 0}, {17, 8, 6}));
  const SurfaceFigures& walls = Compare(more, MadeTruth(), 0.05).surface.wall;
  EXPECT_NEAR(walls.seen95_m, 0, 1e-9);
  EXPECT_GT(walls.error95_m, 2);
}

TEST(CompareProxy, NothingHasNoErrorAndIsNotComplete) {
  const ProxyFigures figures = Compare({}, MadeTruth(), 0.05);
  EXPECT_EQ(figures.buildings, 0);
  EXPECT_TRUE(std::isnan(figures.surface.all.error95_m));
  EXPECT_EQ(figures.surface.all.completeness, 0);
  EXPECT_EQ(figures.facade_id_rate, 0);
}

TEST(CompareProxy, ThreadsChangeNothing) {
  const Proxy result = Moved(MadeTruth(), Shift({0.01, 0.02, 0.03}));
  const ProxyFigures one = Compare(result, MadeTruth(), 0.05, 1);
  const ProxyFigures four = Compare(result, MadeTruth(), 0.05, 4);
  EXPECT_EQ(one.surface.all.error95_m, four.surface.all.error95_m);
  EXPECT_EQ(one.surface.all.completeness, four.surface.all.completeness);
}

}  // namespace
}  // namespace stucco::evaluate
