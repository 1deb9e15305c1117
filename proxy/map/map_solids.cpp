// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/map_solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "proxy/map/closer_look.h"
#include "proxy/map/off_the_map.h"
#include "proxy/map/roof_cells.h"
#include "proxy/map/wall_facets.h"
#include "proxy/solids/closed_check.h"
#include "proxy/solids/soundness.h"
#include "proxy/solids/written_check.h"
#include "survey/median.h"
#include "survey/parallel.h"

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
  std::sort(heights.begin(), heights.end());
  return heights[static_cast<size_t>(kLowest * static_cast<double>(heights.size()))] -
         Median(feet).value_or(0);
}

// What a building is made from.
struct BuildingEvidence {
  FittedBuilding fitted;
  RoofEvidence roof;
  Samples near;               // on and around the building
  std::optional<double> top;  // where its points say that it ends; a level roof's height
  double map_top = 0;
  bool walls_seen = true;  // false: a scan from above, without photos and walls
};

// Height of a level top: the middle of what lies above the footprint, else where its walls end.
std::optional<double> TopOf(const BuildingEvidence& evidence) {
  constexpr size_t kFewest = 30;
  constexpr double kWallTop = 0.95;
  std::vector<double> heights;
  for (const auto& p : evidence.roof.samples.positions) heights.push_back(p.z());
  if (heights.size() >= kFewest) return Median(heights);
  if (!(evidence.fitted.held > 0)) return std::nullopt;
  heights.clear();
  for (size_t i = 0; i < evidence.near.size(); ++i) {
    if (LooksLikeWall(evidence.near.normals[i])) {
      heights.push_back(evidence.near.positions[i].z());
    }
  }
  if (heights.size() < kFewest) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  return heights[static_cast<size_t>(kWallTop * static_cast<double>(heights.size() - 1))];
}

double AreaOf(const MapBuilding& building) {
  double area = 0;
  for (const Polygon& part : building.parts) area += Area(part);
  return area;
}

// What of the map stands, by what the cloud shows inside its outline.
enum class Standing { kStands, kGone, kUnseen };

// Nobody sees the ground below a building; below trees one does, between the leaves.
bool ShowsGround(const BuildingEvidence& evidence) {
  constexpr double kBare = 0.5;  // of what is seen of the footprint
  constexpr double kSeen = 0.2;  // of the footprint
  const RoofEvidence& roof = evidence.roof;
  return roof.seen_m2 > kSeen * AreaOf(evidence.fitted.building) &&
         roof.bare_m2 > kBare * roof.seen_m2;
}

// What a building is that does not stand.
Standing AbsenceOf(const BuildingEvidence& evidence) {
  return ShowsGround(evidence) ? Standing::kGone : Standing::kUnseen;
}

// Leaves are no planes. What stands open may still be a roof on posts or a ring of walls with a
// yard.
Standing StandingOf(const BuildingEvidence& evidence) {
  constexpr double kRoofed = 0.3;       // of the footprint
  constexpr double kSmooth = 0.75;      // of what lies above it
  constexpr double kHeld = 0.4;         // of the walls
  constexpr double kHeldAround = 0.75;  // of the walls, where the ground shows between them
  const double area = AreaOf(evidence.fitted.building);
  const RoofEvidence& roof = evidence.roof;
  double roofed = 0;
  size_t on_planes = 0;
  for (const Plane& plane : roof.planes) {
    roofed += plane.area;
    on_planes += plane.points.size();
  }
  const bool smooth =
      static_cast<double>(on_planes) > kSmooth * static_cast<double>(roof.samples.size());
  const bool walled = evidence.fitted.held > (ShowsGround(evidence) ? kHeldAround : kHeld);
  if (walled || (smooth && roofed > kRoofed * area)) return Standing::kStands;
  return AbsenceOf(evidence);
}

// Whether the cloud shows what was made of it. Crowns of trees hold edges of a map by leaves that
// stand upright, and roofs by leaves that lie flat, but fill neither walls nor roofs.
bool ShowsWhatStands(const std::vector<Facet>& facets) {
  constexpr double kWalled = 0.2;   // of the walls, without party walls where facades are known
  constexpr double kCovered = 0.4;  // of the roofs
  const bool has_facades = std::ranges::any_of(
      facets, [](const Facet& facet) { return !facet.planned_facades.empty(); });
  double walls = 0, walls_seen = 0, roofs = 0, roofs_seen = 0;
  for (const Facet& facet : facets) {
    const bool wall = facet.facet_class == FacetClass::kWall;
    if (wall && has_facades && facet.planned_facades.empty()) continue;
    if (!wall && facet.facet_class != FacetClass::kRoof) continue;
    (wall ? walls : roofs) += facet.area;
    (wall ? walls_seen : roofs_seen) += facet.area * facet.seen;
  }
  return walls_seen > kWalled * walls || roofs_seen > kCovered * roofs;
}

// One way to close a building.
struct Attempt {
  FittedBuilding building;
  RoofCells cells;
  bool walls_seen = true;
};

// From above nobody sees walls: samples look upright there only because they lie on both sides of
// an edge.
void ForgetWalls(std::vector<Facet>& facets) {
  for (Facet& facet : facets) {
    if (facet.facet_class != FacetClass::kWall) continue;
    facet.seen = facet.rms = 0;
    facet.inferred = 1;
    facet.support = 0;
    if (facet.source == "planes") facet.source = "extruded";
  }
}

// The facets of a solid that stays one when its corners are written.
Solid SolidOf(const Attempt& attempt, const Samples& near, const Tolerances& tolerances,
              const Eigen::Matrix3d& world_from_upright, double normal_angle_deg) {
  Solid solid;
  const auto faces =
      ExtrudeCells(attempt.cells.arrangement, attempt.cells.lines, attempt.cells.labels,
                   attempt.cells.roofs, attempt.building.ground);
  if (faces.empty()) {
    solid.why_not = "the ground lies open all over it";
    return solid;
  }
  auto upright = FacetsOf(faces, attempt.building, near, tolerances, normal_angle_deg);
  if (!attempt.walls_seen) ForgetWalls(upright);
  if (const auto fault = FindFaultAsWritten(upright, world_from_upright)) {
    solid.why_not = *fault;
    return solid;
  }
  solid.facets = Turned(upright, world_from_upright);
  if (const auto problem = FindOpening(solid.facets)) {
    solid.why_not = *problem;
    solid.facets.clear();
  }
  return solid;
}

// The edges where the map has them; they keep their names.
FittedBuilding AsMapped(FittedBuilding building, const MapBuilding& mapped) {
  building.building = mapped;
  size_t edge = 0;
  for (const Polygon& part : mapped.parts) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i, ++edge) {
        building.edges[edge].line = {ring[i], ring[(i + 1) % ring.size()]};
        building.edges[edge].fitted = false;
      }
    }
  }
  return building;
}

// The finest solid that is sound, and why none that is finer is; facets are empty where none is.
struct Closed {
  Solid solid;
  SolidDetail detail = SolidDetail::kFull;
  std::string not_finer;  // "full: in millimetres crosses itself"; empty: nothing finer was tried
};

class BuildingCloser {
 public:
  BuildingCloser(const Tolerances& tolerances, const Eigen::Vector3d& up,
                 const ProxyOptions& options)
      : tolerances_(tolerances),
        options_(options),
        world_from_upright_(UprightFromWorld(up).transpose()) {}

  Closed Close(const BuildingEvidence& evidence, const MapBuilding& mapped) const {
    std::vector<int> all, large;
    const double area = AreaOf(evidence.fitted.building);
    for (size_t p = 0; p < evidence.roof.planes.size(); ++p) {
      if (all.size() < static_cast<size_t>(options_.max_planes)) all.push_back(int(p));
      constexpr double kLarge = 0.1;  // of the footprint
      constexpr size_t kFew = 4;
      const bool is_large = evidence.roof.planes[p].area > kLarge * area;
      if (is_large && large.size() < kFew) large.push_back(int(p));
    }
    Closed closed;
    for (const SolidDetail detail :
         {SolidDetail::kFull, SolidDetail::kCoarse, SolidDetail::kFlatTop, SolidDetail::kFromMap}) {
      if (detail == SolidDetail::kFull && all.empty()) continue;
      if (detail == SolidDetail::kCoarse && (large.empty() || large.size() == all.size())) continue;
      if (detail == SolidDetail::kFlatTop && !evidence.top) continue;
      closed.detail = detail;
      closed.solid = CloseOrExplain([&] {
        const Attempt attempt =
            AttemptOf(detail, evidence, mapped, detail == SolidDetail::kFull ? all : large);
        return SolidOf(attempt, evidence.near, tolerances_, world_from_upright_,
                       options_.normal_angle_deg);
      });
      if (closed.solid.why_not.empty()) break;
      closed.not_finer += fmt::format("{}{}: {}", closed.not_finer.empty() ? "" : "; ",
                                      Name(detail), closed.solid.why_not);
    }
    return closed;
  }

  const ProxyOptions& options() const { return options_; }

 private:
  Attempt AttemptOf(SolidDetail detail, const BuildingEvidence& evidence, const MapBuilding& mapped,
                    const std::vector<int>& planes) const {
    Attempt attempt{.building = evidence.fitted, .cells = {}, .walls_seen = evidence.walls_seen};
    const double lowest = evidence.fitted.ground + kRaised_m;
    if (detail == SolidDetail::kFull || detail == SolidDetail::kCoarse) {
      attempt.cells = LabelRoof(evidence.fitted, evidence.roof, planes, tolerances_);
    } else if (detail == SolidDetail::kFlatTop) {
      attempt.cells = FlatRoof(evidence.fitted.building, std::max(lowest, *evidence.top));
    } else {
      attempt.building = AsMapped(evidence.fitted, mapped);
      attempt.cells = FlatRoof(mapped, std::max(lowest, evidence.top.value_or(evidence.map_top)));
    }
    return attempt;
  }

  const Tolerances& tolerances_;
  const ProxyOptions& options_;
  Eigen::Matrix3d world_from_upright_;
};

// What became of one building of the map.
struct Outcome {
  Standing standing = Standing::kStands;
  Closed closed;
  size_t planes = 0;  // of its roof, found
};

std::string NoteOf(const std::string& id, const Outcome& outcome) {
  size_t walls = 0, seen = 0, roofs = 0;
  for (const Facet& facet : outcome.closed.solid.facets) {
    const bool wall = facet.facet_class == FacetClass::kWall;
    walls += wall;
    seen += wall && facet.seen > 0;
    roofs += facet.facet_class == FacetClass::kRoof;
  }
  const std::string& not_finer = outcome.closed.not_finer;
  return fmt::format("{}: closed, {}: {} walls ({} seen), {} roofs from {} planes{}", id,
                     Name(outcome.closed.detail), walls, seen, roofs, outcome.planes,
                     not_finer.empty() ? "" : ", because " + not_finer);
}

void Report(const std::string& id, const Outcome& outcome, bool to_capture,
            ProxyFindings& findings) {
  if (outcome.standing == Standing::kGone) {
    findings.warnings.push_back(
        id + ": not built, or demolished: the cloud shows the ground where the map has it");
  } else if (outcome.standing == Standing::kUnseen && !to_capture) {
    findings.notes.push_back(id + ": not seen, and not asked for: left out");
  } else if (outcome.closed.solid.facets.empty()) {
    findings.warnings.push_back(
        fmt::format("{}: left out, it does not close: {}", id, outcome.closed.not_finer));
  } else {
    findings.notes.push_back(NoteOf(id, outcome));
    if (outcome.standing == Standing::kUnseen) {
      findings.warnings.push_back(id +
                                  ": the cloud shows too little of it: it is as the plan has it");
    }
  }
}

Outcome CloseOne(const UprightSurvey& survey, const BuildingCloser& closer,
                 const MapBuilding& mapped, const FittedBuilding& fitted, double plan_to_survey_m) {
  constexpr double kAround_m = 1;
  Outcome outcome;
  BuildingEvidence evidence;
  evidence.fitted = fitted;
  evidence.roof = FindRoofPlanes(survey, fitted, closer.options());
  evidence.near = SubsetOf(survey.samples, survey.bins.In(BoundsOf(fitted.building, kAround_m)));
  evidence.top = TopOf(evidence);
  evidence.map_top = mapped.z_m.to_m + plan_to_survey_m;
  evidence.walls_seen = !survey.samples.camera_centers.empty() || fitted.held > 0;
  outcome.planes = evidence.roof.planes.size();
  outcome.standing = StandingOf(evidence);
  const bool wanted = outcome.standing == Standing::kStands ||
                      (outcome.standing == Standing::kUnseen && mapped.to_capture);
  if (wanted) outcome.closed = closer.Close(evidence, mapped);
  const bool doubtful = outcome.standing == Standing::kStands &&
                        !outcome.closed.solid.facets.empty() &&
                        !ShowsWhatStands(outcome.closed.solid.facets);
  if (!doubtful) return outcome;
  outcome.standing = AbsenceOf(evidence);
  outcome.closed = {};
  if (outcome.standing == Standing::kUnseen && mapped.to_capture) {
    evidence.roof.planes.clear();  // as the map has it
    evidence.top.reset();
    outcome.closed = closer.Close(evidence, mapped);
  }
  return outcome;
}

// What stands on no footprint is a building only where its roof is smooth and seen; crowns are
// rough.
bool IsNewBuilding(const Outcome& outcome) {
  constexpr double kSeen = 0.6;  // of its roofs
  const bool modelled =
      outcome.closed.detail == SolidDetail::kFull || outcome.closed.detail == SolidDetail::kCoarse;
  double roofs = 0, seen = 0;
  for (const Facet& facet : outcome.closed.solid.facets) {
    if (facet.facet_class != FacetClass::kRoof) continue;
    roofs += facet.area;
    seen += facet.area * facet.seen;
  }
  return outcome.standing == Standing::kStands && modelled && roofs > 0 && seen > kSeen * roofs;
}

// What all buildings of a map are closed with.
struct Workshop {
  const PlanarScene& scene;
  const ProxyInput& input;
  const ProxyOptions& options;
  int threads;
};

// Of all buildings of a map that lies where the survey shows it. Of a large survey the cloud is
// looked at once more for some of them at a time.
std::vector<Outcome> CloseAll(const UprightSurvey& survey, const OutlineMap& map,
                              const Workshop& with) {
  const double plan_to_survey_m = HeightShift(survey, map.buildings);
  std::vector<Outcome> outcomes(map.buildings.size());
  const auto close = [&](const UprightSurvey& seen, const std::vector<size_t>& numbers,
                         const std::vector<MapBuilding>& buildings) {
    const auto fitted = FitOutlines(seen, buildings, map.facades, plan_to_survey_m);
    const BuildingCloser closer(seen.tolerances, with.scene.up, with.options);
    ParallelFor(fitted.size(), with.threads, [&](size_t i) {
      outcomes[numbers[i]] = CloseOne(seen, closer, buildings[i], fitted[i], plan_to_survey_m);
    });
  };
  if (!NeedsCloserLook(with.scene)) {
    std::vector<size_t> all(map.buildings.size());
    std::iota(all.begin(), all.end(), size_t{0});
    close(survey, all, map.buildings);
    return outcomes;
  }
  constexpr int kAtOnce = 2;  // whatever threads there are: the sets must not depend on them
  ProxyOptions of_set = with.options;
  of_set.max_points /= kAtOnce;
  const auto sets = SetsOfBuildings(survey, map.buildings, of_set.max_points);
  ParallelFor(sets.size(), std::min(with.threads, kAtOnce), [&](size_t s) {
    std::vector<MapBuilding> buildings;
    for (const size_t b : sets[s]) buildings.push_back(map.buildings[b]);
    close(CloserLook(with.scene, with.input, buildings, of_set, with.threads), sets[s], buildings);
  });
  return outcomes;
}

// What the map lacks, closed on footprints of its own, and outlined as if the map had it.
void AddNewBuildings(const UprightSurvey& survey, const Workshop& with, MapModel& model,
                     ProxyFindings& findings) {
  auto footprints = FindNewFootprints(with.scene, survey, model.buildings);
  std::vector<Outcome> outcomes(footprints.size());
  const BuildingCloser closer(survey.tolerances, with.scene.up, with.options);
  ParallelFor(footprints.size(), with.threads, [&](size_t i) {
    outcomes[i] = CloseOne(survey, closer, footprints[i].building, footprints[i], 0);
  });
  int number = 0;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    if (!IsNewBuilding(outcomes[i])) continue;
    MapBuilding& outline = model.outlines.emplace_back(std::move(footprints[i].building));
    outline.id = fmt::format("C{:04}", ++number);
    findings.notes.push_back(NoteOf(outline.id, outcomes[i]) + "; on no footprint of the map");
    model.buildings.push_back({.id = outline.id,
                               .watertight = true,
                               .source = "cloud",
                               .detail = std::string(Name(outcomes[i].closed.detail)),
                               .facets = std::move(outcomes[i].closed.solid.facets)});
  }
}

OutlineMap Moved(OutlineMap map, const Eigen::Isometry2d& motion) {
  for (MapBuilding& building : map.buildings) building = Moved(building, motion);
  for (Facade& facade : map.facades) {
    facade.a = motion * facade.a;
    facade.b = motion * facade.b;
  }
  return map;
}

}  // namespace

std::string_view Name(SolidDetail detail) {
  switch (detail) {
    case SolidDetail::kFull:
      return "full";
    case SolidDetail::kCoarse:
      return "coarse";
    case SolidDetail::kFlatTop:
      return "LoD1.2";
    case SolidDetail::kFromMap:
      return "extrusion";
  }
  return "";
}

std::optional<MapModel> BuildFromMap(const PlanarScene& scene, const ProxyInput& input,
                                     const ProxyOptions& options, int threads,
                                     ProxyFindings& findings) {
  assert(input.plan && input.georef.frame == "enu" && input.georef.metric);
  const OutlineMap map = OutlinesOf(*input.plan, input.georef, scene.up);
  if (map.buildings.empty()) return std::nullopt;
  const UprightSurvey survey = UprightSurveyOf(scene);
  const MapRegistration place = RegisterMap(survey, map);
  if (!place.refused.empty()) {
    findings.warnings.push_back("the plan's map gives no shape, because " + place.refused);
    return std::nullopt;
  }
  findings.notes.push_back(fmt::format(
      "the survey shows the plan's map {:.2f} m east and {:.2f} m north of where it is, turned by "
      "{:.2f} deg; of the ground below its buildings {:.0f} % is built over, next to them {:.0f} %",
      place.shift_m.x(), place.shift_m.y(), place.turn_rad * 180 / std::numbers::pi,
      100 * place.raised_inside, 100 * place.raised_outside));
  OutlineMap found = Moved(map, place.survey_from_map);
  auto outcomes = CloseAll(survey, found, {scene, input, options, threads});
  MapModel model{.buildings = {}, .outlines = std::move(found.buildings)};
  for (size_t b = 0; b < outcomes.size(); ++b) {
    Report(model.outlines[b].id, outcomes[b], model.outlines[b].to_capture, findings);
    if (outcomes[b].closed.solid.facets.empty()) continue;
    model.buildings.push_back({.id = model.outlines[b].id,
                               .watertight = true,
                               .source = "map",
                               .detail = std::string(Name(outcomes[b].closed.detail)),
                               .facets = std::move(outcomes[b].closed.solid.facets)});
  }
  AddNewBuildings(survey, {scene, input, options, threads}, model, findings);
  return model;
}

}  // namespace stucco
