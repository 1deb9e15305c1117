// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/safe_altitude.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "survey/error.h"

namespace stucco::plan {
namespace {

// What roofs and old storeys may add to a guess.
constexpr double kAboveGuess_m = 5;

struct Tall {
  double height_m = 0;
  std::string name;  // "building B0007"
  bool is_obstacle = false;
};

// What the map says about the heights of buildings.
struct Heights {
  Tall tallest;  // known, or at least as high: the underside of a part
  size_t buildings = 0;
  size_t unknown = 0;  // buildings with a top that is not known
  std::string first_unknown;
  size_t guessed = 0;  // of these, all of whose unknown tops are guessed
  Tall guess;          // the highest
};

bool IsGuessed(const Footprint& footprint) {
  return !footprint.top_known && footprint.z_m.to_m > footprint.z_m.from_m;
}

Heights HeightsOf(const HighThings& things) {
  struct Tops {
    bool known = true;
    bool guessed = true;
  };
  Heights heights;
  std::map<std::string, Tops> buildings;
  for (const Footprint& footprint : things.footprints) {
    Tops& tops = buildings[footprint.building];
    tops.known = tops.known && footprint.top_known;
    tops.guessed = tops.guessed && (footprint.top_known || IsGuessed(footprint));
    const std::string name = "building " + footprint.building;
    const double least = footprint.top_known ? footprint.z_m.to_m : footprint.z_m.from_m;
    if (least > heights.tallest.height_m) heights.tallest = {least, name};
    if (IsGuessed(footprint) && footprint.z_m.to_m > heights.guess.height_m) {
      heights.guess = {footprint.z_m.to_m, name};
    }
  }
  heights.buildings = buildings.size();
  for (const auto& [name, tops] : buildings) {
    if (tops.known) continue;
    if (heights.unknown == 0) heights.first_unknown = name;
    ++heights.unknown;
    if (tops.guessed) ++heights.guessed;
  }
  for (const MapObstacle& obstacle : things.obstacles) {
    if (!(obstacle.height_m.value_or(0) > heights.tallest.height_m)) continue;
    heights.tallest = {*obstacle.height_m, "obstacle " + obstacle.id, true};
  }
  return heights;
}

// The first of the heights that the map has and nobody can use, as " (B0001: height ...)".
std::string UnusableHeights(const RepairLog& repairs) {
  for (const std::string& line : repairs.Lines()) {
    if (line.find(": height ") != std::string::npos) return fmt::format(" ({})", line);
  }
  return "";
}

// The next multiple of five metres.
double RoundedUp(double height_m) {
  constexpr double kStep_m = 5;
  return kStep_m * std::ceil(height_m / kStep_m);
}

[[noreturn]] void FailWithoutHeights(const HighThings& things, const Heights& heights,
                                     double d_min_m, const RepairLog& repairs) {
  std::string what = fmt::format(
      "{}: {} of {} buildings have no height{}, so that a safe altitude cannot be told",
      things.map.string(), heights.unknown, heights.buildings,
      heights.unknown < heights.buildings ? fmt::format(" or 0, {} first", heights.first_unknown)
                                          : "");
  std::string example = "60";
  std::string hint;
  if (heights.guessed > 0) {
    what += fmt::format(
        "; {} of them have a number of storeys (building:levels), which is a guess "
        "that no flight may rely on",
        heights.guessed);
    example = fmt::format("{:.0f}", RoundedUp(std::max(heights.tallest.height_m,
                                                       heights.guess.height_m + kAboveGuess_m) +
                                              d_min_m));
    hint = fmt::format("; {} suggests {}, check it on the site", heights.guess.name, example);
  }
  throw Error(
      ErrorKind::kBadInput, what + UnusableHeights(repairs),
      fmt::format("give the safe altitude, as --altitude {} (metres above the ground, d_min "
                  "above the highest roof{}), or name the attribute with the heights: "
                  "--height-field NAME",
                  example, hint));
}

void CheckUnits(const HighThings& things, const Tall& tallest, double d_min_m) {
  if (tallest.height_m + d_min_m <= kMostAltitude_m) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}{} is {:.1f} m high, and {:g} m above it is more than the highest safe "
                  "altitude of {:g} m",
                  tallest.is_obstacle ? "" : things.map.string() + ": ", tallest.name,
                  tallest.height_m, d_min_m, kMostAltitude_m),
      "check the unit of the height attribute (metres are read unless it says ft), or "
      "name another: --height-field NAME");
}

double LowestAltitude(const HighThings& things, const Heights& heights, const PlanOptions& options,
                      const RepairLog& repairs) {
  if (heights.unknown > 0) FailWithoutHeights(things, heights, options.d_min_m, repairs);
  const auto without = std::ranges::count_if(
      things.obstacles, [](const MapObstacle& obstacle) { return !obstacle.height_m; });
  if (without > 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{} of {} obstacles have no height, so that a safe altitude cannot be "
                            "told",
                            without, things.obstacles.size()),
                "give them heights, or the safe altitude above all of them, as --altitude 60, or "
                "put them into --no-fly, over which nothing flies");
  }
  return std::max(heights.tallest.height_m + options.d_min_m, options.min_altitude_m);
}

}  // namespace

double SafeAltitude(const HighThings& things, const PlanOptions& options,
                    const RepairLog& repairs) {
  const Heights heights = HeightsOf(things);
  const Tall& tallest = heights.tallest;
  CheckUnits(things, tallest, options.d_min_m);
  if (options.altitude_m == 0) return LowestAltitude(things, heights, options, repairs);
  if (options.altitude_m < std::max(options.min_altitude_m, options.d_min_m)) {
    throw Error(
        ErrorKind::kUsage,
        fmt::format("--altitude {:g}: is lower than the lowest flight ({:g} m) or the distance to "
                    "buildings ({:g} m)",
                    options.altitude_m, options.min_altitude_m, options.d_min_m),
        "give a higher safe altitude");
  }
  if (options.altitude_m < tallest.height_m + options.d_min_m) {
    throw Error(
        ErrorKind::kUsage,
        fmt::format("--altitude {:g}: {} is {:.1f} m high, and {:g} m are to be kept from it",
                    options.altitude_m, tallest.name, tallest.height_m, options.d_min_m),
        fmt::format("give at least --altitude {:.0f}, or correct the height in the map{}",
                    std::ceil(tallest.height_m + options.d_min_m),
                    tallest.is_obstacle ? ", or put it into --no-fly instead" : ""));
  }
  return options.altitude_m;
}

std::vector<std::string> AltitudeWarnings(const HighThings& things, double safe_altitude_m,
                                          double d_min_m) {
  const Heights heights = HeightsOf(things);
  std::vector<std::string> lines;
  if (heights.unknown > 0) {
    lines.push_back(fmt::format(
        "{} of {} buildings have no known height{}: the plan rests on your word that {:g} m above "
        "the ground is {:g} m above their highest roofs and masts",
        heights.unknown, heights.buildings,
        heights.guessed > 0 ? fmt::format(" ({} a number of storeys only)", heights.guessed) : "",
        safe_altitude_m, d_min_m));
  }
  if (heights.guess.height_m + d_min_m > safe_altitude_m) {
    lines.push_back(
        fmt::format("the storeys of {} suggest up to {:.0f} m: check that a safe altitude "
                    "of {:g} m is enough",
                    heights.guess.name, heights.guess.height_m, safe_altitude_m));
  }
  return lines;
}

}  // namespace stucco::plan
