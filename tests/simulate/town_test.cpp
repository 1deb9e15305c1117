// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/town.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "simulate/city/design_wall.h"
#include "simulate/city/footprints.h"
#include "simulate/city/ground.h"
#include "simulate/city/house_mesh.h"
#include "simulate/city/lay_out_town.h"
#include "simulate/city/occluders.h"
#include "simulate/city/roof_mesh.h"
#include "simulate/city/town_map.h"
#include "simulate/paint/car_shape.h"
#include "simulate/paint/paint.h"
#include "survey/error.h"
#include "survey/geometry2d.h"
#include "tests/survey/support.h"

namespace stucco::simulate {
namespace {

// Seeds in which everything is looked at that costs no painting.
constexpr int kSeeds = 1000;
constexpr int kSeedsOfDesigns = 60;
constexpr int kSeedsOfMaps = 200;

std::string Print(const Town& town) {
  std::ostringstream text;
  for (const House& house : town.houses) {
    for (const Ring& ring : house.outline.rings) {
      for (const auto& corner : ring) text << corner.transpose() << ";";
    }
    text << house.storeys << static_cast<int>(house.cladding) << "\n";
  }
  return text.str();
}

class Towns : public testing::TestWithParam<std::string> {};

TEST_P(Towns, HousesNeverOverlapAndTouchAlongWholeWalls) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    ASSERT_GE(town.houses.size(), 3u);
    for (size_t i = 0; i < town.houses.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        const double gap = Gap(town.houses[i].outline, town.houses[j].outline);
        ASSERT_GE(gap, -1e-9) << "seed " << seed << ": " << i << " and " << j;
        ASSERT_TRUE(gap <= 1e-6 || gap > 2.5) << "seed " << seed << ": " << i << " and " << j;
      }
    }
  }
}

TEST_P(Towns, SolidsAreClosedAndTruthIsSound) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    Proxy proxy;
    for (const House& house : town.houses) {
      const Solid solid = SolidOf(house);
      ASSERT_FALSE(FindGap(solid)) << "seed " << seed << " " << house.id << *FindGap(solid);
      std::vector<std::string> facades(house.party.size());
      for (size_t i = 0; i < facades.size(); ++i) {
        if (!house.party[i]) facades[i] = house.id + "/F" + std::to_string(i);
      }
      proxy.buildings.push_back(TruthOf(house, solid, facades));
      EXPECT_TRUE(proxy.buildings.back().watertight);
    }
    proxy.buildings.push_back({"G0", false, "model", "", GroundFacets(town, MakeGroundGrid(town))});
    ASSERT_FALSE(FindProblem(proxy)) << "seed " << seed << " " << *FindProblem(proxy);
    if (seed == 50 && GetParam() == "terrain") break;  // thousands of facets each
  }
}

TEST_P(Towns, GroundIsWhatHousesLeaveFree) {
  for (int seed = 0; seed < 20; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    if (!town.relief.IsFlat()) return;
    double free = 0;
    for (const Facet& facet : GroundFacets(town, MakeGroundGrid(town))) free += facet.area;
    double houses = 0;
    for (const House& house : town.houses) houses += Area(house.outline);
    double covered = 0;
    const GroundGrid grid = MakeGroundGrid(town);
    for (int row = 0; row < grid.rows(); ++row) {
      for (int column = 0; column < grid.columns(); ++column) {
        if (grid.patch_of[row * grid.columns() + column] >= static_cast<int>(town.ground.size())) {
          continue;
        }
        covered += (grid.x[column + 1] - grid.x[column]) * (grid.y[row + 1] - grid.y[row]);
      }
    }
    EXPECT_NEAR(free, covered - houses, 1e-3) << "seed " << seed;
  }
}

TEST_P(Towns, PartsLieOnTheirWallsApartFromEachOther) {
  for (int seed = 0; seed < kSeedsOfDesigns; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    for (const House& house : town.houses) {
      for (const Solid::Face& face : SolidOf(house).faces) {
        if (face.facet_class != FacetClass::kWall) continue;
        const Solid solid = SolidOf(house);
        const double width = (solid.vertices[face.outer[1]] - solid.vertices[face.outer[0]]).norm();
        const double eaves = solid.vertices[face.outer[2]].z();
        const double top = face.outer.size() == 5 ? solid.vertices[face.outer[3]].z() : eaves;
        const WallDesign design = DesignWall(house, {face.edge, width, top, top - eaves});
        EXPECT_TRUE(!house.party[face.edge] || design.parts.empty());
        for (const WallPart& part : design.parts) {
          const bool band = part.kind == PartKind::kCornice || part.kind == PartKind::kLedge ||
                            part.kind == PartKind::kPlinth;
          const double margin = band ? 0 : 0.09;
          ASSERT_GE(part.top_left.x(), margin - 1e-9) << seed;
          ASSERT_LE(part.bottom_right.x(), width - margin + 1e-9) << seed;
          ASSERT_GE(part.top_left.y(), -1e-9) << seed;
          ASSERT_LE(part.bottom_right.y(), design.height_m + 1e-9) << seed;
          ASSERT_LT(part.top_left.x(), part.bottom_right.x()) << seed;
          ASSERT_LT(part.top_left.y(), part.bottom_right.y()) << seed;
          EXPECT_LE(std::abs(part.relief_m), 1.5);
        }
        for (size_t i = 0; i < design.parts.size(); ++i) {
          for (size_t j = 0; j < i; ++j) {
            const WallPart& a = design.parts[i];
            const WallPart& b = design.parts[j];
            // A balcony covers the foot of its door.
            if (a.relief_m >= 0 || b.relief_m >= 0) continue;
            const bool apart =
                a.bottom_right.x() <= b.top_left.x() || b.bottom_right.x() <= a.top_left.x() ||
                a.bottom_right.y() <= b.top_left.y() || b.bottom_right.y() <= a.top_left.y();
            ASSERT_TRUE(apart) << "seed " << seed << " " << house.id << " edge " << face.edge;
          }
        }
      }
    }
  }
}

TEST_P(Towns, RoofsHaveWhatKeepsRainOutAtTheirSlope) {
  for (int seed = 0; seed < 200; ++seed) {
    for (const House& house : LayOutTown(GetParam(), seed).houses) {
      const bool for_flat =
          house.covering == Covering::kMembrane || house.covering == Covering::kGravel;
      ASSERT_EQ(house.roof == RoofShape::kFlat, for_flat) << "seed " << seed << " " << house.id;
    }
  }
}

TEST_P(Towns, SeedsMakeDifferentTownsAndTheSameSeedTheSame) {
  std::set<std::string> towns;
  for (int seed = 0; seed < 50; ++seed) towns.insert(Print(LayOutTown(GetParam(), seed)));
  EXPECT_EQ(towns.size(), 50u);
  EXPECT_EQ(Print(LayOutTown(GetParam(), 7)), Print(LayOutTown(GetParam(), 7)));
}

// One corner and another of the first and the last house with their storeys, the last tree, the
// last car: what is drawn last depends on everything drawn before. Another compiler must not draw
// in another order.
std::string Samples(const Town& town) {
  const auto at = [](const Eigen::Vector2d& p) {
    return fmt::format("{:.3f} {:.3f}", p.x(), p.y());
  };
  std::string text;
  for (const House* house : {&town.houses.front(), &town.houses.back()}) {
    const Ring& ring = house->outline.rings[0];
    text += fmt::format("{} {} {}; ", at(ring[0]), at(ring[2]), house->storeys);
  }
  const Car& car = town.cars.back();
  return text + fmt::format("{}; {} {:.4f}", at(town.trees.back().position), at(car.position),
                            car.heading_rad);
}

TEST_P(Towns, SeedOneIsWhatItWas) {
  const std::map<std::string, std::string> expected = {
      {"hamlet",
       "2.785 12.253 9.277 7.589 1; 12.669 -14.789 2.253 -5.513 1; -22.041 -8.886; -25.795 9.146 "
       "-2.8168"},
      {"block",
       "21.426 38.310 5.464 19.574 3; -52.799 2.415 -73.705 -50.798 3; 40.299 -10.031; -26.553 "
       "-36.299 1.8904"},
      {"asia",
       "32.093 -28.573 52.949 -47.129 20; -33.325 29.277 -53.972 45.967 18; -56.360 -37.300; "
       "-27.636 61.623 1.6448"},
      {"campus",
       "-92.221 23.312 -69.904 77.995 3; 91.339 -26.085 62.397 -76.318 2; -63.563 84.944; 42.945 "
       "-79.714 -1.1356"},
      {"terrain",
       "-18.113 -1.670 -31.414 -3.308 1; 23.048 11.014 15.748 9.898 2; -38.176 -5.805; 24.488 "
       "-37.190 -0.3651"},
  };
  EXPECT_EQ(Samples(LayOutTown(GetParam(), 1)), expected.at(GetParam()));
}

// z of the roof over a place of the plan.
std::optional<double> RoofOver(const Solid& solid, const Eigen::Vector2d& at) {
  for (const Solid::Face& face : solid.faces) {
    const Loop loop = Corners(solid, face.outer);
    Polygon plan = {{{}}};
    for (const Eigen::Vector3d& corner : loop) plan.rings[0].push_back(corner.head<2>());
    if (face.facet_class != FacetClass::kRoof || !stucco::Contains(plan, at)) continue;
    const Eigen::Vector3d normal = AreaVector(loop);
    return (normal.dot(loop[0]) - normal.head<2>().dot(at)) / normal.z();
  }
  return std::nullopt;
}

// Crowns, with all their leaves, keep out of walls, and of what stands out of them.
TEST_P(Towns, NoLeafGrowsIntoAHouse) {
  for (int seed = 0; seed < 5; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    CityModel model;
    AddOccluders(town, model);
    const Scene& scene = model.scene;
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
      if (!scene.elements[scene.elements_of[i]].starts_with("occluder/tree")) continue;
      const Eigen::Vector2d at = scene.positions[scene.triangles[i][0]].head<2>().cast<double>();
      for (const House& house : town.houses) {
        const double room = HasBalconies(house) ? 1.5 : 0;
        ASSERT_FALSE(stucco::Contains(house.outline, at)) << seed << " " << house.id;
        ASSERT_GT(DistanceToOutline(house.outline, at), room) << seed << " " << house.id;
      }
    }
  }
}

Polygon OutlineOf(const Car& car) {
  return Placed(Rectangle(kCarLength_m, kCarWidth_m), car.heading_rad, car.position);
}

TEST_P(Towns, CarsAndTreesStandFree) {
  for (int seed = 0; seed < 100; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    EXPECT_FALSE(town.trees.empty());
    for (const House& house : town.houses) {
      for (const Tree& tree : town.trees) {
        ASSERT_FALSE(stucco::Contains(house.outline, tree.position)) << seed;
      }
      for (const Car& car : town.cars) {
        ASSERT_GT(Gap(OutlineOf(car), house.outline), 0.5) << seed;
      }
    }
    for (size_t i = 0; i < town.cars.size(); ++i) {
      const Polygon car = OutlineOf(town.cars[i]);
      for (size_t j = 0; j < i; ++j) ASSERT_GT(Gap(car, OutlineOf(town.cars[j])), 0.2) << seed;
      for (const Tree& tree : town.trees) {
        ASSERT_FALSE(stucco::Contains(car, tree.position)) << seed;
        ASSERT_GT(DistanceToOutline(car, tree.position), 0.3) << seed << ": in a trunk";
      }
    }
  }
}

// The planner reads every map as the town that it was written for.
TEST_P(Towns, EveryFreeWallIsAFacadeOfTheMap) {
  const test::TemporaryFolder folder;
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 50;
  georef.origin_longitude_deg = 14;
  georef.origin_height_m = 200;
  georef.metric = true;
  const int seeds = GetParam() == "terrain" ? kSeedsOfMaps / 8 : kSeedsOfMaps;  // a raster each
  for (int seed = 0; seed < seeds; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    WriteMap(town, georef, folder / "map.geojson");
    std::optional<std::filesystem::path> terrain;
    if (!town.relief.IsFlat()) {
      terrain = folder / "terrain.tif";
      WriteTerrain(town, georef, *terrain);
    }
    const FacadeIds ids = FindFacades(town, georef, folder / "map.geojson", terrain);
    std::set<std::string> all;
    for (size_t i = 0; i < town.houses.size(); ++i) {
      for (size_t edge = 0; edge < ids[i].size(); ++edge) {
        const std::string& id = ids[i][edge];
        ASSERT_EQ(id.empty(), town.houses[i].party[edge]) << seed;
        ASSERT_TRUE(id.empty() || all.insert(id).second) << seed;
      }
    }
  }
}

// Behind a corner the next wall has recesses of its own.
TEST(Town, LoggiasKeepAwayFromTheCorners) {
  constexpr double kDeepest_m = 1.5 + 0.4;
  int loggias = 0;
  for (int seed = 0; seed < kSeedsOfDesigns; ++seed) {
    for (const House& house : LayOutTown("asia", seed).houses) {
      const std::vector<OutlineEdge> edges = EdgesOf(house.outline);
      for (int edge = 0; edge < static_cast<int>(edges.size()); ++edge) {
        const double width = (edges[edge].b - edges[edge].a).norm();
        for (const WallPart& part : DesignWall(house, {edge, width, house.eaves_m(), 0}).parts) {
          if (part.relief_m > -0.5) continue;
          ++loggias;
          ASSERT_GT(part.top_left.x(), kDeepest_m) << seed << " " << house.id;
          ASSERT_LT(part.bottom_right.x(), width - kDeepest_m) << seed << " " << house.id;
        }
      }
    }
  }
  EXPECT_GT(loggias, 1000);
}

// Chimneys are smoked through: their tops stand above the roof at all their corners, and not higher
// above the ridge than drones are told to keep away.
TEST_P(Towns, ChimneysStandAboveTheirRoofs) {
  for (int seed = 0; seed < kSeedsOfDesigns; ++seed) {
    for (const House& house : LayOutTown(GetParam(), seed).houses) {
      if (house.roof == RoofShape::kFlat) continue;
      const Solid solid = SolidOf(house);
      CityModel model;
      AddRoofThings(house, solid, {}, model);
      double ridge = 0;
      for (const Eigen::Vector3d& vertex : solid.vertices) ridge = std::max(ridge, vertex.z());
      for (const Eigen::Vector3i& triangle : model.scene.triangles) {
        std::array<Eigen::Vector3d, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = model.scene.positions[triangle[k]].cast<double>();
        if (p[0].z() != p[1].z() || p[1].z() != p[2].z()) continue;  // not the top
        ASSERT_LT(p[0].z(), ridge + 0.8 + 1e-4) << seed << " " << house.id;
        for (const Eigen::Vector3d& corner : p) {
          const auto roof = RoofOver(solid, corner.head<2>());
          ASSERT_TRUE(roof) << seed << " " << house.id << ": beside the roof";
          ASSERT_GT(corner.z(), *roof + 0.5) << seed << " " << house.id;
        }
      }
    }
  }
}

// Fields begin behind the town, and only a street that runs from one of its edges to the other goes
// on through them, as low as it lies within.
TEST_P(Towns, StreetsDoNotEndInTheFields) {
  for (int seed = 0; seed < 20; ++seed) {
    const Town town = LayOutTown(GetParam(), seed);
    const GroundGrid grid = MakeGroundGrid(town);
    const int patches = static_cast<int>(town.ground.size());
    std::set<int> fields;
    std::set<int> streets;
    std::set<int> parcels;
    for (const int patch : grid.patch_of) {
      if (patch >= 2 * patches + kFieldKinds) {
        parcels.insert(patch - 2 * patches - kFieldKinds);
      } else if (patch >= patches + kFieldKinds) {
        streets.insert(patch - patches - kFieldKinds);
      } else if (patch >= patches) {
        fields.insert(patch);
      }
    }
    EXPECT_GT(fields.size(), 1u) << seed;
    EXPECT_EQ(parcels.size(), 8u) << seed;
    const bool crossed = GetParam() != "block" && GetParam() != "asia";
    ASSERT_EQ(streets.size(), crossed ? 1u : 0u) << seed;
    for (const int street : streets) {
      EXPECT_EQ(town.ground[street].covering, Covering::kAsphalt);
      EXPECT_LT(town.ground[street].raise_m, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, Towns, testing::ValuesIn(CityStyles()),
                         [](const auto& test) { return test.param; });

// The picture of a facade shows the design that its relief was built from.
TEST(Town, PicturesOfFacadesShowWhatWasBuilt) {
  constexpr double kTexel_m = 0.05;
  const House house = LayOutTown("hamlet", 4).houses[0];
  std::vector<std::string> facades(house.party.size());
  for (size_t i = 0; i < facades.size(); ++i) facades[i] = "F" + std::to_string(i);
  CityModel model;
  TextureSet truth;
  AddHouse(house, facades, kTexel_m, model, truth);
  const Solid solid = SolidOf(house);
  size_t openings = 0;
  for (const Solid::Face& face : solid.faces) {
    if (face.facet_class != FacetClass::kWall) continue;
    Loop wall = Corners(solid, face.outer);
    const double parapet = house.roof == RoofShape::kFlat ? house.parapet_m : 0;
    const double eaves = wall[2].z() + parapet;
    const double top = wall.size() == 5 ? wall[3].z() : eaves;
    const WallDesign design =
        DesignWall(house, {face.edge, (wall[1] - wall[0]).norm(), top, top - eaves});
    const std::string& id = facades[face.edge];
    const auto picture =
        std::find_if(model.pictures.begin(), model.pictures.end(),
                     [&](const PictureJob& job) { return job.truth_file == id + ".jpg"; });
    ASSERT_NE(picture, model.pictures.end()) << id;
    EXPECT_EQ(picture->paint().data, PaintWall(design, kTexel_m).data) << id;
    openings += design.parts.size();
  }
  EXPECT_GT(openings, 4u);
}

// Mean difference of a picture's columns at a and b.
double Step(const Image& image, int a, int b) {
  double sum = 0;
  for (int y = 0; y < image.height_px; ++y) {
    for (int c = 0; c < 3; ++c) sum += std::abs(image.Pixel(a, y)[c] - image.Pixel(b, y)[c]);
  }
  return sum / (3.0 * image.height_px);
}

TEST(Town, PicturesOfFieldsGoOnWhereTheyEnd) {
  const Town town = LayOutTown("hamlet", 3);
  CityModel model;
  AddGround(town, MakeGroundGrid(town), 0.25, model);
  int fields = 0;
  for (const Material& material : model.scene.materials) {
    if (!material.name.starts_with("field-")) continue;
    ++fields;
    const Image image = model.pictures[material.texture].paint();
    const int last = image.width_px - 1;
    double most = 0;
    for (int x = 0; x < last; ++x) most = std::max(most, Step(image, x, x + 1));
    EXPECT_LE(Step(image, last, 0), most) << material.name;
    EXPECT_GT(Step(image, last / 2, 0), 1.5 * Step(image, last, 0)) << material.name << " varies";
  }
  EXPECT_EQ(fields, kFieldKinds);
}

// A photo that shows nothing but a field must not find it again in the next one.
TEST(Town, FieldsNextToItAreAllDifferent) {
  const Town town = LayOutTown("hamlet", 3);
  const GroundGrid grid = MakeGroundGrid(town);
  CityModel model;
  AddGround(town, grid, 0.5, model);
  std::vector<Image> pictures;
  for (const Material& material : model.scene.materials) {
    if (material.name.starts_with("parcel-")) {
      pictures.push_back(model.pictures[material.texture].paint());
    }
  }
  ASSERT_EQ(pictures.size(), grid.parcels.size());
  for (size_t i = 0; i < pictures.size(); ++i) {
    const Eigen::Vector2d size = grid.parcels[i].high - grid.parcels[i].low;
    EXPECT_NEAR(pictures[i].width_px, size.x() / 0.5, 2) << "its whole width: nothing repeats";
    EXPECT_NEAR(pictures[i].height_px, size.y() / 0.5, 2);
    for (size_t j = 0; j < i; ++j) EXPECT_NE(pictures[i].data, pictures[j].data);
  }
}

TEST(Town, UnknownStyleIsRefusedWithTheKnownOnes) {
  const Error error = test::ErrorOf([] { LayOutTown("castle", 1); });
  EXPECT_EQ(error.kind(), ErrorKind::kUsage);
  EXPECT_NE(error.remedy().find("hamlet, block"), std::string::npos);
}

TEST(Town, BlockHasPartyWallsAndACourtyard) {
  const Town town = LayOutTown("block", 3);
  int party = 0;
  for (const House& house : town.houses) {
    party += static_cast<int>(std::count(house.party.begin(), house.party.end(), true));
  }
  EXPECT_GE(party, 12);
  EXPECT_EQ(party % 2, 0);
}

TEST(Town, TerrainSlopesByMetres) {
  const Town town = LayOutTown("terrain", 3);
  double low = 1e9;
  double high = -1e9;
  for (const House& house : town.houses) {
    low = std::min(low, house.base_m);
    high = std::max(high, house.base_m);
    EXPECT_GT(house.floor_m, house.base_m + 0.2);
  }
  EXPECT_GT(high - low, 2);
}

}  // namespace
}  // namespace stucco::simulate
