// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/facade_ids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "survey/plan_frame.h"

namespace stucco {
namespace {

using Eigen::Vector2d;

// Counter-clockwise corners -> walls with the building on their left.
std::vector<Segment2d> Walls(const std::vector<Vector2d>& ring) {
  std::vector<Segment2d> lines;
  for (size_t i = 0; i < ring.size(); ++i) lines.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return lines;
}

void Append(std::vector<Segment2d> more, std::vector<Segment2d>& lines) {
  lines.insert(lines.end(), more.begin(), more.end());
}

// Three buildings of a street, turned by 20 degrees, one with a courtyard.
std::vector<Segment2d> Street() {
  std::vector<Segment2d> lines = Walls({{0, 0}, {13, 0}, {13, 9}, {0, 9}});
  Append(Walls({{20, 2}, {34, 2}, {34, 6}, {29, 6}, {29, 15}, {20, 15}}), lines);
  Append(Walls({{45, -5}, {75, -5}, {75, 25}, {45, 25}}), lines);
  Append(Walls({{53, 3}, {53, 17}, {67, 17}, {67, 3}}), lines);
  const Eigen::Rotation2Dd turn(0.35);
  for (Segment2d& line : lines) line = {turn * line.a, turn * line.b};
  return lines;
}

std::vector<Segment2d> Moved(std::vector<Segment2d> lines, const Vector2d& shift) {
  for (Segment2d& line : lines) line = {line.a + shift, line.b + shift};
  return lines;
}

using Numbers = std::vector<std::vector<int>>;  // of facades, by wall

Numbers OneEach(size_t count) {
  Numbers numbers;
  for (size_t i = 0; i < count; ++i) numbers.push_back({static_cast<int>(i)});
  return numbers;
}

TEST(FacadeIds, FindsAnExactShift) {
  const std::vector<Segment2d> facades = Street();
  for (const Vector2d& shift : {Vector2d(0, 0), Vector2d(2.3, -4.1), Vector2d(-7, 5.25)}) {
    const std::vector<Segment2d> walls = Moved(facades, shift);
    const auto found = FindShift(walls, facades);
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found - shift).norm(), 0, 1e-6);
    EXPECT_EQ(MatchWalls(walls, facades, *found), OneEach(facades.size()));
  }
}

TEST(FacadeIds, SurvivesNoiseAndWallsThatAreNotThere) {
  const std::vector<Segment2d> facades = Street();
  std::mt19937 random(7);
  const auto noise = [&] { return (random() % 2001 - 1000.0) * 4e-4; };  // within 0.4 m
  std::vector<Segment2d> walls = Moved(facades, {3, 4});
  for (Segment2d& wall : walls) {
    wall.a += Vector2d(noise(), noise());
    wall.b += Vector2d(noise(), noise());
  }
  // Sheds, cars and dormers that no map has, and a wall that nobody saw.
  Append(Walls({{90, 90}, {94, 90}, {94, 93}, {90, 93}}), walls);
  Append(Moved(Walls({{0, 0}, {5, 0}, {5, 4}, {0, 4}}), {100, -50}), walls);
  walls.erase(walls.begin());
  const auto found = FindShift(walls, facades);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found - Vector2d(3, 4)).norm(), 0, 0.3);
  Numbers expected = OneEach(facades.size());
  expected.erase(expected.begin());
  expected.resize(walls.size());
  EXPECT_EQ(MatchWalls(walls, facades, *found), expected);
}

TEST(FacadeIds, KeepsTheShiftAlongParallelWallsSmall) {
  const std::vector<Segment2d> facades = {{{0, 0}, {20, 0}}, {{22, 0}, {40, 0}}};
  const auto found = FindShift(Moved(facades, {0, -3}), facades);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->y(), -3, 1e-6);
  EXPECT_NEAR(found->x(), 0, 0.6);
}

TEST(FacadeIds, WallsMayShareAFacadeAndFacadesAWall) {
  const std::vector<Segment2d> facades = {
      {{0, 0}, {20, 0}}, {{20, 0}, {50, 0}}, {{50, 0}, {50, 9}}};
  // Two halves of the first, with a step of half a metre; one wall over a part of it and the
  // second.
  const std::vector<Segment2d> walls = {
      {{0, 0}, {9, 0}}, {{9, 0.5}, {19, 0.5}}, {{16, 0}, {50, 0}}, {{50, 0}, {50, 9}}};
  EXPECT_EQ(MatchWalls(walls, facades, {0, 0}), (Numbers{{0}, {0}, {1}, {2}}));
}

TEST(FacadeIds, AWallOfATerraceSpansTheFacadesOfItsHouses) {
  const std::vector<Segment2d> facades = {
      {{0, 0}, {6, 0}}, {{6, 0.3}, {14, 0.3}}, {{14, 0}, {20, 0}}, {{20, 0}, {31, 0}}};
  EXPECT_EQ(MatchWalls({{{0, 0}, {22, 0}}}, facades, {0, 0}), (Numbers{{1, 0, 2}}));
  // The back of a recess stands behind the front, and is not beside another part of the wall.
  const std::vector<Segment2d> recess = {{{0, 0}, {30, 0}}, {{8, 1.2}, {14, 1.2}}};
  EXPECT_EQ(MatchWalls({{{0, 0}, {30, 0}}}, recess, {0, 0}), (Numbers{{0}}));
}

TEST(FacadeIds, TheBackOfAThinWallIsNotItsFront) {
  const std::vector<Segment2d> facades = {{{0, 0}, {20, 0}}};
  EXPECT_EQ(MatchWalls({{{20, 0.3}, {0, 0.3}}}, facades, {0, 0}), Numbers{{}});
  // Nor is a wall that stands off it, beside it or across it.
  EXPECT_EQ(MatchWalls({{{0, 2.5}, {20, 2.5}}}, facades, {0, 0}), Numbers{{}});
  EXPECT_EQ(MatchWalls({{{14, 0}, {34, 0}}}, facades, {0, 0}), Numbers{{}});
  EXPECT_EQ(MatchWalls({{{0, -1}, {12, 6}}}, facades, {0, 0}), Numbers{{}});
}

TEST(FacadeIds, APlanOfAnotherPlaceMatchesNothing) {
  EXPECT_FALSE(FindShift(Moved(Street(), {400, 0}), Street()));
  // Here, but of houses that stand otherwise.
  std::vector<Segment2d> turned = Street();
  const Eigen::Rotation2Dd turn(0.6);
  for (Segment2d& line : turned) line = {turn * line.a, turn * line.b};
  EXPECT_FALSE(FindShift(turned, Street()));
  EXPECT_FALSE(FindShift({}, Street()));
  EXPECT_FALSE(FindShift(Street(), {}));
  EXPECT_FALSE(FindShift(Street(), {{{1, 1}, {1, 1}}}));
}

// Detached houses in rows that all streets of the quarter follow.
std::vector<Segment2d> Quarter(uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double from, double to) {
    return from + (to - from) * (random() % 1001) / 1000.0;
  };
  std::vector<Segment2d> lines;
  for (int i = 0; i < 16; ++i) {
    const double x = 24.0 * (i % 4) + between(-3, 3);
    const double y = 24.0 * (i / 4) + between(-3, 3);
    const double w = between(9, 16);
    const double h = between(9, 16);
    Append(Walls({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}), lines);
  }
  return lines;
}

// Maps may be off by more than GPS is: by hundreds of metres in some countries. By chance some
// shift brings half of the walls of a regular quarter within two metres of a wrong facade.
TEST(FacadeIds, APlanOfAnotherQuarterOfTheTownMatchesNothing) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    EXPECT_FALSE(FindShift(Quarter(seed), Quarter(seed + 100))) << seed;
  }
}

TEST(FacadeIds, WallsStandBehindTheEavesThatMapsTrace) {
  const std::vector<Segment2d> walls = Quarter(1);
  std::vector<Segment2d> facades = Moved(walls, {-4, 6});
  for (Segment2d& line : facades) {
    const Vector2d along = (line.b - line.a).normalized();
    const Vector2d outwards(along.y(), -along.x());
    line = {line.a + 0.8 * (outwards - along), line.b + 0.8 * (outwards + along)};
  }
  const auto found = FindShift(walls, facades);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found - Vector2d(4, -6)).norm(), 0, 0.1);
  EXPECT_EQ(MatchWalls(walls, facades, *found), OneEach(facades.size()));
}

// Houses 6 m wide and 6 m apart: moved by 12 m, all but one stand where another does.
std::vector<Segment2d> RowOfHouses(int count) {
  std::vector<Segment2d> lines;
  for (int i = 0; i < count; ++i) {
    const double x = 12.0 * i;
    Append(Walls({{x, 0}, {x + 6, 0}, {x + 6, 9}, {x, 9}}), lines);
  }
  return lines;
}

TEST(FacadeIds, AHouseOfARegularRowIsNotItsNeighbour) {
  for (const int houses : {2, 5, 20}) {
    const std::vector<Segment2d> facades = RowOfHouses(houses);
    for (const Vector2d& shift : {Vector2d(8, 0), Vector2d(-8, 3)}) {
      const std::vector<Segment2d> walls = Moved(facades, shift);
      const auto found = FindShift(walls, facades);
      ASSERT_TRUE(found);
      EXPECT_NEAR((*found - shift).norm(), 0, 1e-6) << houses << " houses";
      EXPECT_EQ(MatchWalls(walls, facades, *found), OneEach(facades.size()));
    }
  }
}

// Of a row that goes on on both sides nothing else says which houses the survey has.
TEST(FacadeIds, TheLeastShiftIsTakenWhereSeveralExplainTheSurvey) {
  const std::vector<Segment2d> facades = RowOfHouses(9);
  const std::vector<Segment2d> walls(facades.begin() + 12, facades.begin() + 20);
  const auto found = FindShift(Moved(walls, {4, 0}), facades);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found - Vector2d(4, 0)).norm(), 0, 1e-6);
}

TEST(FacadeIds, ASurveyOfPartOfThePlanMatches) {
  const std::vector<Segment2d> facades = Street();
  const std::vector<Segment2d> walls(facades.begin(), facades.begin() + 4);
  const auto found = FindShift(Moved(walls, {-2, 1}), facades);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found - Vector2d(-2, 1)).norm(), 0, 1e-6);
}

// A building of four walls and a roof in the world frame.
Proxy MadeProxy(const std::vector<Segment2d>& lines) {
  Proxy proxy;
  proxy.metric = true;
  Building building;
  building.id = "C0001";
  for (size_t i = 0; i < lines.size(); ++i) {
    Facet wall;
    wall.id = "C0001/W0" + std::to_string(i);
    const Vector2d along = (lines[i].b - lines[i].a).normalized();
    wall.normal = {along.y(), -along.x(), 0};
    const auto at = [](const Vector2d& p, double z) { return Eigen::Vector3d(p.x(), p.y(), z); };
    wall.outer = {at(lines[i].a, 0), at(lines[i].b, 0), at(lines[i].b, 6), at(lines[i].a, 6)};
    wall.offset = wall.normal.dot(wall.outer[0]);
    building.facets.push_back(wall);
  }
  Facet roof;
  roof.id = "C0001/R0";
  roof.facet_class = FacetClass::kRoof;
  building.facets.push_back(roof);
  proxy.buildings.push_back(building);
  return proxy;
}

TEST(FacadeIds, NamesTheWallsOfAProxy) {
  using Ids = std::vector<std::string>;
  const std::vector<Segment2d> lines = Walls({{-6, -4}, {6, -4}, {6, 4}, {-6, 4}});
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 47.05;
  georef.origin_longitude_deg = 15.4;
  georef.origin_height_m = 412;
  Plan plan;
  plan.origin = {47.0503, 15.3996, 0};  // another origin than the survey's
  const Vector2d start =
      PlanFromGeodetic(plan.origin, {georef.origin_latitude_deg, georef.origin_longitude_deg});
  for (size_t i = 0; i < lines.size(); ++i) {
    PlannedFacade facade;
    facade.id = "B0012/F0" + std::to_string(3 - i);
    facade.a_m = lines[i].a + start;
    facade.b_m = lines[i].b + start;
    plan.facades.push_back(facade);
  }
  Proxy proxy = MadeProxy(Moved(lines, {1.5, -2.5}));
  const FacadeNaming naming = NameFacades(plan, georef, proxy);
  EXPECT_EQ(naming.walls, 4u);
  EXPECT_EQ(naming.named, 4u);
  EXPECT_EQ(naming.facades, 4u);
  ASSERT_TRUE(naming.shift_m);
  EXPECT_NEAR((*naming.shift_m - Vector2d(1.5, -2.5)).norm(), 0, 0.01);
  const std::vector<Facet>& facets = proxy.buildings[0].facets;
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(facets[i].id, "C0001/W0" + std::to_string(i));
    EXPECT_EQ(facets[i].planned_facades, Ids{"B0012/F0" + std::to_string(3 - i)});
  }
  EXPECT_EQ(facets[4].planned_facades, Ids());

  // The front is of two houses.
  PlannedFacade half = plan.facades[0];
  half.id = "B0013/F00";
  half.b_m = plan.facades[0].a_m + Vector2d(5, 0);
  plan.facades[0].a_m = half.b_m;
  plan.facades.push_back(half);
  Proxy terrace = MadeProxy(lines);
  EXPECT_EQ(NameFacades(plan, georef, terrace).facades, 5u);
  EXPECT_EQ(terrace.buildings[0].facets[0].planned_facades, (Ids{"B0012/F03", "B0013/F00"}));
  EXPECT_EQ(terrace.buildings[0].facets[1].planned_facades.size(), 1u);

  plan.origin.latitude_deg += 10;
  Proxy elsewhere = MadeProxy(lines);
  EXPECT_FALSE(NameFacades(plan, georef, elsewhere).shift_m);
  EXPECT_EQ(elsewhere.buildings[0].facets[0].planned_facades, Ids());
}

TEST(FacadeIds, LinesHaveTheBuildingOnTheirLeft) {
  const Proxy proxy = MadeProxy({{{1, 2}, {9, 4}}});
  Facet wall = proxy.buildings[0].facets[0];
  EXPECT_NEAR((LineOf(wall).a - Vector2d(1, 2)).norm(), 0, 1e-9);
  EXPECT_NEAR((LineOf(wall).b - Vector2d(9, 4)).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace stucco
