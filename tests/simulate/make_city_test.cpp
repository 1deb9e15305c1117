// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/make_city.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "plan/map/read_site.h"
#include "simulate/city/lay_out_town.h"
#include "simulate/city/town_map.h"
#include "simulate/scene/scene_folder.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/plan_frame.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"
#include "survey/triangulate.h"
#include "tests/survey/support.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;

CityOptions Coarse(const std::string& style, uint64_t seed) {
  CityOptions options;
  options.style = style;
  options.seed = seed;
  options.metres_per_texel = 0.25;
  return options;
}

Site SiteOf(const fs::path& scene) {
  std::optional<fs::path> dem;
  if (fs::exists(scene / kSceneTerrain)) dem = scene / kSceneTerrain;
  return plan::ReadSite({.map = scene / kSceneMap, .dem = dem}, plan::PlanOptions{});
}

std::map<std::string, Facet> FacetsById(const fs::path& scene) {
  std::map<std::string, Facet> facets;
  for (const Building& building : ReadProxy(scene / kTruthFacets).buildings) {
    for (const Facet& facet : building.facets) facets[facet.id] = facet;
  }
  return facets;
}

class Cities : public testing::TestWithParam<std::string> {};

TEST_P(Cities, EveryFacadeOfThePlannerIsAWallOfTheTruth) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  const CitySummary summary = MakeCity(Coarse(GetParam(), 5), scene);
  const SceneInfo info = ReadSceneInfo(scene);
  const auto facets = FacetsById(scene);
  const Site site = SiteOf(scene);
  EXPECT_TRUE(site.repairs.empty()) << site.repairs[0];
  std::set<std::string> matched;
  for (const Facade& facade : site.facades) {
    if (StandsAboveNeighbour(site, facade)) continue;  // the truth hides party walls whole
    ASSERT_TRUE(facets.contains(facade.id)) << facade.id;
    const Facet& wall = facets.at(facade.id);
    EXPECT_EQ(FacadeName(wall), facade.id);
    matched.insert(facade.id);
    // The wall's foot runs from a to b, to a millimetre of the map's rounding.
    const auto in_scene = [&](const Eigen::Vector2d& at) -> Eigen::Vector2d {
      const Geodetic place = GeodeticFromPlan(site.origin, at);
      return EnuFromGeodetic(info.georef, place.latitude_deg, place.longitude_deg,
                             info.georef.origin_height_m)
          .head<2>();
    };
    EXPECT_LT((in_scene(facade.a) - wall.outer[0].head<2>()).norm(), 2e-3) << facade.id;
    EXPECT_LT((in_scene(facade.b) - wall.outer[1].head<2>()).norm(), 2e-3) << facade.id;
    // What the planner takes for the wall's top is nowhere lower than the wall.
    double top = wall.outer[0].z();
    for (const auto& corner : wall.outer) top = std::max(top, corner.z());
    const double above_foot = top - wall.outer[0].z();
    EXPECT_GT(facade.z_m.length_m(), above_foot - 0.1) << facade.id;
  }
  EXPECT_EQ(static_cast<int>(matched.size()), summary.facades);
  for (const auto& [id, facet] : facets) {
    const bool free_wall = facet.facet_class == FacetClass::kWall && facet.seen > 0;
    EXPECT_EQ(free_wall, matched.contains(id)) << id;
  }
}

TEST_P(Cities, PicturesLieOnTheirFacets) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse(GetParam(), 6), scene);
  const auto facets = FacetsById(scene);
  const std::string glb = ReadFile(scene / kSceneModel);
  std::set<std::string> textured;
  for (const TexturedFacet& texture : ReadTextureSet(scene / kTruthTextures).facets) {
    ASSERT_TRUE(facets.contains(texture.id)) << texture.id;
    textured.insert(texture.id);
    const Facet& facet = facets.at(texture.id);
    EXPECT_NEAR(texture.u_axis.dot(texture.v_axis), 0, 1e-9);
    EXPECT_NEAR((texture.v_axis.cross(texture.u_axis) - facet.normal).norm(), 0, 1e-6);
    for (const Eigen::Vector3d& corner : facet.outer) {
      const Eigen::Vector3d at = (corner - texture.origin) / texture.metres_per_texel;
      EXPECT_NEAR(at.dot(facet.normal), 0, 1e-4) << texture.id;
      EXPECT_GT(at.dot(texture.u_axis), -1e-3) << texture.id;
      EXPECT_GT(at.dot(texture.v_axis), -1e-3) << texture.id;
      EXPECT_LT(at.dot(texture.u_axis), texture.width_px + 1e-3) << texture.id;
      EXPECT_LT(at.dot(texture.v_axis), texture.height_px + 1e-3) << texture.id;
    }
    const std::string bytes = ReadFile(scene / "truth" / texture.image);
    const ImageSize size = ReadJpegSize(scene / "truth" / texture.image);
    EXPECT_EQ(size.width_px, texture.width_px);
    EXPECT_EQ(size.height_px, texture.height_px);
    EXPECT_NE(glb.find(bytes), std::string::npos) << texture.id;
  }
  for (const auto& [id, facet] : facets) {
    const bool wants = facet.seen > 0 && facet.facet_class != FacetClass::kGround;
    EXPECT_EQ(wants, textured.contains(id)) << id;
  }
}

// By element, the vertices of the model that are drawn, in triangles.
std::map<std::string, std::vector<Eigen::Vector3d>> CornersByElement(const Scene& scene) {
  std::map<std::string, std::vector<Eigen::Vector3d>> corners;
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    for (const int vertex : scene.triangles[i]) {
      corners[scene.elements[scene.elements_of[i]]].push_back(
          scene.positions[vertex].cast<double>());
    }
  }
  return corners;
}

// A texel of the truth's picture is the same place in the model: where the picture lies on a
// triangle, it is not stretched.
TEST_P(Cities, TexelsLieInTheModelWhereTheTruthSays) {
  const test::TemporaryFolder folder;
  const fs::path folder_of_scene = folder / "scene";
  MakeCity(Coarse(GetParam(), 9), folder_of_scene);
  const Scene scene = ReadScene(folder_of_scene);
  std::map<std::string, TexturedFacet> textures;
  for (const TexturedFacet& facet : ReadTextureSet(folder_of_scene / kTruthTextures).facets) {
    textures[facet.id] = facet;
  }
  int checked = 0;
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    const std::string& id = scene.elements[scene.elements_of[i]];
    const std::string& material = scene.materials[scene.materials_of[i]].name;
    if (!textures.contains(id) || (material != id && material != id + "-pane")) continue;
    const TexturedFacet& texture = textures.at(id);
    for (const int vertex : scene.triangles[i]) {
      const Eigen::Vector3d from = scene.positions[vertex].cast<double>() - texture.origin;
      const Eigen::Vector2d texels = scene.uv[vertex].cast<double>().cwiseProduct(
          Eigen::Vector2d(texture.width_px, texture.height_px));
      ASSERT_NEAR(texels.x() * texture.metres_per_texel, from.dot(texture.u_axis), 1e-3) << id;
      ASSERT_NEAR(texels.y() * texture.metres_per_texel, from.dot(texture.v_axis), 1e-3) << id;
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
}

// What is seen and what the truth says of it are one place: roofs wholly, walls but for their
// relief, which leaves two fifths of them or more.
TEST_P(Cities, TheModelLiesOnTheTruth) {
  constexpr double kFloat_m = 1e-4;
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse(GetParam(), 7), scene);
  const auto corners = CornersByElement(ReadScene(scene));
  for (const auto& [id, facet] : FacetsById(scene)) {
    if (facet.facet_class == FacetClass::kGround) continue;
    ASSERT_TRUE(corners.contains(id)) << id;
    const auto& drawn = corners.at(id);
    double on_plane_m2 = 0;
    for (size_t i = 0; i < drawn.size(); i += 3) {
      double farthest = 0;
      for (size_t k = i; k < i + 3; ++k) {
        farthest = std::max(farthest, std::abs(facet.normal.dot(drawn[k]) - facet.offset));
      }
      if (farthest < kFloat_m) {
        on_plane_m2 += (drawn[i + 1] - drawn[i]).cross(drawn[i + 2] - drawn[i]).norm() / 2;
      }
      const bool roof = facet.facet_class == FacetClass::kRoof;
      ASSERT_LT(farthest, roof ? kFloat_m : 1.5 + kFloat_m) << id;
    }
    EXPECT_GT(on_plane_m2, 0.4 * facet.area) << id;
  }
}

// Heights of triangles over a place; those that stand upright have none.
std::vector<double> HeightsAt(const std::vector<Eigen::Vector3d>& triangles,
                              const Eigen::Vector2d& at) {
  constexpr double kUpright_m2 = 1e-6;
  constexpr double kEdge = 1e-6;
  std::vector<double> heights;
  for (size_t i = 0; i < triangles.size(); i += 3) {
    Eigen::Matrix2d edges;
    edges << (triangles[i + 1] - triangles[i]).head<2>(),
        (triangles[i + 2] - triangles[i]).head<2>();
    if (std::abs(edges.determinant()) < kUpright_m2) continue;
    const Eigen::Vector2d b = edges.inverse() * (at - triangles[i].head<2>());
    if (b.minCoeff() < -kEdge || b.sum() > 1 + kEdge) continue;
    heights.push_back(triangles[i].z() + b.x() * (triangles[i + 1] - triangles[i]).z() +
                      b.y() * (triangles[i + 2] - triangles[i]).z());
  }
  return heights;
}

TEST_P(Cities, TheGroundOfTheTruthIsThatOfTheModel) {
  constexpr double kFloat_m = 1e-3;
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse(GetParam(), 10), scene);
  const std::vector<Eigen::Vector3d> drawn = CornersByElement(ReadScene(scene)).at("G0");
  for (const auto& [id, facet] : FacetsById(scene)) {
    if (!id.starts_with("G")) continue;  // the floors of buildings are B0001/G0
    const FacetTriangles shape = TriangulateFacet(facet);
    for (const auto& triangle : shape.triangles) {
      Eigen::Vector3d inside = Eigen::Vector3d::Zero();
      for (const uint32_t corner : triangle) inside += shape.vertices[corner] / 3;
      const std::vector<double> heights = HeightsAt(drawn, inside.head<2>());
      ASSERT_FALSE(heights.empty()) << id << ": a hole at " << inside.transpose();
      ASSERT_TRUE(std::ranges::any_of(
          heights, [&](double z) { return std::abs(z - inside.z()) < kFloat_m; }))
          << id << ": at " << inside.transpose() << " the model has " << heights[0];
    }
  }
}

// Walls are seen where they stand above the ground that is drawn, in columns of a quarter metre.
TEST_P(Cities, SeenIsTheShareOfAWallAboveTheGround) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse(GetParam(), 12), scene);
  const bool sloping = ReadSceneInfo(scene).has_terrain;
  const std::vector<Eigen::Vector3d> ground = CornersByElement(ReadScene(scene)).at("G0");
  double least = 1;
  for (const auto& [id, facet] : FacetsById(scene)) {
    if (facet.seen == 0) continue;
    EXPECT_DOUBLE_EQ(facet.seen + facet.inferred, 1) << id;
    if (!sloping || facet.facet_class != FacetClass::kWall) {
      ASSERT_EQ(facet.seen, 1) << id;
      continue;
    }
    const Eigen::Vector3d along = facet.outer[1] - facet.outer[0];
    const int columns = static_cast<int>(4 * along.norm()) + 1;
    double buried = 0;
    for (int i = 0; i < columns; ++i) {
      const Eigen::Vector3d foot = facet.outer[0] + (i + 0.5) / columns * along;
      const std::vector<double> heights = HeightsAt(ground, foot.head<2>());
      ASSERT_FALSE(heights.empty());
      buried += std::max(0.0, heights[0] - foot.z()) * along.norm() / columns;
    }
    EXPECT_NEAR(facet.seen, 1 - buried / facet.area, 2e-3) << id;
    EXPECT_GT(facet.seen, 0.3) << id;
    least = std::min(least, facet.seen);
  }
  EXPECT_EQ(least < 0.9, sloping);
}

// What the map says a building is high, it is: to the ridge, or to a parapet above the roof.
TEST_P(Cities, HeightsOfTheMapAreThoseOfTheTruth) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse(GetParam(), 8), scene);
  std::map<std::string, std::pair<double, double>> reach;
  for (const Building& building : ReadProxy(scene / kTruthFacets).buildings) {
    auto& [low, high] = reach.emplace(building.id, std::pair(1e9, -1e9)).first->second;
    for (const Facet& facet : building.facets) {
      for (const Eigen::Vector3d& corner : facet.outer) {
        low = std::min(low, corner.z());
        high = std::max(high, corner.z());
      }
    }
  }
  for (const Footprint& footprint : SiteOf(scene).footprints) {
    ASSERT_TRUE(reach.contains(footprint.building)) << footprint.building;
    const auto [low, high] = reach.at(footprint.building);
    constexpr double kHighestParapet_m = 1.1;
    // The terrain is read between its samples.
    EXPECT_GT(footprint.z_m.length_m(), high - low - 0.1) << footprint.building;
    EXPECT_LT(footprint.z_m.length_m(), high - low + kHighestParapet_m + 0.1) << footprint.building;
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, Cities, testing::ValuesIn(CityStyles()),
                         [](const auto& test) { return test.param; });

TEST(MakeCity, GivesTheSameBytesAtAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  CityOptions options = Coarse("hamlet", 11);
  options.threads = 1;
  MakeCity(options, folder / "one");
  options.threads = 3;
  MakeCity(options, folder / "three");
  for (const char* name : {kSceneModel, kSceneMap, kTruthFacets, kTruthTextures, kSceneFile}) {
    EXPECT_EQ(HashFile(folder / "one" / name), HashFile(folder / "three" / name)) << name;
  }
}

TEST(MakeCity, WallsMayRepeatWithoutAnotherMap) {
  const test::TemporaryFolder folder;
  CityOptions options = Coarse("hamlet", 11);
  MakeCity(options, folder / "usual");
  options.repeat = true;
  MakeCity(options, folder / "repeating");
  EXPECT_EQ(HashFile(folder / "usual" / kSceneMap), HashFile(folder / "repeating" / kSceneMap));
  EXPECT_NE(HashFile(folder / "usual" / kSceneModel), HashFile(folder / "repeating" / kSceneModel));
}

TEST(MakeCity, ReplacesAnOlderSceneAndLeavesOtherFilesAlone) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse("terrain", 1), scene);
  WriteFile(scene / "notes.txt", "mine");
  WriteFile(scene / "truth" / "textures" / "mine.jpg", "mine");
  MakeCity(Coarse("hamlet", 2), scene);
  EXPECT_EQ(ReadFile(scene / "notes.txt"), "mine");
  EXPECT_EQ(ReadFile(scene / "truth" / "textures" / "mine.jpg"), "mine");
  EXPECT_FALSE(fs::exists(scene / "truth" / "textures" / "B0005_F00.jpg"));
  EXPECT_FALSE(fs::exists(scene / kSceneTerrain));
  EXPECT_FALSE(ReadSceneInfo(scene).has_terrain);
}

// Whoever is interrupted must not be left with a model of one town and the truth of another.
TEST(MakeCity, LeavesNoOldModelBesideNewTruth) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse("hamlet", 1), scene);
  fs::remove(scene / kSceneMap);
  fs::create_directories(scene / kSceneMap / "in the way");
  EXPECT_THROW(MakeCity(Coarse("hamlet", 2), scene), Error);
  EXPECT_FALSE(fs::exists(scene / kSceneModel));
}

TEST(MakeCity, ReplacesASceneWhoseTruthIsDamaged) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder / "scene";
  MakeCity(Coarse("hamlet", 1), scene);
  WriteFile(scene / kTruthTextures, "{\"facets\": [{\"id\"");
  MakeCity(Coarse("hamlet", 2), scene);
  EXPECT_FALSE(ReadTextureSet(scene / kTruthTextures).facets.empty());
}

TEST(MakeCity, TouchesNoFolderThatIsNoScene) {
  const test::TemporaryFolder folder;
  WriteFile(folder / "thesis.txt", "years of work");
  const Error error = test::ErrorOf([&] { MakeCity(Coarse("hamlet", 1), folder.path()); });
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_FALSE(fs::exists(folder / kSceneFile));
  EXPECT_EQ(test::ErrorOf([&] { MakeCity(Coarse("hamlet", 1), folder / "thesis.txt"); }).kind(),
            ErrorKind::kBadInput);
  EXPECT_EQ(
      test::ErrorOf([&] { MakeCity(Coarse("hamlet", 1), folder / "thesis.txt/below"); }).kind(),
      ErrorKind::kBadInput);
}

TEST(MakeCity, RefusesBadOptionsBeforeItWrites) {
  const test::TemporaryFolder folder;
  CityOptions style = Coarse("castle", 1);
  CityOptions texel = Coarse("hamlet", 1);
  texel.metres_per_texel = std::nan("");
  CityOptions pole = Coarse("hamlet", 1);
  pole.latitude_deg = 90;
  CityOptions date_line = Coarse("hamlet", 1);
  date_line.longitude_deg = 180;
  for (const CityOptions& options : {style, texel, pole, date_line}) {
    const Error error = test::ErrorOf([&] { MakeCity(options, folder / "scene"); });
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_FALSE(fs::exists(folder / "scene"));
  }
}

}  // namespace
}  // namespace stucco::simulate
