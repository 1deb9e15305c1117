// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "proxy/facets/facets.h"
#include "proxy/facets/plane_view.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStep = 0.1;

// A wall in the plane y = 0 facing south, seen where `seen` says so, 12 x 8 m.
struct Wall {
  PlanarScene scene;
  Plane plane;
  std::vector<PlaneView> views;

  explicit Wall(const std::function<bool(double, double)>& seen,
                const std::function<bool(double, double)>& behind = nullptr) {
    scene.samples.camera_centers = {{6, -30, 2}};
    scene.tolerances = {.level_of_detail = 0.3,
                        .epsilon = 0.15,
                        .min_area = 2.25,
                        .fill_gap = 1.5,
                        .spacing = kStep,
                        .radius = 0.3};
    for (double x = kStep / 2; x < 12; x += kStep) {
      for (double z = kStep / 2; z < 8; z += kStep) {
        if (seen(x, z)) {
          plane.points.push_back(static_cast<int>(scene.samples.size()));
          Add({x, 0, z});
        }
        if (behind && behind(x, z)) {
          scene.support.push_back(static_cast<int>(scene.samples.size()));
          Add(Vector3d(6, -30, 2) + 1.2 * (Vector3d(x, 0, z) - Vector3d(6, -30, 2)));
        }
      }
    }
    plane.normal = -Vector3d::UnitY();
    plane.role = PlaneRole::kWall;
    views = ViewPlanes(scene, {&plane, 1}, 99, 1);
  }
  void Add(const Vector3d& p) {
    scene.samples.positions.push_back(p);
    scene.samples.normals.push_back(-Vector3d::UnitY());
    scene.samples.weights.push_back(1);
    scene.samples.cameras.push_back(0);
  }
  std::vector<Facet> Facets(const std::vector<CutLine>& creases = {}) const {
    return OutlineFacets(scene.samples, views[0], creases, scene.tolerances, /*ground=*/false);
  }
};

struct Box {
  double x0, x1, z0, z1;
};

bool InBox(double x, double z, const Box& box) {
  return x > box.x0 && x < box.x1 && z > box.z0 && z < box.z1;
}

TEST(OutlineFacets, ARectangleIsARectangle) {
  const auto facets = Wall([](double x, double z) { return InBox(x, z, {2, 10, 1, 6}); }).Facets();
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_EQ(facets[0].outer.size(), 4u);
  EXPECT_TRUE(facets[0].holes.empty());
  EXPECT_NEAR(facets[0].area, 40, 2.0);
  EXPECT_GT(facets[0].seen, 0.95);
  EXPECT_EQ(facets[0].support, 80 * 50);
  for (const auto& p : facets[0].outer) {
    EXPECT_NEAR(p.y(), 0, 1e-9);
    EXPECT_NEAR(std::min(std::abs(p.x() - 2), std::abs(p.x() - 10)), 0, 0.15);
    EXPECT_NEAR(std::min(std::abs(p.z() - 1), std::abs(p.z() - 6)), 0, 0.15);
  }
}

TEST(OutlineFacets, ClosesWindowsAndRaggedBorders) {
  const auto facets = Wall([](double x, double z) {
                        const bool window = std::fmod(x, 2) < 1 && z > 2.5 && z < 4.3;
                        const bool ragged = z > 5.8 + 0.15 * std::sin(9 * x);
                        return InBox(x, z, {2, 10, 1, 7}) && !window && !ragged;
                      }).Facets();
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_EQ(facets[0].outer.size(), 4u);
  EXPECT_TRUE(facets[0].holes.empty());
  EXPECT_NEAR(facets[0].area, 38.4, 2.5);
  EXPECT_LT(facets[0].seen, 0.9);
  EXPECT_NEAR(facets[0].seen + facets[0].inferred, 1, 1e-12);
}

TEST(OutlineFacets, KeepsAPassageThatRaysGoThrough) {
  const auto passage = [](double x, double z) { return InBox(x, z, {4, 7, 1, 4}); };
  const auto wall = [&](double x, double z) {
    return InBox(x, z, {1, 11, 1, 7}) && !passage(x, z);
  };
  const auto open = Wall(wall, passage).Facets();
  ASSERT_EQ(open.size(), 1u);
  EXPECT_NEAR(open[0].area, 51, 3);
}

TEST(OutlineFacets, EndsAtACreaseEvenAcrossALostStrip) {
  // The roof meets the wall at z = 6; matching lost the last 0.5 m.
  const CutLine crease{
      .point = {0, 6}, .direction = Vector2d::UnitX(), .crease = true, .from = -100, .to = 100};
  Wall wall([](double x, double z) { return InBox(x, z, {2, 10, 1, 5.5}); });
  CutLine in_frame = crease;
  in_frame.point = wall.views[0].raster.frame.ToPlane({0, 0, 6});
  const auto facets = wall.Facets({in_frame});
  ASSERT_EQ(facets.size(), 1u);
  double top = -1;
  for (const auto& p : facets[0].outer) top = std::max(top, p.z());
  EXPECT_NEAR(top, 6, 1e-9);
}

TEST(OutlineFacets, AWallEndsAtItsFoot) {
  // A car hides the wall up to 1.5 m; a mirror of the wet street adds points below the ground.
  Wall wall([](double x, double z) {
    return InBox(x, z, {2, 10, 2.5, 7}) || InBox(x, z, {2, 4, 0.2, 7});
  });
  CutLine foot{.point = wall.views[0].raster.frame.ToPlane({0, 0, 1}),
               .direction = Vector2d::UnitX(),
               .crease = true,
               .foot = true,
               .from = -100,
               .to = 100};
  const auto facets = wall.Facets({foot});
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_EQ(facets[0].outer.size(), 4u);
  double bottom = 99;
  for (const auto& p : facets[0].outer) bottom = std::min(bottom, p.z());
  EXPECT_NEAR(bottom, 1, 1e-9);
}

TEST(OutlineFacets, ClosesGapsThatCross) {
  // Only window frames have texture: plain stripes between them, both ways.
  const auto facets =
      Wall([](double x, double z) {
        return InBox(x, z, {1, 11, 1, 7.5}) && std::fmod(x, 4.5) < 2.9 && std::fmod(z, 4.5) < 2.9;
      }).Facets();
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_TRUE(facets[0].holes.empty());
  EXPECT_EQ(facets[0].outer.size(), 4u);
}

TEST(OutlineFacets, TheSkyBetweenTwoGablesStaysOpen) {
  const auto facets = Wall([](double x, double z) {
                        return InBox(x, z, {1, 11, 1, 4}) || InBox(x, z, {1, 4, 1, 7.5}) ||
                               InBox(x, z, {8, 11, 1, 7.5});
                      }).Facets();
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_NEAR(facets[0].area, 51, 3);
}

TEST(OutlineFacets, DropsIslandsAndSplitsParts) {
  const auto facets = Wall([](double x, double z) {
                        return InBox(x, z, {0.5, 4, 1, 7}) || InBox(x, z, {8, 11.5, 1, 7}) ||
                               InBox(x, z, {5.8, 6.3, 3, 3.5});
                      }).Facets();
  ASSERT_EQ(facets.size(), 2u);
  for (const auto& facet : facets) EXPECT_NEAR(facet.area, 21, 2);
}

TEST(OutlineFacets, AGableKeepsItsSlopes) {
  const auto facets = Wall([](double x, double z) {
                        return InBox(x, z, {1, 11, 0.5, 7.5 - 0.8 * std::abs(x - 6)});
                      }).Facets();
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_EQ(facets[0].outer.size(), 5u);
  EXPECT_NEAR(facets[0].area, 50, 2.5);
}

TEST(OutlineFacets, AFewPointsAreNoFacet) {
  EXPECT_TRUE(Wall([](double x, double z) {
                return InBox(x, z, {3, 3.5, 3, 3.5});
              })
                  .Facets()
                  .empty());
}

// Three planes with a sample every 10 cm where they are seen.
class CreasesTest : public testing::Test {
 protected:
  void Add(Plane& plane, const Vector3d& p) {
    plane.points.push_back(static_cast<int>(scene_.samples.size()));
    scene_.samples.positions.push_back(p);
    scene_.samples.normals.push_back(plane.normal);
    scene_.samples.weights.push_back(1);
    scene_.samples.cameras.push_back(-1);
  }
  std::vector<PlaneView> View(size_t first_ground) const {
    PlanarScene scene = scene_;
    scene.tolerances = tolerances_;
    return ViewPlanes(scene, planes_, first_ground, 1);
  }

  PlanarScene scene_;
  std::vector<Plane> planes_ = std::vector<Plane>(3);
  Tolerances tolerances_{.level_of_detail = 0.3,
                         .epsilon = 0.15,
                         .min_area = 2.25,
                         .fill_gap = 1.5,
                         .spacing = 0.1,
                         .radius = 0.3};
};

TEST_F(CreasesTest, FindsTheLineWhereWallsMeet) {
  planes_[0].normal = -Vector3d::UnitY();
  planes_[1].normal = Vector3d::UnitX();
  planes_[1].offset = 5;
  planes_[2].normal = Vector3d::UnitX();  // far from the others' points
  planes_[2].offset = 60;
  for (auto& plane : planes_) plane.role = PlaneRole::kWall;
  for (double a = 0.05; a < 5; a += 0.1) {
    for (double z = 0.05; z < 4; z += 0.1) {
      Add(planes_[0], {a, 0, z});
      Add(planes_[1], {5, a, z});
      Add(planes_[2], {60, a, z});
    }
  }
  const auto views = View(99);
  const std::vector<const PlaneView*> others = {&views[0], &views[1], &views[2]};
  const auto creases = Creases(views[0], others, 1.5, 0.9);
  ASSERT_EQ(creases.size(), 1u);
  const Vector3d p = views[0].raster.frame.ToWorld(creases[0].point);
  EXPECT_NEAR(p.x(), 5, 1e-9);
  EXPECT_NEAR(std::abs(creases[0].direction.y()), 1, 1e-9);
  EXPECT_LT(creases[0].from, creases[0].to);
}

TEST_F(CreasesTest, TakeNoSlopeFarAwayForTheFootOfAWall) {
  planes_[0].normal = -Vector3d::UnitY();
  planes_[0].role = PlaneRole::kWall;
  planes_[1].role = planes_[2].role = PlaneRole::kHorizontal;
  // A bank 41 m before the wall, which would reach it 5 m up: z = 5 + 0.12 y.
  planes_[2].normal = Vector3d(0, -0.12, 1).normalized();
  planes_[2].offset = 5 / std::hypot(1, 0.12);
  for (double x = 0.05; x < 8; x += 0.1) {
    for (double z = 0.05; z < 6; z += 0.1) Add(planes_[0], {x, 0, z});
    for (double y = -6; y < 0; y += 0.1) Add(planes_[1], {x, y, 0});
    for (double y = -45; y < -41; y += 0.1) Add(planes_[2], {x, y, 5 + 0.12 * y});
  }
  const auto views = View(1);
  const std::vector<const PlaneView*> grounds = {&views[1], &views[2]};
  const auto creases = Creases(views[0], grounds, 1.5, 0.9);
  ASSERT_EQ(creases.size(), 1u);
  EXPECT_TRUE(creases[0].foot);
  EXPECT_NEAR(views[0].raster.frame.ToWorld(creases[0].point).z(), 0, 1e-9);
  const auto facets = OutlineFacets(scene_.samples, views[0], creases, tolerances_, false);
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_NEAR(facets[0].area, 48, 3);
}

TEST(AssignIds, GivesEachClassItsLetterByFallingArea) {
  Building building{.id = "B0012", .source = "cloud", .detail = {}, .facets = {}};
  const auto add = [&](FacetClass facet_class, double area) {
    Facet facet;
    facet.facet_class = facet_class;
    facet.area = area;
    building.facets.push_back(facet);
  };
  add(FacetClass::kOuterFloor, 3);
  add(FacetClass::kWall, 20);
  add(FacetClass::kRoof, 50);
  add(FacetClass::kWall, 40);
  add(FacetClass::kGround, 60);
  AssignIds(building);
  std::vector<std::string> ids;
  for (const Facet& facet : building.facets) {
    ids.push_back(facet.id);
    EXPECT_EQ(FacadeName(facet), facet.id);
  }
  // F is left to the facades of the map.
  EXPECT_EQ(ids, (std::vector<std::string>{"B0012/W00", "B0012/W01", "B0012/R0", "B0012/G0",
                                           "B0012/O0"}));
}

}  // namespace
}  // namespace stucco
