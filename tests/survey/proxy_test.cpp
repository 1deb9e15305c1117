// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/proxy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ExpectBadInput;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Optional;

// A wall with a window hole, seen from -y, far from the origin.
Facet MakeWall() {
  const double y = 1234.5;
  Facet wall;
  wall.id = "B0001/W00";
  wall.planned_facades = {"B0001/F03", "B0002/F00", "B0003/F01"};
  wall.normal = -Eigen::Vector3d::UnitY();
  wall.offset = -y;
  wall.outer = {{0, y, 0}, {4, y, 0}, {4, y, 3}, {0, y, 3}};
  wall.holes = {{{1, y, 1}, {1, y, 2}, {2, y, 2}, {2, y, 1}}};
  wall.area = 11;
  wall.rms = 0.0125;
  wall.support = 345;
  wall.seen = 0.75;
  wall.inferred = 0.25;
  wall.source = "planes";
  return wall;
}

Proxy MakeProxy() {
  Proxy proxy;
  proxy.metric = true;
  proxy.up = {0, 0.6, 0.8};
  proxy.buildings.push_back({"B0001", true, "cloud", "coarse", {MakeWall()}});
  Facet ground;
  ground.id = "G0";
  ground.facet_class = FacetClass::kGround;
  ground.outer = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  proxy.buildings.push_back({"G0", false, "map", "", {ground}});
  return proxy;
}

TEST(Proxy, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const Proxy written = MakeProxy();
  ASSERT_FALSE(FindProblem(written)) << *FindProblem(written);
  WriteProxy(written, folder / "facets.json");
  const Proxy read = ReadProxy(folder / "facets.json");
  EXPECT_EQ(read.up, written.up);
  EXPECT_TRUE(read.metric);
  ASSERT_EQ(read.buildings.size(), 2u);
  EXPECT_EQ(read.buildings[0].id, "B0001");
  EXPECT_TRUE(read.buildings[0].watertight);
  EXPECT_FALSE(read.buildings[1].watertight);
  EXPECT_EQ(read.buildings[0].source, "cloud");
  EXPECT_EQ(read.buildings[0].detail, "coarse");
  ASSERT_EQ(read.buildings[0].facets.size(), 1u);
  const Facet& wall = read.buildings[0].facets[0];
  const Facet expected = MakeWall();
  EXPECT_EQ(wall.id, expected.id);
  EXPECT_EQ(wall.planned_facades, expected.planned_facades);
  EXPECT_TRUE(read.buildings[1].facets[0].planned_facades.empty());
  EXPECT_EQ(FacadeName(wall), "B0001/F03");
  EXPECT_EQ(FacadeName(read.buildings[1].facets[0]), "G0");
  EXPECT_EQ(wall.facet_class, FacetClass::kWall);
  EXPECT_EQ(wall.normal, expected.normal);
  EXPECT_EQ(wall.offset, expected.offset);
  EXPECT_EQ(wall.outer, expected.outer);
  EXPECT_EQ(wall.holes, expected.holes);
  EXPECT_EQ(wall.area, 11);
  EXPECT_EQ(wall.rms, 0.0125);
  EXPECT_EQ(wall.support, 345);
  EXPECT_EQ(wall.seen, 0.75);
  EXPECT_EQ(wall.inferred, 0.25);
  EXPECT_EQ(wall.source, "planes");
  EXPECT_EQ(read.buildings[1].facets[0].facet_class, FacetClass::kGround);
}

TEST(Proxy, UsesTheFixedNames) {
  const TemporaryFolder folder;
  WriteProxy(MakeProxy(), folder / "facets.json");
  const std::string text = ReadFile(folder / "facets.json");
  for (const char* part :
       {"\"version\": 1", "\"buildings\": [", "\"id\": \"B0001\"", "\"watertight\": true",
        "\"source\": \"cloud\"", "\"facets\": [", "\"facade\": \"B0001/F03\"", "\"facade\": \"G0\"",
        "\"other_facades\": [", "\"class\": \"WallSurface\"", "\"area_m2\": 11.0",
        "\"rms_m\": 0.0125", "\"seen\": 0.75", "\"inferred\": 0.25"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(Proxy, FindsEachProblem) {
  const auto problem_after = [](const auto& damage) {
    Proxy proxy = MakeProxy();
    damage(proxy, proxy.buildings[0].facets[0]);
    return FindProblem(proxy);
  };
  EXPECT_FALSE(FindProblem(Proxy()));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.outer.resize(2); }),
              Optional(HasSubstr("facet B0001/W00: outer ring has 2 vertices")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.holes[0].clear(); }),
              Optional(HasSubstr("hole has 0 vertices")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.outer[2].y() += 2e-6; }),
              Optional(HasSubstr("vertex 2 of the outer ring is")));
  EXPECT_FALSE(problem_after([](Proxy&, Facet& f) { f.outer[2].y() += 5e-7; }));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.outer[1].x() = std::nan(""); }),
              Optional(HasSubstr("vertex 1 of the outer ring")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { std::swap(f.outer[0], f.outer[2]); }),
              Optional(HasSubstr("outer ring is wound the wrong way")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { std::swap(f.holes[0][0], f.holes[0][2]); }),
              Optional(HasSubstr("hole is wound the wrong way")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) {
                f.outer = {f.outer[0], f.outer[0], f.outer[0]};
              }),
              Optional(HasSubstr("outer ring has no area")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.normal *= 1.01; }),
              Optional(HasSubstr("normal is not of unit length")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.seen = 1.5; }),
              Optional(HasSubstr("must be in [0, 1]")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.id.clear(); }),
              Optional(HasSubstr("has no id")));
  EXPECT_THAT(problem_after([](Proxy&, Facet& f) { f.id = "G0"; }),
              Optional(HasSubstr("facet G0 is there twice")));
  EXPECT_THAT(problem_after([](Proxy& p, Facet&) { p.buildings[0].id = "G0"; }),
              Optional(HasSubstr("building G0 is there twice")));
  EXPECT_THAT(problem_after([](Proxy& p, Facet&) { p.up.setZero(); }),
              Optional(HasSubstr("up is not of unit length")));
}

TEST(ProxyDeathTest, RequiresIdsThatOccurOnce) {
  const TemporaryFolder folder;
  Proxy proxy = MakeProxy();
  proxy.buildings[1].facets[0].id = "B0001/W00";
  EXPECT_DEATH(WriteProxy(proxy, folder / "facets.json"), "FindIdProblem");
}

TEST(Proxy, ReadingRefusesABrokenOne) {
  const TemporaryFolder folder;
  Proxy proxy = MakeProxy();
  proxy.buildings[0].facets[0].outer[0].y() = 0;
  WriteProxy(proxy, folder / "facets.json");
  ExpectBadInput([&] { ReadProxy(folder / "facets.json"); }, "facet B0001/W00: vertex 0");
  std::string text = ReadFile(folder / "facets.json");
  text.replace(text.find("WallSurface"), 11, "DoorSurface");
  WriteFile(folder / "facets.json", text);
  ExpectBadInput([&] { ReadProxy(folder / "facets.json"); },
                 "\"buildings[0].facets[0].class\" is \"DoorSurface\"");
}

}  // namespace
}  // namespace stucco
