// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "simulate/scene/scene_folder.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco::simulate {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

}  // namespace

SceneInfo ReadSceneInfo(const std::filesystem::path& path) {
  std::error_code ignored;
  SceneInfo info;
  if (!std::filesystem::is_directory(path, ignored)) {
    if (std::filesystem::exists(path, ignored)) return info;
    throw Error(ErrorKind::kBadInput, fmt::format("{}: no such scene", path.string()),
                "give a scene folder or a model; `stucco simulate city -o SCENE` makes one");
  }
  const std::filesystem::path file = path / kSceneFile;
  if (!std::filesystem::exists(file, ignored)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no scene folder: it has no {}", path.string(), kSceneFile),
                "give a scene folder or a model; `stucco simulate city -o SCENE` makes one");
  }
  try {
    const Json json = Json::parse(ReadFile(file));
    const int version = json.at("version");
    if (version != kVersion) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: has version {}, not {}", file.string(), version, kVersion),
                  "make the scene again with this program");
    }
    json.at("style").get_to(info.style);
    json.at("seed").get_to(info.seed);
    info.day = json.value("day", 1);
    json.at("has_truth").get_to(info.has_truth);
    json.at("has_terrain").get_to(info.has_terrain);
    json.at("frame").get_to(info.georef.frame);
    if (info.georef.frame == "enu") {
      const Json& origin = json.at("origin");
      origin.at("latitude_deg").get_to(info.georef.origin_latitude_deg);
      origin.at("longitude_deg").get_to(info.georef.origin_longitude_deg);
      origin.at("height_m").get_to(info.georef.origin_height_m);
      info.georef.up = Eigen::Vector3d::UnitZ();
      info.georef.metric = true;
    }
    info.georef.source = "scene";
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file.string(), error.what()),
                "make the scene again");
  }
  return info;
}

void WriteSceneInfo(const SceneInfo& info, const std::filesystem::path& scene_folder) {
  Json json = {{"version", kVersion},
               {"style", info.style},
               {"seed", info.seed},
               {"day", info.day},
               {"frame", info.georef.frame}};
  if (info.georef.frame == "enu") {
    json["origin"] = {{"latitude_deg", info.georef.origin_latitude_deg},
                      {"longitude_deg", info.georef.origin_longitude_deg},
                      {"height_m", info.georef.origin_height_m}};
  }
  json["has_truth"] = info.has_truth;
  json["has_terrain"] = info.has_terrain;
  WriteFileAtomically(scene_folder / kSceneFile, json.dump(2) + "\n");
}

void WriteDayChanges(const DayChanges& changes, int day,
                     const std::filesystem::path& scene_folder) {
  const Json json = {{"version", kVersion},
                     {"day", day},
                     {"repainted", changes.repainted},
                     {"gone", changes.gone},
                     {"come", changes.come}};
  WriteFileAtomically(scene_folder / kTruthChanges, json.dump(2) + "\n");
}

}  // namespace stucco::simulate
