// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "simulate/flight/flight_folder.h"
#include "simulate/scene/scene_folder.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// What is known about a scene and a flight through it.
struct Truth {
  simulate::SceneInfo info;
  Proxy facets;
  simulate::Flight flight;
};

// `flight` is the survey folder with truth/flight.json. Throws Error (kBadInput): no truth in one
// of the folders, of another version, or the flight was flown in another scene.
Truth ReadTruth(const std::filesystem::path& scene, const std::filesystem::path& flight);

}  // namespace stucco::evaluate
