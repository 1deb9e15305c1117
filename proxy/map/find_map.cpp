// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/find_map.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "proxy/map/ground_around.h"
#include "survey/median.h"

namespace stucco {
namespace {

// What the plan's heights are in the survey: by the ground around its buildings.
double HeightShift(const UprightSurvey& survey, std::span<const MapBuilding> buildings) {
  std::vector<double> shifts, feet, heights;
  for (const MapBuilding& building : buildings) {
    feet.push_back(building.z_m.from_m);
    const auto ground = GroundAround(survey, building);
    if (ground) shifts.push_back(*ground - building.z_m.from_m);
  }
  if (const auto shift = Median(shifts)) return *shift;
  // Without any ground the lowest of what is seen is nearest to it.
  constexpr double kLowest = 0.02;
  for (const auto& p : survey.samples.positions) heights.push_back(p.z());
  if (heights.empty()) return 0;
  std::sort(heights.begin(), heights.end());
  return heights[static_cast<size_t>(kLowest * static_cast<double>(heights.size()))] -
         Median(feet).value_or(0);
}

PlaceOfMap PlaceIn(const UprightSurvey& survey, const OutlineMap& map) {
  PlaceOfMap place{.registration = RegisterMap(survey, map)};
  if (place.registration.refused.empty()) {
    const OutlineMap found = Moved(map, place.registration.survey_from_map);
    place.plan_to_survey_m = HeightShift(survey, found.buildings);
  }
  return place;
}

// Buildings here and there of a map, in sets of neighbours, of which a closer look shows about as
// many samples as it may.
OutlineMap SomeOf(const UprightSurvey& survey, const OutlineMap& map, int max_points) {
  constexpr int kPlaces = 8;
  const auto sets = SetsOfBuildings(survey, map.buildings, max_points / (2 * kPlaces));
  const size_t places = std::min<size_t>(kPlaces, sets.size());
  OutlineMap some;
  std::set<std::string> ids;
  for (size_t i = 0; i < places; ++i) {
    for (const size_t b : sets[i * sets.size() / places].members) {
      some.buildings.push_back(map.buildings[b]);
      ids.insert(map.buildings[b].id);
    }
  }
  std::ranges::copy_if(map.facades, std::back_inserter(some.facades),
                       [&](const Facade& facade) { return ids.contains(BuildingOf(facade)); });
  return some;
}

}  // namespace

OutlineMap Moved(OutlineMap map, const Eigen::Isometry2d& motion) {
  for (MapBuilding& building : map.buildings) building = Moved(building, motion);
  for (Facade& facade : map.facades) {
    facade.a = motion * facade.a;
    facade.b = motion * facade.b;
  }
  return map;
}

PlaceOfMap FindMap(const UprightSurvey& survey, const OutlineMap& map, const MapSearch& with) {
  constexpr double kCoarse_m = 0.5;
  if (!with.cloud || survey.samples.cell < kCoarse_m) return PlaceIn(survey, map);
  const OutlineMap some = SomeOf(survey, map, with.options.max_points);
  constexpr double kAsFarAsMapsLieOff_m = 10;
  std::vector<MapBuilding> places = some.buildings;
  for (MapBuilding& place : places) {
    const Eigen::AlignedBox2d box = BoundsOf(place, kAsFarAsMapsLieOff_m);
    place.parts = {
        {{{box.min(), {box.max().x(), box.min().y()}, box.max(), {box.min().x(), box.max().y()}}}}};
  }
  return PlaceIn(CloserLook(with.scene, *with.cloud, places, with.options, with.threads), some);
}

}  // namespace stucco
