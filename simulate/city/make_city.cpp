// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/make_city.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "simulate/city/buried.h"
#include "simulate/city/city_model.h"
#include "simulate/city/ground.h"
#include "simulate/city/house_mesh.h"
#include "simulate/city/later_day.h"
#include "simulate/city/lay_out_town.h"
#include "simulate/city/occluders.h"
#include "simulate/city/town.h"
#include "simulate/city/town_map.h"
#include "simulate/scene/internal/glb.h"
#include "simulate/scene/scene_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/parallel.h"
#include "survey/texture_set.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;

// Pictures of walls and roofs together: whoever draws the scene keeps them in memory, with mip maps
// four bytes a texel. Towers exceed it; their texels become larger.
constexpr double kMostTexels = 2e8;

Georef GeorefOf(const CityOptions& options) {
  return {.frame = "enu",
          .origin_latitude_deg = options.latitude_deg,
          .origin_longitude_deg = options.longitude_deg,
          .origin_height_m = options.height_m,
          .up = Eigen::Vector3d::UnitZ(),
          .metric = true,
          .source = "scene"};
}

void Check(const CityOptions& options) {
  const auto require = [](bool fine, const std::string& what) {
    if (!fine) throw Error(ErrorKind::kUsage, what);
  };
  require(options.metres_per_texel >= 0.002 && options.metres_per_texel <= 1,
          "the texel of walls must be 0.002 to 1 m");
  require(options.day >= 1 && options.day <= 1000, "the day must be 1 to 1000");
  // Towards the poles a step of longitude is too short to write.
  require(std::abs(options.latitude_deg) <= 85, "the latitude must be -85 to 85 degrees");
  // A map must not cross the line where longitudes jump.
  require(std::abs(options.longitude_deg) <= 179.9,
          "the longitude must be -179.9 to 179.9 degrees");
  require(std::abs(options.height_m) <= 9000, "the height must be -9000 to 9000 m");
}

// What the textures of an older truth name; nothing where they cannot be read.
std::vector<fs::path> OldPictures(const fs::path& folder) {
  std::vector<fs::path> names;
  try {
    for (const TexturedFacet& facet : ReadTextureSet(folder / kTruthTextures).facets) {
      names.push_back(fs::path(facet.image).filename());
    }
  } catch (const Error&) {
    names.clear();
  }
  return names;
}

// The model goes first and comes back last: a folder that is made only in part has none.
void RemoveOldScene(const fs::path& folder) {
  std::error_code error;
  fs::remove(folder / kSceneModel, error);
  if (error) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: cannot be replaced: {}", (folder / kSceneModel).string(), error.message()),
        "give a folder that can be written");
  }
  for (const fs::path& name : OldPictures(folder)) {
    if (!name.empty()) fs::remove(folder / "truth" / "textures" / name, error);
  }
  fs::remove(folder / kSceneTerrain, error);
  fs::remove(folder / kTruthChanges, error);
}

// Makes the folder, or clears an old scene out of it; files of the user's own stay.
void PrepareFolder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is a file", folder.string()),
                "give the name of a folder");
  }
  const bool is_scene = fs::exists(folder / kSceneFile, error);
  if (!is_scene && fs::is_directory(folder, error) && !fs::is_empty(folder, error)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is there already and no scene", folder.string()),
                "give another folder; nothing in it was changed");
  }
  if (is_scene) RemoveOldScene(folder);
  error.clear();
  fs::create_directories(folder / "truth" / "textures", error);
  if (error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be made: {}", folder.string(), error.message()),
                "give a folder that can be written");
  }
}

double SeenArea(const Proxy& truth, FacetClass facet_class) {
  double area = 0;
  for (const Building& building : truth.buildings) {
    for (const Facet& facet : building.facets) {
      if (facet.facet_class == facet_class && facet.seen > 0) area += facet.area;
    }
  }
  return area;
}

// Walls start at the lowest ground under their house: on a slope they are partly in the ground.
void MarkBuried(const Town& town, const GroundGrid& grid, Building& building) {
  for (Facet& facet : building.facets) {
    if (facet.facet_class != FacetClass::kWall || facet.seen == 0) continue;
    const double foot = facet.outer[0].z();
    const double buried =
        BuriedArea(town, grid, facet.outer[0].head<2>(), facet.outer[1].head<2>(), foot);
    facet.inferred = buried / facet.area;
    facet.seen = 1 - facet.inferred;
  }
}

Proxy TruthOf(const Town& town, const FacadeIds& facades, const GroundGrid& grid) {
  Proxy proxy;
  proxy.metric = true;
  for (size_t i = 0; i < town.houses.size(); ++i) {
    const House& house = town.houses[i];
    proxy.buildings.push_back(TruthOf(house, SolidOf(house), facades[i]));
    MarkBuried(town, grid, proxy.buildings.back());
  }
  proxy.buildings.push_back({"G0", false, "model", "", GroundFacets(town, grid)});
  if (const auto problem = FindProblem(proxy)) {
    throw Error(ErrorKind::kStageFailed, fmt::format("the truth is not sound: {}", *problem));
  }
  return proxy;
}

// Paints and encodes a picture at a time on each thread: only encoded ones are kept.
std::vector<GlbTexture> PaintAll(const CityModel& model, int threads, const fs::path& folder) {
  std::vector<GlbTexture> pictures(model.pictures.size());
  ParallelFor(pictures.size(), threads, [&](size_t i) {
    pictures[i] = internal::EncodeForGlb(model.pictures[i].paint());
    const std::string& name = model.pictures[i].truth_file;
    if (!name.empty()) WriteFile(folder / "truth" / "textures" / name, pictures[i].bytes);
  });
  return pictures;
}

}  // namespace

CitySummary MakeCity(const CityOptions& options, const fs::path& scene_folder) {
  Check(options);
  Town town = LayOutTown(options.style, options.seed);
  for (House& house : town.houses) house.repeats = options.repeat;
  const bool sloping = !town.relief.IsFlat();
  PrepareFolder(scene_folder);
  const Georef georef = GeorefOf(options);
  WriteSceneInfo({options.style, options.seed, options.day, georef, /*has_truth=*/true, sloping},
                 scene_folder);
  WriteMap(town, georef, scene_folder / kSceneMap);
  std::optional<fs::path> terrain;
  if (sloping) {
    terrain = scene_folder / kSceneTerrain;
    WriteTerrain(town, georef, *terrain);
  }
  const FacadeIds facades = FindFacades(town, georef, scene_folder / kSceneMap, terrain);

  CitySummary summary;
  summary.changes = LiveUntil(options.day, facades, town);
  if (options.day > 1) WriteDayChanges(summary.changes, options.day, scene_folder);

  const GroundGrid grid = MakeGroundGrid(town);
  const Proxy truth = TruthOf(town, facades, grid);
  WriteProxy(truth, scene_folder / kTruthFacets);
  const double walls_m2 = SeenArea(truth, FacetClass::kWall);
  const double texel =
      std::max(options.metres_per_texel,
               std::sqrt((walls_m2 + SeenArea(truth, FacetClass::kRoof)) / kMostTexels));
  CityModel model;
  TextureSet textures;
  for (size_t i = 0; i < town.houses.size(); ++i) {
    AddHouse(town.houses[i], facades[i], texel, model, textures);
  }
  AddGround(town, grid, options.metres_per_texel, model);
  AddOccluders(town, model);
  WriteTextureSet(textures, scene_folder / kTruthTextures);
  const int threads = options.threads > 0 ? options.threads : std::numeric_limits<int>::max();
  internal::WriteGlbFile(model.scene, PaintAll(model, threads, scene_folder),
                         scene_folder / kSceneModel);

  summary.buildings = static_cast<int>(town.houses.size());
  for (const auto& ids : facades) {
    summary.facades += static_cast<int>(
        std::count_if(ids.begin(), ids.end(), [](const auto& id) { return !id.empty(); }));
  }
  summary.triangles = static_cast<int>(model.scene.triangles.size());
  summary.wall_area_m2 = walls_m2;
  return summary;
}

}  // namespace stucco::simulate
