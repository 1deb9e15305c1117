// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/map_solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "proxy/map/close_building.h"
#include "proxy/map/closer_look.h"
#include "proxy/map/find_map.h"
#include "proxy/map/judge_found.h"
#include "proxy/map/off_the_map.h"
#include "proxy/map/outline_fit.h"
#include "proxy/map/stable_ids.h"
#include "proxy/map/wings.h"
#include "proxy/solids/party_walls.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

std::string NoteOf(const std::string& id, const ClosedBuilding& closed) {
  size_t walls = 0, seen = 0, roofs = 0;
  for (const Facet& facet : closed.facets) {
    const bool wall = facet.facet_class == FacetClass::kWall;
    walls += wall;
    seen += wall && facet.seen > 0;
    roofs += facet.facet_class == FacetClass::kRoof;
  }
  return fmt::format("{}: closed, {}: {} walls ({} seen), {} roofs from {} planes{}", id,
                     Name(closed.detail), walls, seen, roofs, closed.roof_planes,
                     closed.not_finer.empty() ? "" : ", because " + closed.not_finer);
}

void Report(const std::string& id, const ClosedBuilding& closed, bool to_capture,
            ProxyFindings& findings) {
  if (closed.standing == Standing::kGone) {
    findings.of_map.push_back(
        {id + ": not built, or demolished: the cloud shows the ground where the map has it", true});
  } else if (closed.standing == Standing::kUnseen && !to_capture) {
    findings.notes.push_back(id + ": not seen, and not asked for: left out");
  } else if (closed.facets.empty()) {
    findings.warnings.push_back(
        fmt::format("{}: left out, it does not close: {}", id, closed.not_finer));
  } else {
    findings.notes.push_back(NoteOf(id, closed));
    if (closed.standing == Standing::kUnseen) {
      findings.of_map.push_back(
          {id + ": the cloud shows too little of it: it is as the plan has it", true});
    }
  }
}

// What all buildings of a map are closed with.
struct Workshop {
  const PlanarScene& scene;
  const ProxyInput& input;
  const ProxyOptions& options;
  int threads;
  // To look at parts of the cloud; nothing where all samples are fine enough.
  std::optional<CloudOfPhotos> cloud = std::nullopt;
};

Workshop WorkshopOf(const PlanarScene& scene, const ProxyInput& input, const ProxyOptions& options,
                    int threads) {
  Workshop workshop{scene, input, options, threads};
  if (NeedsCloserLook(scene)) {
    workshop.cloud = CloudOfPhotos{CloudBlocks(input.cloud), input.photos};
  }
  return workshop;
}

// Some buildings and a survey that shows them as finely as their details ask for.
using Look = std::function<void(const UprightSurvey& survey, const SetOfBuildings& set)>;

// All buildings at once; of a large survey the cloud is looked at once more for some of them at a
// time.
void LookAtAll(const UprightSurvey& survey, const std::vector<MapBuilding>& buildings,
               const Workshop& with, const Look& look) {
  if (buildings.empty()) return;
  if (!with.cloud) {
    SetOfBuildings all{.members = std::vector<size_t>(buildings.size())};
    std::iota(all.members.begin(), all.members.end(), size_t{0});
    look(survey, all);
    return;
  }
  constexpr int kAtOnce = 2;  // whatever threads there are: the sets must not depend on them
  ProxyOptions of_set = with.options;
  of_set.max_points /= kAtOnce;
  const auto sets = SetsOfBuildings(survey, buildings, of_set.max_points);
  ParallelFor(sets.size(), std::min(with.threads, kAtOnce), [&](size_t s) {
    std::vector<MapBuilding> of_this;
    for (const size_t b : sets[s].members) of_this.push_back(buildings[b]);
    for (const size_t b : sets[s].beside) of_this.push_back(buildings[b]);
    look(CloserLook(with.scene, *with.cloud, of_this, of_set, with.threads), sets[s]);
  });
}

// Of all buildings of a map that lies where the survey shows it.
std::vector<ClosedBuilding> CloseAll(const UprightSurvey& survey, const OutlineMap& map,
                                     double plan_to_survey_m, const Workshop& with) {
  std::vector<ClosedBuilding> closed(map.buildings.size());
  LookAtAll(survey, map.buildings, with, [&](const UprightSurvey& seen, const SetOfBuildings& set) {
    std::vector<MapBuilding> buildings;
    buildings.reserve(set.members.size() + set.beside.size());
    for (const size_t b : set.members) buildings.push_back(map.buildings[b]);
    for (const size_t b : set.beside) buildings.push_back(map.buildings[b]);
    const auto fitted = FitOutlines(seen, buildings, map.facades, plan_to_survey_m);
    const BuildingCloser closer(seen, with.scene.up, with.options);
    ParallelFor(set.members.size(), with.threads, [&](size_t i) {
      closed[set.members[i]] = closer.Close(buildings[i], fitted[i], plan_to_survey_m);
    });
  });
  return closed;
}

// Of footprints that need no fitting; `mapped` as the map has them.
std::vector<ClosedBuilding> CloseAsFitted(const UprightSurvey& survey,
                                          const std::vector<MapBuilding>& mapped,
                                          const std::vector<FittedBuilding>& fitted,
                                          double plan_to_survey_m, const Workshop& with) {
  std::vector<ClosedBuilding> closed(mapped.size());
  LookAtAll(survey, mapped, with, [&](const UprightSurvey& seen, const SetOfBuildings& set) {
    const BuildingCloser closer(seen, with.scene.up, with.options);
    ParallelFor(set.members.size(), with.threads, [&](size_t i) {
      const size_t b = set.members[i];
      closed[b] = closer.Close(mapped[b], fitted[b], plan_to_survey_m);
    });
  });
  return closed;
}

Building AsBuilding(const std::string& id, const std::string& source,
                    const ClosedBuilding& closed) {
  return {.id = id,
          .watertight = true,
          .source = source,
          .detail = std::string(Name(closed.detail)),
          .facets = closed.facets};
}

// Says where something stands that is not built.
void NoteUnsure(const FittedBuilding& unsure, const Workshop& with, ProxyFindings& findings) {
  const Eigen::AlignedBox2d box = BoundsOf(unsure.building, 0);
  const Eigen::Vector3d middle(box.center().x(), box.center().y(), unsure.ground);
  const Eigen::Vector3d place = UprightFromWorld(with.scene.up).transpose() * middle;
  findings.of_map.push_back(
      {fmt::format("a house seems to stand on no footprint of the map, {:.0f} m2 at {:.0f} m east "
                   "and {:.0f} m north, of whose walls the cloud shows too little to build it: add "
                   "it to the map, or photograph its walls",
                   Area(unsure.building), place.x(), place.y()),
       true});
}

// How much of the walls of new buildings the map's and each other hide: nobody can see these.
void MeasureHidden(std::span<const Building> of_the_map, const Workshop& with,
                   std::vector<ClosedBuilding>& closed) {
  std::vector<Building> all(of_the_map.begin(), of_the_map.end());
  for (const ClosedBuilding& house : closed) all.push_back(AsBuilding("", "cloud", house));
  MeasureParty(with.scene.up, all);
  for (size_t c = 0; c < closed.size(); ++c) {
    closed[c].facets = std::move(all[of_the_map.size() + c].facets);
  }
}

// What the map lacks, closed on footprints of its own.
std::vector<ClosedBuilding> CloseNew(const UprightSurvey& survey,
                                     std::span<const Building> of_the_map, const Workshop& with,
                                     ProxyFindings& findings) {
  const auto footprints = FindNewFootprints(with.scene, survey, of_the_map);
  std::vector<MapBuilding> as_mapped;
  as_mapped.reserve(footprints.size());
  for (const FittedBuilding& footprint : footprints) as_mapped.push_back(footprint.building);
  auto closed = CloseAsFitted(survey, as_mapped, footprints, 0, with);
  MeasureHidden(of_the_map, with, closed);
  const bool shows_walls = !survey.samples.camera_centers.empty();  // a scan from above does not
  std::erase_if(closed, [&](const ClosedBuilding& building) {
    const NewBuilding judged = JudgeNew(building, shows_walls);
    if (judged == NewBuilding::kUnsure) NoteUnsure(building.fitted, with, findings);
    return judged != NewBuilding::kSure;
  });
  return closed;
}

// The house that each footprint leans on most, if any.
std::vector<std::optional<size_t>> HousesOf(std::span<const ClosedBuilding> wings,
                                            std::span<const ClosedBuilding> houses) {
  std::vector<std::optional<size_t>> out(wings.size());
  for (size_t w = 0; w < wings.size(); ++w) {
    const FittedBuilding& wing = wings[w].fitted;
    const Eigen::AlignedBox2d box = BoundsOf(wing.building, kRaised_m);
    double longest = 0;
    for (size_t h = 0; h < houses.size(); ++h) {
      const FittedBuilding& house = houses[h].fitted;
      if (houses[h].facets.empty() || !box.intersects(BoundsOf(house.building, 0))) continue;
      if (!IsWingOf(house, wing)) continue;
      const double contact = ContactOf(house, wing);
      if (contact > longest) out[w] = h;
      longest = std::max(longest, contact);
    }
  }
  return out;
}

// The buildings of a map, in its order.
struct Houses {
  std::vector<MapBuilding> mapped;  // where the survey shows them
  std::vector<ClosedBuilding> closed;
  double plan_to_survey_m = 0;
};

std::vector<Building> BuildingsOf(const Houses& houses) {
  std::vector<Building> buildings;
  for (size_t b = 0; b < houses.closed.size(); ++b) {
    if (houses.closed[b].facets.empty()) continue;
    buildings.push_back(AsBuilding(houses.mapped[b].id, "map", houses.closed[b]));
  }
  return buildings;
}

bool IsAsGood(const ClosedBuilding& with_wings, const ClosedBuilding& without) {
  return with_wings.standing == Standing::kStands && !with_wings.facets.empty() &&
         with_wings.detail <= std::max(without.detail, SolidDetail::kCoarse);
}

// Where the map has most of a wing above others of its parts, which it overlaps, its underside in
// the plan's heights: counted on a grid.
std::optional<double> UndersideOf(const MapBuilding& house, const FittedBuilding& wing) {
  constexpr double kStep_m = 0.5;
  const Eigen::AlignedBox2d box = BoundsOf(wing.building, 0);
  int inside = 0, raised = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (double y = box.min().y() + kStep_m / 2; y < box.max().y(); y += kStep_m) {
    for (double x = box.min().x() + kStep_m / 2; x < box.max().x(); x += kStep_m) {
      const Eigen::Vector2d p(x, y);
      if (DistanceTo(wing.building, p) > 0) continue;
      ++inside;
      bool hangs = false;
      for (const RaisedPart& part : house.raised) {
        if (!Contains(part.outline, p)) continue;
        hangs = true;
        lowest = std::min(lowest, part.underside_m);
      }
      raised += hangs ? 1 : 0;
    }
  }
  if (2 * raised <= inside) return std::nullopt;
  return lowest;
}

// Says what was joined to a house: the wings of which `is_its` says so.
template <typename IsIts>
void NoteWings(const MapBuilding& house, const std::vector<ClosedBuilding>& wings,
               const IsIts& is_its, ProxyFindings& findings) {
  double lacking = 0;
  for (size_t w = 0; w < wings.size(); ++w) {
    if (!is_its(w)) continue;
    const FittedBuilding& wing = wings[w].fitted;
    if (!UndersideOf(house, wing)) lacking += Area(wing.building);
  }
  if (lacking > 0) {
    findings.of_map.push_back(
        {fmt::format("{}: wings that the map lacks lean on it, {:.0f} m2", house.id, lacking)});
  }
}

// Says from where on parts are built below which nothing stands: photos hardly ever show.
void NoteHanging(const Houses& houses, ProxyFindings& findings) {
  for (size_t h = 0; h < houses.closed.size(); ++h) {
    const std::vector<Facet>& facets = houses.closed[h].facets;
    const MapBuilding& mapped = houses.mapped[h];
    if (mapped.hanging.empty() || facets.empty()) continue;
    const bool hangs = std::ranges::any_of(
        facets, [](const Facet& facet) { return facet.facet_class == FacetClass::kOuterFloor; });
    double area = 0;
    for (const HangingPart& part : mapped.hanging) area += Area(mapped.parts.at(part.part));
    findings.of_map.push_back({fmt::format(
        "{}: parts that begin above the ground by the map, {:.0f} m2, are built {}", mapped.id,
        area, hangs ? "from where it has their undersides" : "down to the ground")});
  }
}

// The house with a wing as one more part, which hangs where the map says so.
FittedBuilding JoinedWith(FittedBuilding house, const FittedBuilding& wing,
                          const MapBuilding& mapped) {
  const size_t first = house.building.parts.size();
  house = WithWing(std::move(house), wing);
  const auto underside = UndersideOf(mapped, wing);
  for (size_t part = first; underside && part < house.building.parts.size(); ++part) {
    house.building.hanging.push_back({part, *underside});
  }
  return house;
}

// Closes houses once more with the wings that lean on them, and takes these out of `wings`, where
// that makes as good a solid.
void JoinWings(const UprightSurvey& survey, const Workshop& with, Houses& houses,
               std::vector<ClosedBuilding>& wings, ProxyFindings& findings) {
  const auto house_of = HousesOf(wings, houses.closed);
  std::vector<size_t> extended;
  std::vector<MapBuilding> mapped;
  std::vector<FittedBuilding> fitted;
  for (size_t h = 0; h < houses.closed.size(); ++h) {
    FittedBuilding joined = houses.closed[h].fitted;
    const size_t own_parts = joined.building.parts.size();
    for (size_t w = 0; w < wings.size(); ++w) {
      if (house_of[w] != h) continue;
      joined = JoinedWith(std::move(joined), wings[w].fitted, houses.mapped[h]);
    }
    if (joined.building.parts.size() == own_parts) continue;
    MapBuilding& as_mapped = mapped.emplace_back(houses.mapped[h]);
    as_mapped.parts.insert(as_mapped.parts.end(),
                           joined.building.parts.begin() + static_cast<ptrdiff_t>(own_parts),
                           joined.building.parts.end());
    as_mapped.hanging = joined.building.hanging;
    fitted.push_back(std::move(joined));
    extended.push_back(h);
  }
  auto closed = CloseAsFitted(survey, mapped, fitted, houses.plan_to_survey_m, with);
  std::vector<bool> has_joined(wings.size(), false);
  for (size_t i = 0; i < extended.size(); ++i) {
    const size_t h = extended[i];
    if (!IsAsGood(closed[i], houses.closed[h])) continue;
    NoteWings(
        houses.mapped[h], wings, [&](size_t w) { return house_of[w] == h; }, findings);
    houses.closed[h] = std::move(closed[i]);
    houses.mapped[h] = std::move(mapped[i]);
    for (size_t w = 0; w < wings.size(); ++w) has_joined[w] = has_joined[w] || house_of[w] == h;
  }
  std::vector<ClosedBuilding> apart;
  for (size_t w = 0; w < wings.size(); ++w) {
    if (!has_joined[w]) apart.push_back(std::move(wings[w]));
  }
  wings = std::move(apart);
}

// Buildings that no map names, in the order of a line over the ground plan, so that their ids hold
// when more of the cloud is there. What nobody saw of their walls is on no footprint of a map
// either.
void AddOthers(std::vector<ClosedBuilding> others, MapModel& model, ProxyFindings& findings) {
  std::ranges::stable_sort(others, {}, [](const ClosedBuilding& house) {
    return kNumberedAlong.head<2>().dot(BoundsOf(house.fitted.building, 0).center());
  });
  for (size_t o = 0; o < others.size(); ++o) {
    MapBuilding& outline = model.outlines.emplace_back(others[o].fitted.building);
    outline.id = fmt::format("C{:04}", o + 1);
    findings.notes.push_back(NoteOf(outline.id, others[o]));
    Building& building = model.buildings.emplace_back(AsBuilding(outline.id, "cloud", others[o]));
    for (Facet& facet : building.facets) {
      if (facet.source == "footprint") facet.source = "extruded";
    }
  }
}

// A map that lies elsewhere is worth a word to those who fly by it.
void NoteShift(const MapRegistration& place, ProxyFindings& findings) {
  constexpr double kMuch_m = 0.5;
  constexpr double kMuch_rad = 0.2 * std::numbers::pi / 180;
  if (place.shift_m.norm() < kMuch_m && std::abs(place.turn_rad) < kMuch_rad) return;
  findings.of_map.push_back({fmt::format(
      "the map lies {:.1f} m beside what the photos show, turned by {:.1f} degrees: this was taken "
      "into account",
      place.shift_m.norm(), std::abs(place.turn_rad) * 180 / std::numbers::pi)});
}

std::string PlaceOf(const MapRegistration& place) {
  const std::string where =
      place.measured
          ? fmt::format(
                "the survey shows the plan's map {:.2f} m east and {:.2f} m north of where "
                "it is, turned by {:.2f} deg",
                place.shift_m.x(), place.shift_m.y(), place.turn_rad * 180 / std::numbers::pi)
          : "the cloud shows too few walls to tell whether the plan's map lies right; it is taken "
            "as it is";
  return fmt::format(
      "{}; of the ground below its buildings {:.0f} % is built over, next to them {:.0f} %", where,
      100 * place.raised_inside, 100 * place.raised_outside);
}

}  // namespace

std::optional<MapModel> BuildFromMap(const PlanarScene& scene, const ProxyInput& input,
                                     const ProxyOptions& options, int threads,
                                     ProxyFindings& findings) {
  assert(input.plan && input.georef.frame == "enu" && input.georef.metric);
  const OutlineMap map = OutlinesOf(*input.plan, input.georef, scene.up);
  if (map.buildings.empty()) return std::nullopt;
  const UprightSurvey survey = UprightSurveyOf(scene);
  const Workshop with = WorkshopOf(scene, input, options, threads);
  const auto [place, plan_to_survey_m] =
      FindMap(survey, map, {scene, with.cloud, options, threads});
  if (!place.refused.empty()) {
    findings.of_map.push_back({"the plan's map gives no shape, because " + place.refused, true});
    return std::nullopt;
  }
  findings.notes.push_back(PlaceOf(place));
  NoteShift(place, findings);
  OutlineMap found = Moved(map, place.survey_from_map);
  Houses houses;
  houses.plan_to_survey_m = plan_to_survey_m;
  houses.closed = CloseAll(survey, found, houses.plan_to_survey_m, with);
  houses.mapped = std::move(found.buildings);
  auto others = CloseNew(survey, BuildingsOf(houses), with, findings);
  JoinWings(survey, with, houses, others, findings);
  NoteHanging(houses, findings);
  for (size_t b = 0; b < houses.closed.size(); ++b) {
    Report(houses.mapped[b].id, houses.closed[b], houses.mapped[b].to_capture, findings);
  }
  MapModel model{.buildings = BuildingsOf(houses), .outlines = std::move(houses.mapped)};
  const size_t mapped = model.outlines.size();
  AddOthers(std::move(others), model, findings);
  for (size_t o = mapped; o < model.outlines.size(); ++o) {
    const MapBuilding& outline = model.outlines[o];
    findings.of_map.push_back({fmt::format("{}: stands on no footprint of the map, {:.0f} m2",
                                           outline.id, Area(outline))});
  }
  return model;
}

MapModel BuildWithoutMap(const PlanarScene& scene, const ProxyInput& input,
                         const ProxyOptions& options, int threads, ProxyFindings& findings) {
  assert(input.georef.metric);
  const UprightSurvey survey = UprightSurveyOf(scene);
  ProxyFindings of_a_map;  // what cannot be built like this is built of its planes: no finding
  auto closed = CloseNew(survey, {}, WorkshopOf(scene, input, options, threads), of_a_map);
  const FoundHouses found(scene, survey);
  std::erase_if(closed, [&](const ClosedBuilding& house) {
    const std::string why_not = found.WhyNot(house);
    if (why_not.empty()) return false;
    findings.notes.push_back(
        fmt::format("a house of {:.0f} m2 is built of its planes, not on its footprint: {}",
                    Area(house.fitted.building), why_not));
    return true;
  });
  MapModel model;
  AddOthers(std::move(closed), model, findings);
  return model;
}

}  // namespace stucco
