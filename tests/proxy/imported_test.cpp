// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "proxy/imported/fit_to_points.h"
#include "proxy/imported/flat_pieces.h"
#include "proxy/imported/measure_support.h"
#include "proxy/imported/proxy_of_surfaces.h"
#include "proxy/imported/sort_pieces.h"
#include "proxy/imported/welded_model.h"
#include "proxy/solids/closed_check.h"
#include "survey/error.h"
#include "survey/ply.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using Eigen::Vector3d;
using test::House;
using test::TruePolygon;
using testing::HasSubstr;
using testing::UnorderedElementsAre;
using Ring3d = std::vector<Vector3d>;

constexpr double kFlat = 0.01;

bool IsNeverBehind(const Facet& /*facet*/) {
  return false;
}

// The polygons fanned to triangles, as a mesh has them.
SurfaceModel MeshOf(const std::vector<House>& houses) {
  SurfaceModel model;
  model.is_mesh = true;
  model.objects.emplace_back();
  for (const House& house : houses) {
    for (const TruePolygon& polygon : house.polygons) {
      for (size_t i = 1; i + 1 < polygon.ring.size(); ++i) {
        model.objects[0].polygons.push_back(
            {{{polygon.ring[0], polygon.ring[i], polygon.ring[i + 1]}}, {}, {}});
      }
    }
  }
  return model;
}

// The floor that houses of tests lack.
House Closed(House house) {
  Ring3d floor;
  for (const TruePolygon& polygon : house.polygons) {
    for (size_t i = 0; i < polygon.ring.size(); ++i) {
      const Vector3d& a = polygon.ring[i];
      if (a.z() == 0 && polygon.ring[(i + 1) % polygon.ring.size()].z() == 0) floor.push_back(a);
    }
  }
  std::ranges::reverse(floor);
  house.polygons.push_back({"floor", floor});
  return house;
}

std::vector<Building> BuildingsOf(const SurfaceModel& model) {
  WeldedModel welded = Weld(model, kFlat);
  std::vector<FlatPiece> pieces = FindFlatPieces(welded, kFlat);
  Settle(kFlat, welded, pieces);
  return SortPieces(model, welded, std::move(pieces), IsNeverBehind);
}

std::map<FacetClass, int> ClassesOf(const Building& building) {
  std::map<FacetClass, int> classes;
  for (const Facet& facet : building.facets) ++classes[facet.facet_class];
  return classes;
}

SurfaceModel OneObject(std::vector<Ring3d> outer_rings) {
  SurfaceModel model;
  model.is_mesh = true;
  model.objects.emplace_back();
  for (Ring3d& ring : outer_rings) model.objects[0].polygons.push_back({{std::move(ring)}, {}, {}});
  return model;
}

TEST(ImportedSurfaces, TrianglesInAPlaneAreOneFacetAndTheHouseIsClosed) {
  const std::vector<Building> buildings = BuildingsOf(MeshOf({Closed(test::GableHouse())}));
  ASSERT_EQ(buildings.size(), 1u);
  EXPECT_EQ(buildings[0].id, "M0001");
  EXPECT_TRUE(buildings[0].watertight);
  EXPECT_EQ(ClassesOf(buildings[0]),
            (std::map<FacetClass, int>{
                {FacetClass::kWall, 4}, {FacetClass::kRoof, 2}, {FacetClass::kGround, 1}}));
  EXPECT_EQ(FindOpening(buildings[0].facets), std::nullopt);
  std::vector<std::string> ids;
  for (const Facet& facet : buildings[0].facets) ids.push_back(facet.id);
  EXPECT_THAT(ids, UnorderedElementsAre("M0001/W00", "M0001/W01", "M0001/W02", "M0001/W03",
                                        "M0001/R0", "M0001/R1", "M0001/G0"));
}

TEST(ImportedSurfaces, ClosedHousesAreTurnedToFaceOutwards) {
  SurfaceModel model = MeshOf({Closed(test::BoxHouse(10, 8, 6))});
  for (SurfacePolygon& polygon : model.objects[0].polygons) {
    std::ranges::reverse(polygon.rings.front());
  }
  const std::vector<Building> buildings = BuildingsOf(model);
  ASSERT_EQ(buildings.size(), 1u);
  EXPECT_EQ(FindOpening(buildings[0].facets), std::nullopt);
  EXPECT_EQ(ClassesOf(buildings[0]),
            (std::map<FacetClass, int>{
                {FacetClass::kWall, 4}, {FacetClass::kRoof, 1}, {FacetClass::kGround, 1}}));
}

TEST(ImportedSurfaces, HousesOnOneGroundAreBuildingsOfTheirOwn) {
  House box = test::BoxHouse(10, 8, 6, {5, 4, 0});
  // Ground around it that shares the edges of its walls, as a mesh of a whole place has.
  const Ring3d inner = {{0, 0, 0}, {10, 0, 0}, {10, 8, 0}, {0, 8, 0}};
  const Ring3d outer = {{-9, -9, 0}, {19, -9, 0}, {19, 17, 0}, {-9, 17, 0}};
  for (size_t i = 0; i < 4; ++i) {
    const size_t j = (i + 1) % 4;
    box.polygons.push_back({"ground", {outer[i], outer[j], inner[j], inner[i]}});
  }
  const House other = test::BoxHouse(4, 4, 3, {40, 0, 0});
  const std::vector<Building> buildings = BuildingsOf(MeshOf({box, other}));
  ASSERT_EQ(buildings.size(), 3u);
  EXPECT_EQ(ClassesOf(buildings[0]),
            (std::map<FacetClass, int>{{FacetClass::kWall, 4}, {FacetClass::kRoof, 1}}));
  EXPECT_FALSE(buildings[0].watertight);
  EXPECT_EQ(buildings[1].id, "M0002");
  EXPECT_EQ(buildings[2].id, "G0");
  ASSERT_EQ(buildings[2].facets.size(), 1u);  // with a hole where the house stands
  EXPECT_EQ(buildings[2].facets[0].facet_class, FacetClass::kGround);
  ASSERT_EQ(buildings[2].facets[0].holes.size(), 1u);
  EXPECT_NEAR(buildings[2].facets[0].area, 28 * 26 - 80, 1e-9);
}

TEST(ImportedSurfaces, EdgesOfThreeFacesAreKeptAndCloseNothing) {
  House box = Closed(test::BoxHouse(10, 8, 6, {5, 4, 0}));
  box.polygons.push_back({"fin", {{0, 0, 0}, {0, 0, 6}, {-3, -3, 6}, {-3, -3, 0}}});
  const std::vector<Building> buildings = BuildingsOf(MeshOf({box}));
  ASSERT_EQ(buildings.size(), 1u);
  EXPECT_FALSE(buildings[0].watertight);
  EXPECT_EQ(ClassesOf(buildings[0]),
            (std::map<FacetClass, int>{
                {FacetClass::kWall, 5}, {FacetClass::kRoof, 1}, {FacetClass::kGround, 1}}));
  double area = 0;
  for (const Facet& facet : buildings[0].facets) area += facet.area;
  EXPECT_NEAR(area, 2 * 80 + 36 * 6 + 6 * std::sqrt(18), 1e-6);
}

TEST(ImportedSurfaces, HousesThatTouchInOneEdgeAreBothWhole) {
  const House one = Closed(test::BoxHouse(10, 8, 6, {5, 4, 0}));
  const House other = Closed(test::BoxHouse(10, 8, 6, {15, 12, 0}));
  size_t facets = 0;
  for (const Building& building : BuildingsOf(MeshOf({one, other}))) {
    for (const Facet& facet : building.facets) {
      ++facets;
      if (facet.facet_class != FacetClass::kWall) continue;
      Vector3d middle = Vector3d::Zero();
      for (const Vector3d& corner : facet.outer) middle += corner / 4;
      // Outwards, from the middle of the house that the wall belongs to.
      const Vector3d houses[] = {{5, 4, 3}, {15, 12, 3}};
      const bool is_others = (middle - houses[1]).norm() < (middle - houses[0]).norm();
      const Vector3d& house = houses[is_others ? 1 : 0];
      EXPECT_GT(facet.normal.dot(middle - house), 0) << facet.id;
    }
  }
  EXPECT_EQ(facets, 12u);
}

TEST(ImportedSurfaces, ABandOfOneSideIsTakenAsItIs) {
  // Twelve quadrilaterals around a circle, turned by half a turn on their way round.
  constexpr int kParts = 12;
  std::vector<std::pair<Vector3d, Vector3d>> rungs;
  for (int i = 0; i < kParts; ++i) {
    const double around = 2 * M_PI * i / kParts;
    const Vector3d out(std::cos(around), std::sin(around), 0);
    const Vector3d half = std::cos(around / 2) * Vector3d::UnitZ() + std::sin(around / 2) * out;
    rungs.emplace_back(10 * out - 2 * half, 10 * out + 2 * half);
  }
  std::vector<Ring3d> triangles;
  for (int i = 0; i < kParts; ++i) {
    const auto [a, b] = rungs[i];
    auto [c, d] = rungs[(i + 1) % kParts];
    if (i + 1 == kParts) std::swap(c, d);
    triangles.push_back({a, b, d});
    triangles.push_back({a, d, c});
  }
  size_t facets = 0;
  for (const Building& building : BuildingsOf(OneObject(triangles))) {
    EXPECT_FALSE(building.watertight);
    facets += building.facets.size();
  }
  EXPECT_EQ(facets, 2u * kParts);
}

TEST(ImportedSurfaces, OutlinesThatTouchThemselvesPassNoCornerTwice) {
  // Four squares around a fifth that is missing, and one that touches them at a corner only.
  std::vector<Ring3d> squares;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (x == 1 && y == 1) continue;
      squares.push_back({{1.0 * x, 1.0 * y, 0},
                         {x + 1.0, 1.0 * y, 0},
                         {x + 1.0, y + 1.0, 0},
                         {1.0 * x, y + 1.0, 0}});
    }
  }
  squares.erase(squares.begin());  // the missing square now touches the outline
  const WeldedModel welded = Weld(OneObject(squares), kFlat);
  double area = 0;
  for (const FlatPiece& piece : FindFlatPieces(welded, kFlat)) {
    area += piece.area;
    for (std::vector<int> ring : piece.rings) {
      std::ranges::sort(ring);
      EXPECT_EQ(std::ranges::adjacent_find(ring), ring.end());
    }
  }
  EXPECT_NEAR(area, 7, 1e-9);
}

TEST(ImportedSurfaces, DoubledPolygonsCountOnceAndBentOnesAreTriangles) {
  const Ring3d square = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  Ring3d back = square;
  std::ranges::reverse(back);
  const Ring3d bent = {{10, 0, 0}, {14, 0, 0}, {14, 4, 1}, {10, 4, 0}};
  const Ring3d empty = {{20, 0, 0}, {24, 0, 0}, {22, 0, 0}};
  SurfaceModel model = OneObject({square, back, bent, empty});
  model.is_mesh = false;
  const WeldedModel welded = Weld(model, kFlat);
  EXPECT_EQ(welded.doubled, 1);
  EXPECT_EQ(welded.empty, 1);
  const std::vector<FlatPiece> pieces = FindFlatPieces(welded, kFlat);
  ASSERT_EQ(pieces.size(), 3u);
  for (const FlatPiece& piece : pieces) EXPECT_LT(piece.deviation, 1e-9);
}

TEST(ImportedSurfaces, PolygonsOfAFileStayFacetsOfTheirOwn) {
  SurfaceModel model = OneObject(
      {{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}, {{4, 0, 0}, {8, 0, 0}, {8, 0, 3}, {4, 0, 3}}});
  model.is_mesh = false;
  model.objects[0].id = "house";
  model.objects[0].polygons[0].id = "house/F00.1";
  model.objects[0].polygons[1].id = "elsewhere/W00";
  const std::vector<Building> buildings = BuildingsOf(model);
  ASSERT_EQ(buildings.size(), 1u);
  EXPECT_EQ(buildings[0].id, "house");
  ASSERT_EQ(buildings[0].facets.size(), 2u);
  EXPECT_EQ(buildings[0].facets[0].id, "house/F00.1");
  EXPECT_EQ(buildings[0].facets[1].id, "house/W00");
}

TEST(ImportedSurfaces, CornersThatAFileRoundsMeetInTheirPlanesAgain) {
  SurfaceModel model = MeshOf({Closed(test::GableHouse(12.0371, 8.0183, 6.0117, 9.4793))});
  const Eigen::AngleAxisd turn(0.3, Vector3d::UnitZ());
  for (SurfacePolygon& polygon : model.objects[0].polygons) {
    for (Vector3d& p : polygon.rings.front()) {
      p = (1000 * (turn * p)).array().round().matrix() / 1000;
    }
  }
  const std::vector<Building> buildings = BuildingsOf(model);
  ASSERT_EQ(buildings.size(), 1u);
  EXPECT_EQ(buildings[0].facets.size(), 7u);
  EXPECT_TRUE(buildings[0].watertight);
}

// A survey around a house and a box, with its cloud in a file.
class ImportedTown : public testing::Test {
 protected:
  ImportedTown() {
    captured_ = test::Capture(houses_, {test::GroundSquare(25)}, {.spacing = 0.25});
    for (SurveyPhoto& photo : captured_.photos) {
      photo.camera = {CameraId{1}, CameraModel::kPinhole, 2000, 1500, {1500, 1500, 1000, 750}};
    }
    cloud_ = std::filesystem::path(testing::TempDir()) / "imported_town.ply";
    WritePly(captured_.cloud, cloud_);
    georef_.frame = "enu";
    georef_.metric = true;
    georef_.up = Vector3d::UnitZ();
  }
  SurfaceSurvey Survey() const { return {cloud_, {}, captured_.photos, georef_, {}}; }
  static void Move(const Eigen::Isometry3d& by, SurfaceModel& model) {
    for (SurfacePolygon& polygon : model.objects[0].polygons) {
      for (Vector3d& p : polygon.rings.front()) p = by * p;
    }
  }

  std::vector<House> houses_ = {Closed(test::GableHouse()),
                                Closed(test::BoxHouse(5, 4, 3, {9, 6, 0}))};
  test::Captured captured_;
  std::filesystem::path cloud_;
  Georef georef_;
};

TEST_F(ImportedTown, IsMovedOntoThePoints) {
  SurfaceModel model = MeshOf(houses_);
  const Eigen::Isometry3d by =
      Eigen::Translation3d(2.6, -3.1, 44.7) * Eigen::AngleAxisd(0.007, Vector3d::UnitZ());
  Move(by, model);
  const SurfaceModel moved = model;
  std::vector<Vector3d> points;
  for (size_t i = 0; i < captured_.cloud.size(); i += 10) {
    points.push_back(captured_.cloud.positions[i]);
  }
  const UprightMove move = FitToPoints(moved, points);
  EXPECT_LT(move.near_before, 0.01);
  EXPECT_GT(move.near_after, 0.1);  // the others are of the ground
  for (const TruePolygon& polygon : houses_[0].polygons) {
    for (const Vector3d& p : polygon.ring) EXPECT_LT((move * (by * p) - p).norm(), 0.04);
  }
  const SurfaceProxy made = ProxyOfSurfaces(model, Survey(), /*moves=*/true, "town.obj");
  EXPECT_THAT(made.notes, testing::Contains(HasSubstr("was moved onto the survey's points")));
  EXPECT_EQ(made.proxy.buildings.size(), 2u);
}

TEST_F(ImportedTown, SaysWhatOfItThePhotosShow) {
  const SurfaceProxy made = ProxyOfSurfaces(MeshOf(houses_), Survey(), /*moves=*/false, "town.obj");
  for (const Building& building : made.proxy.buildings) {
    EXPECT_TRUE(building.watertight);
    for (const Facet& facet : building.facets) {
      EXPECT_EQ(facet.source, "file");
      if (facet.facet_class == FacetClass::kGround) {
        EXPECT_LT(facet.seen, 0.2);
        continue;
      }
      EXPECT_GT(facet.seen, 0.5) << facet.id;
      EXPECT_GT(facet.support, 50) << facet.id;
      EXPECT_LT(facet.rms, 0.05) << facet.id;
    }
  }
}

TEST_F(ImportedTown, PointsCountOnlyInTheirPartOfAFacet) {
  Proxy proxy;
  proxy.buildings = BuildingsOf(OneObject({{{0, 0, 0}, {10, 0, 0}, {10, 0, 4}, {0, 0, 4}}}));
  PointCloud cloud;
  for (double x = 0.05; x < 5; x += 0.1) {
    for (double z = 0.05; z < 4; z += 0.1) cloud.positions.emplace_back(x, 0.03, z);
  }
  cloud.positions.emplace_back(8, 0.5, 2);  // before it
  cloud.positions.emplace_back(12, 0, 2);   // beside it
  MeasureSupport(StreamOf(cloud), 0.15, 0.2, proxy);
  const Facet& wall = proxy.buildings[0].facets[0];
  EXPECT_EQ(wall.support, 50 * 40);
  EXPECT_NEAR(wall.seen, 0.5, 0.02);
  EXPECT_EQ(wall.inferred, 1 - wall.seen);
  EXPECT_NEAR(wall.rms, 0.03, 1e-9);
}

TEST_F(ImportedTown, WallsSeenFromBehindAreTurned) {
  SurfaceModel model = OneObject({{{0, 0, 0}, {0, 0, 4}, {10, 0, 4}, {10, 0, 0}}});
  SurfaceSurvey survey = Survey();
  std::vector<SurveyPhoto> south;
  for (const SurveyPhoto& photo : captured_.photos) {
    if (photo.cam_from_world.Center().y() < -5) south.push_back(photo);
  }
  ASSERT_FALSE(south.empty());
  survey.photos = south;
  const SurfaceProxy made = ProxyOfSurfaces(model, survey, /*moves=*/false, "wall.obj");
  EXPECT_LT(made.proxy.buildings.at(0).facets.at(0).normal.y(), -0.99);
}

TEST_F(ImportedTown, WithoutPointsPicturesAloneTell) {
  SurfaceSurvey survey = Survey();
  survey.cloud.clear();
  const SurfaceProxy made = ProxyOfSurfaces(MeshOf(houses_), survey, /*moves=*/true, "town.obj");
  EXPECT_EQ(made.proxy.buildings.size(), 2u);
  EXPECT_THAT(made.notes, testing::Contains(HasSubstr("there is no cloud yet")));
}

TEST_F(ImportedTown, RefusesWhatNoPhotoLooksAtAndWhatIsNotMadeOfPlanes) {
  const auto refusal = [&](const SurfaceModel& model) -> std::string {
    try {
      ProxyOfSurfaces(model, Survey(), /*moves=*/false, "town.obj");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      return error.what();
    }
    return "was not refused";
  };
  SurfaceModel far = MeshOf(houses_);
  Move(Eigen::Isometry3d(Eigen::Translation3d(0, 5000, 0)), far);
  EXPECT_THAT(refusal(far), HasSubstr("town.obj: no photo looks at it"));
  SurfaceModel rough;
  rough.is_mesh = true;
  rough.objects.emplace_back();
  const auto height = [](int x, int y) { return std::sin(1234.5 * x * x + 789.1 * y * y + x * y); };
  for (int x = 0; x < 115; ++x) {
    for (int y = 0; y < 115; ++y) {
      const auto at = [&](int i, int j) {
        return Vector3d(0.1 * (x + i), 0.1 * (y + j), height(x + i, y + j));
      };
      rough.objects[0].polygons.push_back({{{at(0, 0), at(1, 0), at(1, 1)}}, {}, {}});
      rough.objects[0].polygons.push_back({{{at(0, 0), at(1, 1), at(0, 1)}}, {}, {}});
    }
  }
  EXPECT_THAT(refusal(rough), HasSubstr("polygons lie in"));
}

}  // namespace
}  // namespace stucco
