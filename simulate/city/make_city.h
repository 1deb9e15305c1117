// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "simulate/scene/scene_folder.h"

namespace stucco::simulate {

struct CityOptions {
  std::string style = "hamlet";  // one of CityStyles()
  uint64_t seed = 1;
  int day = 1;                     // of a later one some things have changed: LiveUntil
  bool repeat = false;             // every bay of a wall looks the same, to the texel
  double metres_per_texel = 0.01;  // of walls and roofs
  double latitude_deg = 50.0875;   // of the origin
  double longitude_deg = 14.4213;
  double height_m = 200;  // of z = 0 above the ellipsoid
  int threads = 0;        // 0: all
};

struct CitySummary {
  int buildings = 0;
  int facades = 0;
  int triangles = 0;
  double wall_area_m2 = 0;
  DayChanges changes;  // since the first day
};

// Makes a scene folder (scene_folder.h). The same options give the same bytes. Throws Error (kUsage
// for an unknown style, kOutOfResource).
CitySummary MakeCity(const CityOptions& options, const std::filesystem::path& scene_folder);

}  // namespace stucco::simulate
