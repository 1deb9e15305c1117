// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/read_site.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "plan/map/clean.h"
#include "plan/map/closed_off.h"
#include "plan/map/home.h"
#include "plan/map/internal/ogr.h"
#include "plan/map/internal/outlines.h"
#include "plan/map/map_crs.h"
#include "plan/map/read_dem.h"
#include "plan/map/read_map.h"
#include "plan/map/read_obstacles.h"
#include "plan/map/safe_altitude.h"
#include "plan/safety/error_budget.h"
#include "site/facades.h"
#include "site/ground.h"
#include "survey/error.h"
#include "survey/geometry2d.h"
#include "survey/median.h"
#include "survey/plan_frame.h"

namespace stucco::plan {
namespace {

// The frame is a plane with scale 1: beyond this lengths are off by a millimetre in a kilometre.
constexpr double kWidestSite_m = 30000;

Eigen::AlignedBox2d BoundsOf(const MapFeature& feature) {
  Eigen::AlignedBox2d bounds;
  for (const Polygon& polygon : feature.polygons) bounds.extend(BoundsOf(polygon));
  return bounds;
}

Eigen::AlignedBox2d BoundsOf(const std::vector<Polygon>& polygons) {
  Eigen::AlignedBox2d bounds;
  for (const Polygon& polygon : polygons) bounds.extend(BoundsOf(polygon));
  return bounds;
}

// Areas of interest or no-fly zones in the frame of the plan, disjoint.
std::vector<Polygon> AreasOf(RawMap map, const std::string& crs, const PlanOrigin& origin) {
  MoveToPlan(map, crs, origin);
  std::vector<Polygon> areas;
  for (const MapFeature& feature : map.features) {
    for (const Polygon& polygon : feature.polygons) {
      for (Polygon& part : internal::ValidParts(polygon)) areas.push_back(std::move(part));
    }
  }
  areas = internal::Union(areas);
  if (!areas.empty()) return areas;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: has no area", map.path.string()),
              "give polygons of some square metres at least");
}

bool IsFinite(const MapFeature& feature) {
  for (const Polygon& polygon : feature.polygons) {
    for (const Ring& ring : polygon.rings) {
      for (const Eigen::Vector2d& corner : ring) {
        if (!corner.allFinite()) return false;
      }
    }
  }
  return true;
}

// Corners that the coordinate system has no place for would spread to everything they meet.
void DropLostFeatures(RawMap& map) {
  std::erase_if(map.features, [&](const MapFeature& feature) {
    const bool lost = !IsFinite(feature);
    if (lost) map.repairs.Add(feature.building, "coordinates are no numbers; left out");
    return lost;
  });
}

void KeepNear(RawMap& map, const Eigen::AlignedBox2d& area, double reach_m) {
  const size_t left_out = std::erase_if(map.features, [&](const MapFeature& feature) {
    return area.squaredExteriorDistance(BoundsOf(feature).center()) >
           std::pow(reach_m + BoundsOf(feature).diagonal().norm() / 2, 2);
  });
  if (left_out > 0) {
    map.repairs.Add("", fmt::format("{} buildings far from the area left out", left_out));
  }
}

void CheckExtent(const RawMap& map) {
  Eigen::AlignedBox2d bounds;
  std::vector<double> x;
  std::vector<double> y;
  for (const MapFeature& feature : map.features) {
    bounds.extend(BoundsOf(feature));
    x.push_back(BoundsOf(feature).center().x());
    y.push_back(BoundsOf(feature).center().y());
  }
  if (map.features.empty() || bounds.sizes().maxCoeff() <= kWidestSite_m) return;
  const Eigen::Vector2d middle(*Median(x), *Median(y));
  const MapFeature* farthest = nullptr;
  size_t astray = 0;
  double most = 0;
  for (const MapFeature& feature : map.features) {
    const double away = (BoundsOf(feature).center() - middle).norm();
    if (away > kWidestSite_m / 2) ++astray;
    if (away <= most) continue;
    most = away;
    farthest = &feature;
  }
  constexpr double kFew = 0.05;
  std::string what =
      fmt::format("{}: spans {:.0f} km", map.path.string(), bounds.sizes().maxCoeff() / 1000);
  if (farthest != nullptr && astray <= std::max(1.0, kFew * map.features.size())) {
    what += fmt::format("; {} lies {:.0f} km from the others", farthest->building, most / 1000);
  }
  throw Error(
      ErrorKind::kBadInput, what,
      fmt::format("plan at most {:.0f} km at once: give an --area, or take out what does not "
                  "belong to the place",
                  kWidestSite_m / 1000));
}

[[noreturn]] void FailNotInArea(const SiteInputs& inputs) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: no building of {} is inside the area",
                          inputs.area_of_interest->string(), inputs.map.string()),
              "check that both are of one place and in the coordinate systems they name");
}

struct Located {
  RawMap map;  // in the frame of the plan
  PlanOrigin origin;
  std::vector<Polygon> area_of_interest;
};

Located Locate(const SiteInputs& inputs, const PlanOptions& options, double margin_m) {
  Located located{.map = ReadMap(inputs.map, options), .origin = {}, .area_of_interest = {}};
  RawMap& map = located.map;
  DropLostFeatures(map);
  if (map.features.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: has no buildings", map.path.string()),
                "give a map with the outlines of buildings");
  }
  const std::string crs = CrsOfMap(map, options.map_crs);
  if (inputs.area_of_interest) {
    const RawMap area = ReadAreas(*inputs.area_of_interest);
    const std::string area_crs = CrsOfMap(area, options.map_crs);
    located.origin = OriginNear(MiddleOf(area, area_crs));
    located.area_of_interest = AreasOf(area, area_crs, located.origin);
  } else {
    located.origin = OriginNear(MiddleOf(map, crs));
  }
  MoveToPlan(map, crs, located.origin);
  DropLostFeatures(map);
  if (inputs.area_of_interest) {
    KeepNear(map, BoundsOf(located.area_of_interest), margin_m + kSurroundings_m);
    if (map.features.empty()) FailNotInArea(inputs);
  }
  CheckExtent(map);
  return located;
}

// Buildings that the border of the area cuts are captured whole.
void NoteCut(const std::vector<Polygon>& area, const Site& site, RepairLog& repairs) {
  constexpr double kOutside_m2 = 1;
  std::set<std::string> cut;
  for (const Footprint& footprint : site.footprints) {
    double outside = 0;
    if (footprint.in_area) {
      for (const Polygon& part : internal::Difference(footprint.outline, area))
        outside += Area(part);
    }
    if (outside > kOutside_m2) cut.insert(footprint.building);
  }
  for (const std::string& building : cut) {
    repairs.Add(building, "the border of the area cuts it; captured whole");
  }
}

void MarkArea(const SiteInputs& inputs, const std::vector<Polygon>& area, Site& site,
              RepairLog& repairs) {
  if (!inputs.area_of_interest) return;
  std::set<std::string> touched;
  for (const Footprint& footprint : site.footprints) {
    const bool meets = std::any_of(area.begin(), area.end(), [&](const Polygon& polygon) {
      return BoundsOf(polygon).intersects(BoundsOf(footprint.outline)) &&
             internal::InteriorsMeet(polygon, footprint.outline);
    });
    if (meets) touched.insert(footprint.building);
  }
  for (Footprint& footprint : site.footprints) {
    footprint.in_area = touched.contains(footprint.building);
  }
  if (touched.empty()) FailNotInArea(inputs);
  NoteCut(area, site, repairs);
}

// Around the buildings to capture: an area of interest says which those are, not that the fields
// beside them are wanted too.
Polygon AreaAround(const Site& site, double margin_m) {
  std::vector<Polygon> core;
  for (const Footprint& footprint : site.footprints) {
    if (footprint.in_area) core.push_back(footprint.outline);
  }
  const auto all = internal::ToOgr(core);
  constexpr int kQuarterCircle = 8;
  std::unique_ptr<OGRGeometry> area;
  const std::unique_ptr<OGRGeometry> hull(all->ConvexHull());
  if (hull) area.reset(hull->Buffer(margin_m, kQuarterCircle));
  std::vector<Polygon> polygons = area ? internal::OrientedPolygons(*area) : std::vector<Polygon>{};
  if (polygons.empty()) throw Error(ErrorKind::kStageFailed, "the area of the site is empty");
  return polygons.front();
}

// Returns the ground as it is, where `site.terrain` is the one to keep clear of.
TerrainGrid AddTerrain(const std::filesystem::path& dem, Site& site, RepairLog& repairs) {
  Eigen::AlignedBox2d bounds = BoundsOf(site.area);
  for (const Footprint& footprint : site.footprints) {
    if (footprint.in_area) bounds.extend(BoundsOf(footprint.outline));
  }
  const ReadTerrain read = ReadDem(dem, site.origin, bounds);
  site.terrain = read.terrain;
  site.origin.height_m = read.origin_height_m;
  repairs.Add(read.repairs);
  return read.ground;
}

void AddNoFly(const std::filesystem::path& path, const PlanOptions& options, Site& site) {
  const RawMap zones = ReadAreas(path);
  site.no_fly = AreasOf(zones, CrsOfMap(zones, options.map_crs), site.origin);
}

}  // namespace

Site ReadSite(const SiteInputs& inputs, const PlanOptions& options) {
  CheckBudget(options);
  Site site;
  site.d_min_m = options.d_min_m;
  site.min_altitude_m = options.min_altitude_m;
  const double widest_margin = std::max({options.margin_m, options.altitude_m, options.d_min_m});
  Located located = Locate(inputs, options, widest_margin);
  site.origin = located.origin;
  site.crs = FrameCrs(site.origin);
  CleanedMap cleaned = CleanMap(located.map.features);
  RepairLog repairs = located.map.repairs;
  repairs.Add(cleaned.repairs);
  site.footprints = std::move(cleaned.footprints);
  if (site.footprints.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has no building of a usable size", inputs.map.string()),
                "check the coordinate system of the map: its outlines enclose no area");
  }
  MarkArea(inputs, located.area_of_interest, site, repairs);
  std::vector<MapObstacle> obstacles;
  if (inputs.obstacles) {
    obstacles = ReadObstacles(*inputs.obstacles, options, site.origin, repairs);
  }
  const HighThings things{inputs.map, site.footprints, obstacles};
  site.safe_altitude_m = SafeAltitude(things, options, repairs);
  site.warnings = AltitudeWarnings(things, site.safe_altitude_m, options.d_min_m);
  const double margin = options.margin_m > 0 ? options.margin_m : site.safe_altitude_m;
  site.area = AreaAround(site, margin);
  if (inputs.no_fly) AddNoFly(*inputs.no_fly, options, site);
  TerrainGrid ground;
  if (inputs.dem) ground = AddTerrain(*inputs.dem, site, repairs);
  AddObstacles(std::move(obstacles), site);
  PlaceOnGround(site);
  site.facades = MakeFacades(site.footprints);
  site.home = inputs.home
                  ? CheckedHome(site, PlanFromGeodetic(site.origin, ParseHome(*inputs.home)))
                  : DefaultHome(site);
  CloseOff(site);
  // Drones count heights from where they take off: a home too high would have them fly too low.
  site.home.z() = ground.HeightAt(site.home.head<2>());
  constexpr size_t kMostTakeOffPlaces = 15;
  if (!inputs.home) site.take_off = TakeOffPlaces(site, kMostTakeOffPlaces);
  for (Eigen::Vector3d& place : site.take_off) place.z() = ground.HeightAt(place.head<2>());
  site.repairs = repairs.Lines();
  return site;
}

}  // namespace stucco::plan
