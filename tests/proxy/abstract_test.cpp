// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/abstract.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "proxy/solids/closed_check.h"
#include "survey/error.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using Eigen::Vector3d;
using test::Capture;
using test::Captured;
using test::CaptureOptions;
using test::InputOf;

Georef Metric() {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Vector3d::UnitZ();
  return georef;
}

Proxy Abstract(const Captured& captured, const Georef& georef = Metric(),
               const ProxyOptions& options = {}, int threads = 1) {
  ProxyFindings findings;
  const Proxy proxy = AbstractCloud(InputOf(captured, georef), options, threads, findings);
  EXPECT_EQ(FindProblem(proxy), std::nullopt);
  return proxy;
}

const Building* Find(const Proxy& proxy, const std::string& id) {
  for (const Building& building : proxy.buildings) {
    if (building.id == id) return &building;
  }
  return nullptr;
}

int Count(const Building& building, FacetClass facet_class) {
  return static_cast<int>(
      std::count_if(building.facets.begin(), building.facets.end(),
                    [&](const Facet& facet) { return facet.facet_class == facet_class; }));
}

double AngleDeg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

// Every true polygon has one facet on its plane, with its area.
void ExpectTruth(const test::House& house, const Building& building, double angle_deg,
                 double offset, double area_share) {
  for (const auto& polygon : house.polygons) {
    const Eigen::Vector4d truth = test::PlaneOf(polygon);
    double area = 0;
    for (size_t i = 1; i + 1 < polygon.ring.size(); ++i) {
      area += (polygon.ring[i] - polygon.ring[0])
                  .cross(polygon.ring[i + 1] - polygon.ring[0])
                  .dot(truth.head<3>()) /
              2;
    }
    const auto fits = [&](const Facet& facet) {
      const double middle = truth.head<3>().dot((facet.outer[0] + facet.outer[1]) / 2) - truth[3];
      return AngleDeg(facet.normal, truth.head<3>()) < angle_deg && std::abs(middle) < offset &&
             std::abs(facet.area - area) < area_share * area;
    };
    EXPECT_EQ(std::count_if(building.facets.begin(), building.facets.end(), fits), 1)
        << polygon.name;
  }
}

TEST(AbstractCloud, AGableHouseIsClosedAndExact) {
  const auto house = test::GableHouse();
  const Proxy proxy = Abstract(Capture({house}, {test::GroundSquare(20)}, {.noise = 0.01}));
  ASSERT_EQ(proxy.buildings.size(), 2u);
  const Building& building = proxy.buildings[0];
  EXPECT_EQ(building.id, "C0001");
  EXPECT_TRUE(building.watertight);
  ASSERT_EQ(building.facets.size(), 7u);
  EXPECT_EQ(Count(building, FacetClass::kWall), 4);
  EXPECT_EQ(Count(building, FacetClass::kRoof), 2);
  EXPECT_EQ(Count(building, FacetClass::kGround), 1);
  EXPECT_EQ(building.facets[0].id, "C0001/W00");
  EXPECT_EQ(FindOpening(building.facets), std::nullopt);
  ExpectTruth(house, building, 0.2, 0.01, 0.01);
  const Building& ground = proxy.buildings[1];
  EXPECT_EQ(ground.id, "G0");
  ASSERT_EQ(ground.facets.size(), 1u);
  EXPECT_EQ(ground.facets[0].facet_class, FacetClass::kGround);
  EXPECT_NEAR(ground.facets[0].outer[0].z(), 0, 0.02);
}

TEST(AbstractCloud, AnLShapeIsClosed) {
  const auto house = test::LShapedHouse();
  const Proxy proxy = Abstract(Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02}));
  const Building& building = proxy.buildings[0];
  EXPECT_TRUE(building.watertight);
  EXPECT_EQ(building.facets.size(), 8u);
  ExpectTruth(house, building, 0.2, 0.02, 0.01);
}

TEST(AbstractCloud, AFacadeThatLeansKeepsItsLean) {
  auto house = test::BoxHouse(14, 10, 12);
  constexpr double kSetback = 1.2;  // of its top: 5.7 degrees
  for (auto& polygon : house.polygons) {
    for (Vector3d& p : polygon.ring) {
      if (p.y() < 0 && p.z() > 6) p.y() += kSetback;
    }
  }
  const Proxy proxy = Abstract(Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02}));
  const Building& building = proxy.buildings[0];
  EXPECT_TRUE(building.watertight);
  EXPECT_EQ(Count(building, FacetClass::kWall), 4);
  ExpectTruth(house, building, 0.2, 0.03, 0.02);
}

TEST(AbstractCloud, BearsNoiseStraysAndTrees) {
  const auto house = test::GableHouse();
  for (const double noise : {0.03, 0.08}) {
    Captured captured =
        Capture({house}, {test::GroundSquare(20)}, {.noise = noise, .outliers = 0.1});
    test::AddTree({11, -6, 3}, 2, 6000, 4, captured);
    const Proxy proxy = Abstract(captured);
    const Building* building = Find(proxy, "C0001");
    ASSERT_NE(building, nullptr);
    EXPECT_TRUE(building->watertight) << noise;
    EXPECT_EQ(building->facets.size(), 7u) << noise;
    ExpectTruth(house, *building, 0.5, 0.05, 0.03);
  }
}

TEST(AbstractCloud, ASideNobodySawIsMarkedInferred) {
  const auto house = test::BoxHouse(12, 8, 6);
  const Proxy proxy =
      Abstract(Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02, .hide = {"north"}}));
  const Building& building = proxy.buildings[0];
  EXPECT_TRUE(building.watertight);
  double inferred_walls = 0;
  for (const Facet& facet : building.facets) {
    if (facet.facet_class != FacetClass::kWall || facet.inferred < 0.99) continue;
    inferred_walls += facet.area;
    EXPECT_EQ(facet.source, "extruded");
    EXPECT_EQ(facet.support, 0);
  }
  EXPECT_NEAR(inferred_walls, 72, 12);
}

TEST(AbstractCloud, AFrontAloneStaysOpenFacets) {
  const auto house = test::GableHouse();
  CaptureOptions options{.noise = 0.02, .front_only = true, .hide = {"east", "west"}};
  const Proxy proxy = Abstract(Capture({house}, {test::GroundSquare(20)}, options));
  const Building* building = Find(proxy, "C0001");
  ASSERT_NE(building, nullptr);
  EXPECT_FALSE(building->watertight);
  ASSERT_EQ(building->facets.size(), 2u);
  const Facet& front = building->facets[0];
  EXPECT_EQ(front.facet_class, FacetClass::kWall);
  EXPECT_NEAR(front.area, 72, 1.5);
  EXPECT_EQ(front.outer.size(), 4u);
  EXPECT_GT(front.seen, 0.95);
  // Towards the cameras, which stand in the south.
  EXPECT_LT(AngleDeg(front.normal, -Vector3d::UnitY()), 0.5);
}

TEST(AbstractCloud, WhatHasNoFaceOfAHouseIsNone) {
  const CaptureOptions options{.noise = 0.02, .front_only = true, .hide = {"east", "west"}};
  const auto house = test::GableHouse();
  const auto kiosk = test::BoxHouse(3, 3, 3, {22, 0, 0});
  const Captured captured = Capture({house, kiosk}, {test::GroundSquare(40)}, options);
  const Proxy proxy = Abstract(captured);
  ASSERT_EQ(proxy.buildings.size(), 2u);  // the house's front and the ground
  EXPECT_GT(proxy.buildings[0].facets[0].area, 70);
  // Without a scale nobody knows what is small.
  Georef unknown;
  unknown.up = Vector3d::UnitZ();
  EXPECT_EQ(Abstract(captured, unknown).buildings.size(), 3u);
}

TEST(AbstractCloud, FindsUpAndScaleInAnArbitraryFrame) {
  const auto house = test::GableHouse();
  Captured captured =
      Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02, .front_only = true});
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.7).normalized()).toRotationMatrix();
  test::MoveTo(rotation, 0.137, {3, -1, 8}, captured);
  const Proxy proxy = Abstract(captured, Georef{});
  EXPECT_LT(AngleDeg(proxy.up, rotation.col(2)), 0.5);
  EXPECT_FALSE(proxy.metric);
  const Building* building = Find(proxy, "C0001");
  ASSERT_NE(building, nullptr);
  EXPECT_LE(building->facets.size(), 7u);
  EXPECT_NE(Find(proxy, "G0"), nullptr);
  bool front_found = false;
  for (const Facet& facet : building->facets) {
    if (facet.facet_class == FacetClass::kWall) {
      EXPECT_NEAR(facet.normal.dot(proxy.up), 0, 1e-9);
    }
    front_found |= AngleDeg(facet.normal, -rotation.col(1)) < 0.5 &&
                   std::abs(facet.area - 72 * 0.137 * 0.137) < 0.05 * 72 * 0.137 * 0.137;
  }
  EXPECT_TRUE(front_found);
}

TEST(AbstractCloud, AWrongUpFromSensorsIsRefinedByWalls) {
  const auto house = test::GableHouse();
  const Captured captured = Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02});
  Georef georef = Metric();
  georef.frame = "arbitrary";
  georef.up = Vector3d(0.03, -0.02, 1).normalized();  // two degrees off
  EXPECT_LT(AngleDeg(Abstract(captured, georef).up, Vector3d::UnitZ()), 0.2);
}

TEST(AbstractCloud, WallsStandUprightInAFrameThatGpsTilted) {
  Captured captured = Capture({test::GableHouse()}, {test::GroundSquare(20)}, {.noise = 0.02});
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(2 * std::numbers::pi / 180, Vector3d(1, 0.5, 0).normalized())
          .toRotationMatrix();
  test::MoveTo(tilt, 1, Vector3d::Zero(), captured);
  Georef georef = Metric();
  georef.source = "gps";
  const Proxy proxy = Abstract(captured, georef);
  EXPECT_LT(AngleDeg(proxy.up, tilt.col(2)), 0.1);
  const Building* building = Find(proxy, "C0001");
  ASSERT_NE(building, nullptr);
  EXPECT_TRUE(building->watertight);
  for (const Facet& facet : building->facets) {
    if (facet.facet_class == FacetClass::kWall) {
      EXPECT_NEAR(facet.normal.dot(tilt.col(2)), 0, 0.002);
    }
  }
  georef.source = "rtk";  // known to millimetres: not to be moved
  EXPECT_EQ(Abstract(captured, georef).up, Vector3d::UnitZ());
}

TEST(AbstractCloud, TwoHousesAreTwoBuildings) {
  const Proxy proxy =
      Abstract(Capture({test::BoxHouse(8, 6, 5, {-9, 0, 0}), test::BoxHouse(6, 6, 7, {9, 0, 0})},
                       {test::GroundSquare(20)}, {.noise = 0.02}));
  ASSERT_EQ(proxy.buildings.size(), 3u);
  for (const char* id : {"C0001", "C0002"}) {
    EXPECT_TRUE(Find(proxy, id)->watertight);
    EXPECT_EQ(Find(proxy, id)->facets.size(), 6u);
  }
}

TEST(AbstractCloud, AHouseKeepsItsDirectionBesideALargerOne) {
  constexpr double kTurned = 2.5;
  auto turned = test::BoxHouse(6, 6, 5, {9, 0, 0});
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(kTurned * std::numbers::pi / 180, Vector3d::UnitZ()).toRotationMatrix();
  for (auto& polygon : turned.polygons) {
    for (Vector3d& p : polygon.ring) p = turn * p;
  }
  const Proxy proxy = Abstract(Capture({test::BoxHouse(10, 8, 6, {-11, 0, 0}), turned},
                                       {test::GroundSquare(22)}, {.noise = 0.02}));
  int walls = 0;
  for (const char* id : {"C0001", "C0002"}) {
    const Building* building = Find(proxy, id);
    ASSERT_NE(building, nullptr);
    EXPECT_TRUE(building->watertight);
    for (const Facet& facet : building->facets) {
      if (facet.facet_class != FacetClass::kWall) continue;
      ++walls;
      const bool is_turned = facet.outer[0].x() > 0;
      const double azimuth =
          std::atan2(facet.normal.y(), facet.normal.x()) * 180 / std::numbers::pi;
      EXPECT_NEAR(std::remainder(azimuth, 90), is_turned ? kTurned : 0, 0.4);
    }
  }
  EXPECT_EQ(walls, 8);
}

TEST(AbstractCloud, AFlatRoofLiesBelowItsParapetAndAWallBeforeItsWindows) {
  test::House house = test::BoxHouse(10, 8, 6);
  const auto add = [&](const std::string& name, std::vector<Vector3d> ring) {
    house.polygons.push_back({name, std::move(ring)});
  };
  // A rim of 0.6 m that stands 0.2 m above the roof, and panes as far behind the south wall.
  add("rim south", {{-5, -4, 6.2}, {5, -4, 6.2}, {5, -3.4, 6.2}, {-5, -3.4, 6.2}});
  add("rim north", {{-5, 3.4, 6.2}, {5, 3.4, 6.2}, {5, 4, 6.2}, {-5, 4, 6.2}});
  add("rim west", {{-5, -3.4, 6.2}, {-4.4, -3.4, 6.2}, {-4.4, 3.4, 6.2}, {-5, 3.4, 6.2}});
  add("rim east", {{4.4, -3.4, 6.2}, {5, -3.4, 6.2}, {5, 3.4, 6.2}, {4.4, 3.4, 6.2}});
  Captured captured = Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02});
  for (size_t i = 0; i < captured.cloud.positions.size(); ++i) {
    auto& p = captured.cloud.positions[i];
    const bool on_wall = std::abs(p.y() + 4) < 0.1f && p.z() > 1 && p.z() < 4;
    if (on_wall && std::fmod(p.x() + 5, 3.3f) < 1.5f) p.y() += 0.2f;
  }
  const Proxy proxy = Abstract(captured);
  const Building* building = Find(proxy, "C0001");
  ASSERT_NE(building, nullptr);
  for (const Facet& facet : building->facets) {
    if (facet.facet_class == FacetClass::kRoof && facet.area > 30) {
      EXPECT_NEAR(facet.outer[0].z(), 6, 0.02);
    }
    if (facet.facet_class == FacetClass::kWall && facet.normal.y() < -0.9) {
      EXPECT_NEAR(facet.outer[0].y(), -4, 0.02);
    }
  }
  EXPECT_EQ(building->facets.size(), 6u);
}

TEST(AbstractCloud, HousesOnASlopeStandOnIt) {
  constexpr double kSlope = 0.158;  // 9 degrees
  auto ground = test::GroundSquare(24);
  for (Vector3d& p : ground.ring) p.z() = kSlope * p.x();
  std::vector<test::House> houses;
  for (const double x : {-13.0, 0.0, 13.0}) {
    auto house = test::BoxHouse(6, 8, 6, {x, 0, kSlope * x});
    for (auto& polygon : house.polygons) {
      for (Vector3d& p : polygon.ring) {
        if (p.z() < kSlope * x + 1) p.z() = kSlope * p.x();
      }
    }
    houses.push_back(house);
  }
  const Proxy proxy = Abstract(Capture(houses, {ground}, {.noise = 0.02}));
  ASSERT_EQ(proxy.buildings.size(), 4u);
  const Building* site = Find(proxy, "G0");
  ASSERT_NE(site, nullptr);
  EXPECT_LT(AngleDeg(site->facets[0].normal, test::PlaneOf(ground).head<3>()), 0.3);
  for (int b = 0; b < 3; ++b) {
    EXPECT_TRUE(proxy.buildings[b].watertight);
    EXPECT_EQ(proxy.buildings[b].facets.size(), 6u);
    EXPECT_EQ(Count(proxy.buildings[b], FacetClass::kWall), 4);
  }
}

TEST(AbstractCloud, AHouseWithoutGroundClosesAtItsFoot) {
  const auto house = test::BoxHouse(10, 8, 6);
  const Proxy proxy = Abstract(Capture({house}, {}, {.noise = 0.02}));
  ASSERT_EQ(proxy.buildings.size(), 1u);
  EXPECT_TRUE(proxy.buildings[0].watertight);
  EXPECT_EQ(proxy.buildings[0].facets.size(), 6u);
}

TEST(AbstractCloud, SolidsCanBeSwitchedOff) {
  const auto house = test::BoxHouse(10, 8, 6);
  const Proxy proxy = Abstract(Capture({house}, {test::GroundSquare(20)}, {.noise = 0.02}),
                               Metric(), {.solids = false});
  EXPECT_FALSE(proxy.buildings[0].watertight);
  EXPECT_EQ(proxy.buildings[0].facets.size(), 5u);
}

TEST(AbstractCloud, AFewPointsMakeACoarserModelAndSaySo) {
  const Captured captured =
      Capture({test::BoxHouse(14, 12, 9)}, {test::GroundSquare(24)}, {.noise = 0.02});
  ProxyFindings findings;
  const Proxy proxy = AbstractCloud(InputOf(captured, Metric()), {.max_points = 6000}, 1, findings);
  EXPECT_EQ(FindProblem(proxy), std::nullopt);
  ASSERT_EQ(proxy.buildings.size(), 2u);
  EXPECT_TRUE(proxy.buildings[0].watertight);
  EXPECT_EQ(proxy.buildings[0].facets.size(), 6u);
  EXPECT_THAT(findings.warnings,
              ::testing::ElementsAre(::testing::AllOf(::testing::HasSubstr("instead of 0.3"),
                                                      ::testing::HasSubstr("proxy.max_points"))));
  ProxyFindings dense;
  AbstractCloud(InputOf(captured, Metric()), {}, 1, dense);
  EXPECT_THAT(dense.warnings, ::testing::IsEmpty());
}

TEST(AbstractCloud, IsTheSameOnAnyNumberOfThreads) {
  const Captured captured =
      Capture({test::GableHouse()}, {test::GroundSquare(20)}, {.noise = 0.05, .outliers = 0.1});
  const Proxy one = Abstract(captured, Metric(), {}, 1), four = Abstract(captured, Metric(), {}, 4);
  ASSERT_EQ(one.buildings.size(), four.buildings.size());
  for (size_t b = 0; b < one.buildings.size(); ++b) {
    ASSERT_EQ(one.buildings[b].facets.size(), four.buildings[b].facets.size());
    for (size_t f = 0; f < one.buildings[b].facets.size(); ++f) {
      EXPECT_EQ(one.buildings[b].facets[f].outer, four.buildings[b].facets[f].outer);
      EXPECT_EQ(one.buildings[b].facets[f].rms, four.buildings[b].facets[f].rms);
    }
  }
}

// Clouds that show no planes.

void ExpectRefusal(const PointCloud& cloud, const std::string& word) {
  ProxyFindings findings;
  try {
    AbstractCloud({StreamOf(cloud), {}, Metric()}, {}, 1, findings);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kStageFailed);
    EXPECT_THAT(error.what(), ::testing::HasSubstr(word));
    EXPECT_FALSE(error.remedy().empty());
  }
}

TEST(AbstractCloud, RefusesCloudsWithoutPoints) {
  PointCloud cloud;
  ExpectRefusal(cloud, "0 usable points");
  cloud.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ExpectRefusal(cloud, "3 usable points");
  cloud.positions.assign(5000, Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  ExpectRefusal(cloud, "0 usable points");
  cloud.positions.assign(5000, Vector3d(1, 2, 3));
  ExpectRefusal(cloud, "at one place");
}

TEST(AbstractCloud, RefusesATree) {
  Captured captured;
  test::AddTree({0, 0, 5}, 4, 20000, 9, captured);
  ExpectRefusal(captured.cloud, "no plane");
}

TEST(AbstractCloud, RefusesALine) {
  PointCloud cloud;
  for (int i = 0; i < 3000; ++i) cloud.positions.emplace_back(0.01 * i, 0, 0);
  ExpectRefusal(cloud, "plane");
}

TEST(AbstractCloud, OnePlaneOfGroundIsGroundAlone) {
  const Proxy proxy = Abstract(Capture({}, {test::GroundSquare(15)}, {.noise = 0.02}));
  ASSERT_EQ(proxy.buildings.size(), 1u);
  EXPECT_EQ(proxy.buildings[0].id, "G0");
}

TEST(AbstractCloud, ASphereIsAtMostOpenFacets) {
  PointCloud cloud;
  for (int i = 0; i < 40000; ++i) {
    const double z = 1 - 2 * (i + 0.5) / 40000, r = std::sqrt(1 - z * z), a = 2.399963 * i;
    const Vector3d n(r * std::cos(a), r * std::sin(a), z);
    cloud.positions.push_back(6 * n);
    cloud.normals.push_back(n.cast<float>());
  }
  ProxyFindings findings;
  try {
    const Proxy proxy = AbstractCloud({StreamOf(cloud), {}, Metric()}, {}, 1, findings);
    EXPECT_EQ(FindProblem(proxy), std::nullopt);
    for (const Building& building : proxy.buildings) {
      if (building.watertight) {
        EXPECT_EQ(FindOpening(building.facets), std::nullopt);
      }
    }
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kStageFailed);
  }
}

TEST(AbstractCloud, RefusesABadUp) {
  ProxyFindings findings;
  const Captured captured = Capture({test::BoxHouse(8, 6, 5)}, {}, {.spacing = 0.2});
  for (const std::vector<double>& up : {std::vector<double>{0, 0, 0}, {1, 2}}) {
    EXPECT_THROW(AbstractCloud(InputOf(captured, Metric()), {.up = up}, 1, findings), Error);
  }
}

}  // namespace
}  // namespace stucco
