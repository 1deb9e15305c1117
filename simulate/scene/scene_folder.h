// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "simulate/scene/scene.h"
#include "survey/georef.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco::simulate {

// A scene on disk (docs/formats.md):
//   scene.json   version, where it lies, how it was made
//   scene.glb    everything that a camera sees (glTF is y up: x east, y up, z south)
//   map.geojson  footprints with heights, for `stucco plan`
//   terrain.tif  heights of the ground, where it is not flat
//   truth/facets.json    walls, roofs and ground as exact planar polygons, a Proxy; walls have the
//                        ids that the planner gives to the map's facades
//   truth/textures.json  their pictures at 1 cm, a TextureSet; images in truth/textures/
//   truth/changes.json   of a later day: what is not as on the first
inline constexpr char kSceneFile[] = "scene.json";
inline constexpr char kSceneModel[] = "scene.glb";
inline constexpr char kSceneMap[] = "map.geojson";
inline constexpr char kSceneTerrain[] = "terrain.tif";
inline constexpr char kTruthFacets[] = "truth/facets.json";
inline constexpr char kTruthTextures[] = "truth/textures.json";
inline constexpr char kTruthChanges[] = "truth/changes.json";

// Things of a scene that are no buildings and no ground: what hides facades.
inline constexpr char kOccluderPrefix[] = "occluder/";  // of element names: "occluder/tree-003"

struct SceneInfo {
  std::string style;  // hamlet, block, ...; empty for a model from elsewhere
  uint64_t seed = 0;
  int day = 1;
  // Frame "enu": the scene's axes at its origin; heights are z plus origin_height_m. A model from
  // elsewhere has "arbitrary".
  Georef georef;
  bool has_truth = false;
  bool has_terrain = false;
};

// Reads SCENE/scene.json, or, where `path` is a model (GLB, glTF, OBJ ...), says that nothing is
// known about it. Throws Error (kBadInput).
SceneInfo ReadSceneInfo(const std::filesystem::path& path);
void WriteSceneInfo(const SceneInfo& info, const std::filesystem::path& scene_folder);

// What is not as on the first day: elements of the model.
struct DayChanges {
  std::vector<std::string> repainted;  // facades
  std::vector<std::string> gone;       // cars
  std::vector<std::string> come;
};

// Writes truth/changes.json.
void WriteDayChanges(const DayChanges& changes, int day, const std::filesystem::path& scene_folder);

enum class UpAxis { kByFormat, kY, kZ };  // glTF: y. OBJ: y unless told

struct ModelReading {
  UpAxis up = UpAxis::kByFormat;
  double unit_m = 1;  // metres in one unit of the file
};

// The model of a scene folder, or the model that `path` is. Throws Error (kBadInput): no such
// scene.
std::filesystem::path ModelFile(const std::filesystem::path& path);

// The model of a scene folder, or a model file, through assimp, with all its pictures. Throws Error
// (kBadInput): no such file, no triangles, a picture missing or damaged, not finite.
Scene ReadScene(const std::filesystem::path& path, const ModelReading& reading = {});

// Of all in a scene that its pictures depend on, texels too.
std::string HashScene(const Scene& scene);

// GLB with its pictures inside (JPEG where they have three channels, PNG with alpha).
void WriteGlb(const Scene& scene, const std::filesystem::path& path);

}  // namespace stucco::simulate
