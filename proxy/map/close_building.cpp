// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/close_building.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "proxy/map/roof_cells.h"
#include "proxy/map/wall_facets.h"
#include "proxy/map/wall_tops.h"
#include "proxy/solids/closed_check.h"
#include "proxy/solids/soundness.h"
#include "proxy/solids/written_check.h"
#include "survey/median.h"

namespace stucco {
namespace {

// What a building is made from.
struct BuildingEvidence {
  FittedBuilding fitted;
  RoofEvidence roof;
  Samples near;               // on and around the building
  std::optional<double> top;  // where its points say that it ends; a level roof's height
  double map_top = 0;
  double plan_to_survey_m = 0;
  bool walls_seen = true;  // false: a scan from above, without photos and walls
};

// Leaves look every way, roofs up.
bool AreLeaves(const Samples& samples) {
  constexpr double kUp = 0.7;          // cosine of 45 degrees
  constexpr double kMostLookUp = 0.5;  // of all
  const auto up =
      std::ranges::count_if(samples.normals, [](const auto& normal) { return normal.z() > kUp; });
  return static_cast<double>(up) < kMostLookUp * static_cast<double>(samples.size());
}

// Height of a level top: the middle of what lies above the footprint, else (nothing does, or leaves
// do) where its walls end.
std::optional<double> TopOf(const BuildingEvidence& evidence, const WallTops& walls) {
  constexpr size_t kFewest = 30;
  const Samples& above = evidence.roof.samples;
  if (above.size() < kFewest || AreLeaves(above)) return walls.Height();
  std::vector<double> heights;
  heights.reserve(above.size());
  for (const auto& p : above.positions) heights.push_back(p.z());
  return Median(std::move(heights));
}

// Whether the roof's planes are seen on so little of the footprint that they tell nothing of the
// rest.
bool HardlyShowsRoof(const BuildingEvidence& evidence) {
  constexpr double kLeast = 0.1;
  double seen = 0;
  for (const Plane& plane : evidence.roof.planes) seen += plane.area;
  return seen < kLeast * Area(evidence.fitted.building);
}

// Height of the largest level piece of roof; nothing where there is none of a few square metres.
std::optional<double> LevelPiece(const RoofEvidence& roof) {
  constexpr double kLevel = 0.98;  // cosine of 11 degrees
  constexpr double kLeast_m2 = 4;
  for (const Plane& plane : roof.planes) {  // by falling area
    if (plane.area < kLeast_m2) return std::nullopt;
    if (plane.normal.z() < kLevel) continue;
    std::vector<double> heights;
    heights.reserve(plane.points.size());
    for (const int i : plane.points) heights.push_back(roof.samples.positions[i].z());
    return Median(std::move(heights));
  }
  return std::nullopt;
}

// Nobody sees the ground below a building; below trees one does, between the leaves.
bool ShowsGround(const BuildingEvidence& evidence) {
  constexpr double kBare = 0.5;  // of what is seen of the footprint
  constexpr double kSeen = 0.2;  // of the footprint
  const RoofEvidence& roof = evidence.roof;
  return roof.seen_m2 > kSeen * Area(evidence.fitted.building) &&
         roof.bare_m2 > kBare * roof.seen_m2;
}

// What a building is that does not stand.
Standing AbsenceOf(const BuildingEvidence& evidence) {
  return ShowsGround(evidence) ? Standing::kGone : Standing::kUnseen;
}

// Leaves are no planes: of what lies above a footprint in a wood, little is on any.
bool HasSmoothRoof(const RoofEvidence& roof) {
  constexpr double kSmooth = 0.75;  // of what lies above it
  size_t on_planes = 0;
  for (const Plane& plane : roof.planes) on_planes += plane.points.size();
  return static_cast<double>(on_planes) > kSmooth * static_cast<double>(roof.samples.size());
}

constexpr double kHeld = 0.4;  // of the walls of what stands, by length, that planes hold

// What stands open may still be a roof on posts or a ring of walls with a yard.
Standing StandingOf(const BuildingEvidence& evidence) {
  constexpr double kRoofed = 0.3;       // of the footprint
  constexpr double kHeldAround = 0.75;  // of the walls, where the ground shows between them
  const double area = Area(evidence.fitted.building);
  const RoofEvidence& roof = evidence.roof;
  double roofed = 0;
  for (const Plane& plane : roof.planes) roofed += plane.area;
  const bool walled = evidence.fitted.held > (ShowsGround(evidence) ? kHeldAround : kHeld);
  if (walled || (HasSmoothRoof(roof) && roofed > kRoofed * area)) return Standing::kStands;
  return AbsenceOf(evidence);
}

constexpr double kWalled = 0.2;  // of the walls of what stands, the least that the cloud shows

// Of walls and roofs, the share that the cloud shows; 0 where there are none.
struct SeenShares {
  double walls = 0;  // of what others do not hide; without party walls where facades are known
  double roofs = 0;
};

SeenShares SharesOf(const std::vector<Facet>& facets) {
  const bool has_facades = std::ranges::any_of(
      facets, [](const Facet& facet) { return !facet.planned_facades.empty(); });
  SeenShares all, seen;
  for (const Facet& facet : facets) {
    const bool wall = facet.facet_class == FacetClass::kWall;
    if (wall && has_facades && facet.planned_facades.empty()) continue;
    if (!wall && facet.facet_class != FacetClass::kRoof) continue;
    (wall ? all.walls : all.roofs) += facet.area * (1 - facet.party);
    (wall ? seen.walls : seen.roofs) += facet.area * facet.seen;
  }
  return {.walls = all.walls > 0 ? seen.walls / all.walls : 0,
          .roofs = all.roofs > 0 ? seen.roofs / all.roofs : 0};
}

// Whether the cloud shows what was made of it. Crowns of trees hold edges of a map by leaves that
// stand upright, and roofs by leaves that lie flat, but fill neither walls nor roofs.
bool ShowsWhatStands(const std::vector<Facet>& facets) {
  constexpr double kCovered = 0.4;  // of the roofs
  const SeenShares seen = SharesOf(facets);
  return seen.walls > kWalled || seen.roofs > kCovered;
}

// One way to close a building.
struct Attempt {
  FittedBuilding building;
  RoofCells cells;
  double plan_to_survey_m = 0;
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

// What stands on each cell: hanging parts only where all their roofs lie above their undersides.
Storeys StoreysOf(const Attempt& attempt) {
  constexpr double kLowest_m = 1;  // storey
  const Arrangement& plan = attempt.cells.arrangement;
  Storeys storeys{.labels = attempt.cells.labels,
                  .roofs = attempt.cells.roofs,
                  .ground = attempt.building.ground};
  for (const HangingPart& hanging : attempt.building.building.hanging) {
    const Polygon& part = attempt.building.building.parts.at(hanging.part);
    const double underside = hanging.underside_m + attempt.plan_to_survey_m;
    std::vector<size_t> below;
    bool fits = underside > storeys.ground + kLowest_m;
    for (size_t f = 0; f < plan.faces.size(); ++f) {
      const int label = storeys.labels[f];
      if (label < 0 || !Contains(part, InnerPoint(plan, f))) continue;
      below.push_back(f);
      fits = fits && std::ranges::all_of(plan.faces[f], [&](int v) {
               return storeys.roofs[label].At(plan.vertices[v]) > underside + kLowest_m;
             });
    }
    if (!fits) continue;
    storeys.floors.resize(plan.faces.size(), storeys.ground);
    for (const size_t f : below) storeys.floors[f] = underside;
  }
  return storeys;
}

// The facets of a solid that stays one when its corners are written.
Solid SolidOf(const Attempt& attempt, const Samples& near, const Tolerances& tolerances,
              const Eigen::Matrix3d& world_from_upright, double normal_angle_deg) {
  Solid solid;
  const auto faces =
      ExtrudeCells(attempt.cells.arrangement, attempt.cells.lines, StoreysOf(attempt));
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
  building = WithParts(std::move(building), mapped.parts);
  for (FittedEdge& edge : building.edges) edge.fitted = false;
  return building;
}

// The finest solid that is sound, and why none that is finer is.
struct Finest {
  Solid solid;
  SolidDetail detail = SolidDetail::kFull;
  std::string not_finer;
};

class SolidMaker {
 public:
  SolidMaker(const Tolerances& tolerances, const ProxyOptions& options,
             const Eigen::Matrix3d& world_from_upright)
      : tolerances_(tolerances), options_(options), world_from_upright_(world_from_upright) {}

  Finest Make(const BuildingEvidence& evidence, const MapBuilding& mapped) const {
    std::vector<int> all, large;
    const double area = Area(evidence.fitted.building);
    for (size_t p = 0; p < evidence.roof.planes.size(); ++p) {
      if (all.size() < static_cast<size_t>(options_.max_planes)) all.push_back(int(p));
      constexpr double kLarge = 0.1;  // of the footprint
      constexpr size_t kFew = 4;
      const bool is_large = evidence.roof.planes[p].area > kLarge * area;
      if (is_large && large.size() < kFew) large.push_back(int(p));
    }
    Finest finest;
    for (const SolidDetail detail :
         {SolidDetail::kFull, SolidDetail::kCoarse, SolidDetail::kFlatTop, SolidDetail::kFromMap}) {
      if (detail == SolidDetail::kFull && all.empty()) continue;
      if (detail == SolidDetail::kCoarse && (large.empty() || large.size() == all.size())) continue;
      if (detail == SolidDetail::kFlatTop && !evidence.top) continue;
      finest.detail = detail;
      const auto close = [&](const BuildingEvidence& by) {
        return CloseOrExplain([&] {
          const Attempt attempt =
              AttemptOf(detail, by, mapped, detail == SolidDetail::kFull ? all : large);
          return SolidOf(attempt, by.near, tolerances_, world_from_upright_,
                         options_.normal_angle_deg);
        });
      };
      finest.solid = close(evidence);
      if (!finest.solid.why_not.empty() && !evidence.fitted.building.hanging.empty()) {
        BuildingEvidence down = evidence;  // to the ground
        down.fitted.building.hanging.clear();
        finest.solid = close(down);
      }
      if (finest.solid.why_not.empty()) break;
      finest.not_finer += fmt::format("{}{}: {}", finest.not_finer.empty() ? "" : "; ",
                                      Name(detail), finest.solid.why_not);
    }
    return finest;
  }

 private:
  Attempt AttemptOf(SolidDetail detail, const BuildingEvidence& evidence, const MapBuilding& mapped,
                    const std::vector<int>& planes) const {
    Attempt attempt{.building = evidence.fitted,
                    .cells = {},
                    .plan_to_survey_m = evidence.plan_to_survey_m,
                    .walls_seen = evidence.walls_seen};
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
  const Eigen::Matrix3d& world_from_upright_;
};

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

BuildingCloser::BuildingCloser(const UprightSurvey& survey, const Eigen::Vector3d& up,
                               const ProxyOptions& options)
    : survey_(survey), options_(options), world_from_upright_(UprightFromWorld(up).transpose()) {}

ClosedBuilding BuildingCloser::Close(const MapBuilding& mapped, const FittedBuilding& fitted,
                                     double plan_to_survey_m) const {
  constexpr double kAround_m = 1;
  BuildingEvidence evidence;
  evidence.fitted = fitted;
  evidence.near = SubsetOf(survey_.samples, survey_.bins.In(BoundsOf(fitted.building, kAround_m)));
  const WallTops walls(fitted, evidence.near, survey_.tolerances.level_of_detail);
  evidence.roof = FindRoofPlanes(survey_, fitted, walls, options_);
  evidence.top = TopOf(evidence, walls);
  if (HardlyShowsRoof(evidence) && walls.Height()) {
    // A level roof where the walls end, or as high as a piece of it lies above all that is seen of
    // them.
    const double piece = LevelPiece(evidence.roof).value_or(*walls.Height());
    evidence.roof.planes.clear();
    evidence.top = std::max(*walls.Height(), piece);
  }
  evidence.map_top = mapped.z_m.to_m + plan_to_survey_m;
  evidence.plan_to_survey_m = plan_to_survey_m;
  evidence.walls_seen = !survey_.samples.camera_centers.empty() || fitted.held > 0;
  ClosedBuilding closed;
  closed.standing = StandingOf(evidence);
  closed.fitted = fitted;
  closed.roof_planes = evidence.roof.planes.size();
  const SolidMaker maker(survey_.tolerances, options_, world_from_upright_);
  const auto make = [&] {
    Finest finest = maker.Make(evidence, mapped);
    closed.facets = std::move(finest.solid.facets);
    closed.detail = finest.detail;
    closed.not_finer = std::move(finest.not_finer);
  };
  const auto wanted_unseen = [&] {
    return closed.standing == Standing::kUnseen && mapped.to_capture;
  };
  const auto as_mapped = [&] {
    evidence.roof.planes.clear();
    evidence.top.reset();
  };
  // Of a scan without walls, planes amid details are of a roof all the same.
  if (wanted_unseen() && evidence.walls_seen && !HasSmoothRoof(evidence.roof)) as_mapped();
  if (closed.standing == Standing::kStands || wanted_unseen()) make();
  const bool doubtful = closed.standing == Standing::kStands && !closed.facets.empty() &&
                        !ShowsWhatStands(closed.facets);
  if (!doubtful) return closed;
  closed.standing = AbsenceOf(evidence);
  closed.facets.clear();
  closed.not_finer.clear();
  if (wanted_unseen()) {
    as_mapped();
    make();
  }
  return closed;
}

NewBuilding JudgeNew(const ClosedBuilding& closed, bool shows_walls) {
  constexpr double kSeen = 0.6;  // of its roofs
  const bool modelled =
      closed.detail == SolidDetail::kFull || closed.detail == SolidDetail::kCoarse;
  if (closed.standing != Standing::kStands || !modelled) return NewBuilding::kNone;
  const SeenShares seen = SharesOf(closed.facets);
  if (!(seen.roofs > kSeen)) return NewBuilding::kNone;
  if (seen.walls > kWalled || !shows_walls) return NewBuilding::kSure;
  return closed.fitted.held > kHeld ? NewBuilding::kUnsure : NewBuilding::kNone;
}

}  // namespace stucco
