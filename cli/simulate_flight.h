// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/program.h"

namespace stucco {

// `stucco simulate SCENE PLAN -o SURVEY`, as typed.
struct FlightArguments {
  std::string scene;
  std::string plan;
  std::string survey;
  std::vector<std::string> set;  // options of the flight, "gps_sigma_m=0.2"
  std::string up = "format";
  double unit_m = 1;
};

// The options of the flight but its seed, which cities have as well; values end up in `set`.
void AddFlightOptions(CLI::App& verb, FlightArguments& arguments);

// Flies, and prints what was done.
int SimulateFlight(const FlightArguments& arguments, const Program& program);

}  // namespace stucco
