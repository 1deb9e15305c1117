// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/abstract.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>

#include "proxy/facets/facets.h"
#include "proxy/facets/not_shown.h"
#include "proxy/facets/plane_view.h"
#include "proxy/map/map_solids.h"
#include "proxy/map/off_the_map.h"
#include "proxy/map/outlines.h"
#include "proxy/map/stable_ids.h"
#include "proxy/map/wall_facets.h"
#include "proxy/planes/consolidate.h"
#include "proxy/scene/ground.h"
#include "proxy/scene/scene.h"
#include "proxy/solids/party_walls.h"
#include "proxy/solids/solid.h"
#include "proxy/solids/soundness.h"
#include "proxy/solids/written_check.h"
#include "proxy/terrain/terrain.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// Of a building that the cloud shows and no map names: buildings of maps have ids that begin with
// B.
std::string ClusterId(size_t number) {
  return fmt::format("C{:04}", number + 1);
}

// All planes of a scene in one row: the buildings' first, then the ground's.
struct PlaneTable {
  std::vector<Plane> planes;
  std::vector<int> building;  // -1: ground
  size_t named = 0;           // buildings that have taken names for clusters already
};

PlaneTable TableOf(const PlanarScene& scene, size_t named) {
  PlaneTable table;
  table.named = named;
  for (size_t b = 0; b < scene.buildings.size(); ++b) {
    for (const Plane& plane : scene.buildings[b]) {
      table.planes.push_back(plane);
      table.building.push_back(static_cast<int>(b));
    }
  }
  for (const Plane& plane : scene.ground) {
    table.planes.push_back(plane);
    table.building.push_back(-1);
  }
  return table;
}

// The open facets of each plane, cut along the planes of its own building and the ground. Sets
// `warnings` to what went wrong.
std::vector<std::vector<Facet>> OpenFacets(const PlanarScene& scene, const PlaneTable& table,
                                           const std::vector<PlaneView>& views, int threads,
                                           std::vector<std::string>& warnings) {
  std::vector<std::vector<Facet>> facets(views.size());
  std::vector<std::vector<std::string>> of_planes(views.size());
  ParallelFor(views.size(), threads, [&](size_t p) {
    const bool ground = table.building[p] < 0;
    std::vector<const PlaneView*> others;
    for (size_t q = 0; q < views.size(); ++q) {
      const bool other_ground = table.building[q] < 0;
      if (ground ? !other_ground : other_ground || table.building[q] == table.building[p]) {
        others.push_back(&views[q]);
      }
    }
    const auto outline = [&] {
      const auto creases = Creases(views[p], others, scene.tolerances.fill_gap,
                                   3 * scene.tolerances.level_of_detail);
      return OutlineFacets(scene.samples, views[p], creases, scene.tolerances, ground);
    };
    facets[p] = OutlineOrWarn(outline, of_planes[p]);
  });
  warnings.clear();
  for (size_t p = 0; p < views.size(); ++p) {
    const std::string owner =
        table.building[p] < 0 ? "G0" : ClusterId(table.named + table.building[p]);
    for (const auto& warning : of_planes[p]) {
      warnings.push_back(fmt::format("{}: {}", owner, warning));
    }
  }
  return facets;
}

// Takes apart what made no facet of its own and is a part of what did; true where anything was.
bool TakeApart(const PlanarScene& scene, const std::vector<std::vector<Facet>>& facets,
               const ProxyOptions& options, PlaneTable& table) {
  PlaneUse use{.idle = std::vector<bool>(table.planes.size()), .building = table.building};
  for (size_t p = 0; p < facets.size(); ++p) {
    use.idle[p] = table.building[p] >= 0 && facets[p].empty();
  }
  if (std::find(use.idle.begin(), use.idle.end(), true) == use.idle.end()) return false;
  TakeApartIdle(scene.samples, scene.tolerances, options.normal_angle_deg, use, table.planes);
  const auto gone = [](const Plane& plane) { return plane.points.empty(); };
  if (std::none_of(table.planes.begin(), table.planes.end(), gone)) return false;
  PlaneTable left;
  left.named = table.named;
  for (size_t p = 0; p < table.planes.size(); ++p) {
    if (gone(table.planes[p])) continue;
    left.planes.push_back(std::move(table.planes[p]));
    left.building.push_back(table.building[p]);
  }
  table = std::move(left);
  return true;
}

// A solid that is none in the files stays open.
void RequireSoundAsWritten(const Eigen::Vector3d& up, Solid& solid) {
  if (solid.facets.empty()) return;
  const Eigen::Matrix3d upright_from_world = UprightFromWorld(up);
  const auto fault =
      FindFaultAsWritten(Turned(solid.facets, upright_from_world), upright_from_world.transpose());
  if (!fault) return;
  solid.why_not = *fault;
  solid.facets.clear();
}

// Closes each building where its planes and points allow it; empty solids otherwise.
std::vector<Solid> CloseBuildings(const PlanarScene& scene, const PlaneTable& table,
                                  const std::vector<PlaneView>& views, const ProxyOptions& options,
                                  int threads) {
  std::vector<Solid> solids(scene.buildings.size());
  ParallelFor(solids.size(), threads, [&](size_t b) {
    std::vector<const PlaneView*> own;
    for (size_t p = 0; p < views.size(); ++p) {
      if (table.building[p] == static_cast<int>(b)) own.push_back(&views[p]);
    }
    const Plane* ground = GroundBelow(scene.samples, scene.up, scene.ground, scene.buildings[b]);
    solids[b] = CloseOrExplain([&] {
      return CloseBuilding(
          scene, own, ground,
          {.max_planes = options.max_planes, .least_support = options.solid_support});
    });
  });
  return solids;
}

// The ground last; facets that are open.
std::vector<Building> OpenBuildings(const PlaneTable& table, size_t buildings,
                                    std::vector<std::vector<Facet>> facets) {
  std::vector<Building> open;
  for (size_t b = 0; b < buildings; ++b) {
    open.push_back({.id = ClusterId(table.named + b),
                    .watertight = false,
                    .source = "cloud",
                    .detail = {},
                    .facets = {}});
  }
  open.push_back({.id = "G0", .watertight = false, .source = "cloud", .detail = {}, .facets = {}});
  for (size_t p = 0; p < facets.size(); ++p) {
    Building& building = table.building[p] < 0 ? open.back() : open[table.building[p]];
    for (Facet& facet : facets[p]) building.facets.push_back(std::move(facet));
  }
  return open;
}

// Buildings take their solids, where they close. Beside the map's buildings stand trees: with
// `mapped`, what does not close is none.
void TakeSolids(std::vector<Solid> solids, bool mapped, std::vector<Building>& buildings,
                ProxyFindings& findings) {
  for (size_t b = 0; b < solids.size(); ++b) {
    Building& building = buildings[b];
    building.watertight = !solids[b].facets.empty();
    if (building.watertight) {
      building.facets = std::move(solids[b].facets);
      if (mapped) {
        findings.of_map.push_back({fmt::format("{}: stands on no footprint of the map, {} facets",
                                               building.id, building.facets.size())});
      }
      findings.notes.push_back(fmt::format("{}: closed, points cover {:.0f} % of it", building.id,
                                           100 * solids[b].support));
      continue;
    }
    findings.notes.push_back(building.id + (mapped ? ": left out" : ": open facets") +
                             ", because as a solid " + solids[b].why_not);
    if (mapped) building.facets.clear();
  }
}

// Takes facets off the planes of open buildings that are laid through leaves.
void TakeLeaves(const PlanarScene& scene, const PlaneTable& table,
                std::vector<std::vector<Facet>>& facets) {
  for (size_t p = 0; p < facets.size(); ++p) {
    if (table.building[p] < 0 || facets[p].empty()) continue;
    if (IsOfLeaves(scene, table.planes[p])) facets[p].clear();
  }
}

// Without a map: what does not close and shows no face as large as a house's smallest is a tree, a
// car or a hedge: a crown is fitted by planes of a few square metres, a house that is seen from one
// side has a wall or a roof.
void LeaveOutSmallThings(std::vector<Building>& buildings, ProxyFindings& findings) {
  constexpr double kLeastFace_m2 = 10;
  for (Building& building : buildings) {
    if (building.watertight || building.id == "G0") continue;
    double largest = 0;
    for (const Facet& facet : building.facets) largest = std::max(largest, facet.area);
    if (largest >= kLeastFace_m2) continue;
    findings.notes.push_back(
        fmt::format("{}: left out: no building, its largest face that is none of leaves has "
                    "{:.1f} m2",
                    building.id, largest));
    building.facets.clear();
  }
}

// The ground as it rises and falls, where its planes do not show that.
void FollowTerrain(const PlanarScene& scene, std::vector<Building>& buildings,
                   ProxyFindings& findings) {
  auto terrain = TerrainFacets(scene, buildings);
  if (terrain.empty()) return;
  findings.notes.push_back(fmt::format("the ground is no plane: {} triangles", terrain.size()));
  const auto ground = std::ranges::find(buildings, "G0", &Building::id);
  ground->facets = std::move(terrain);
}

// Says what the cloud shows of buildings and no facet does.
void NameNotShown(const PlanarScene& scene, std::span<const Plane> planes, const Proxy& proxy,
                  int threads, ProxyFindings& findings) {
  for (const NotShown& part : FindNotShown(scene, planes, proxy.buildings, threads)) {
    const char* what = part.role == PlaneRole::kWall      ? "a wall"
                       : part.role == PlaneRole::kCeiling ? "an underside"
                                                          : "a roof";
    findings.of_model.push_back(
        fmt::format("{}: the cloud shows {} that is no facet, {:.0f} {}, at {:.1f}, {:.1f}, {:.1f}",
                    part.building, what, part.area, proxy.metric ? "m2" : "square units",
                    part.middle.x(), part.middle.y(), part.middle.z()));
  }
}

std::vector<Plane> PlanesOfBuildings(const PlanarScene& scene) {
  std::vector<Plane> planes;
  for (const std::vector<Plane>& cluster : scene.buildings) {
    planes.insert(planes.end(), cluster.begin(), cluster.end());
  }
  return planes;
}

// By place, where north is known.
void NameFacets(const Georef& georef, std::vector<Building>& buildings) {
  const bool z_is_up = georef.metric && georef.frame == "enu";
  for (Building& building : buildings) {
    if (z_is_up && building.id != "G0") {
      AssignIdsByPlace(building);
    } else {
      AssignIds(building);
    }
  }
}

bool GoesByMap(const ProxyInput& input, const ProxyOptions& options) {
  return options.use_map && options.solids && input.plan && input.georef.metric &&
         input.georef.frame == "enu";
}

}  // namespace

Proxy AbstractCloud(const ProxyInput& input, const ProxyOptions& options, int threads,
                    ProxyFindings& findings) {
  PlanarScene scene = UnderstandCloud(input, options, threads, findings);
  std::optional<MapModel> mapped;
  if (GoesByMap(input, options)) mapped = BuildFromMap(scene, input, options, threads, findings);
  MapModel closed;  // on footprints
  if (mapped) {
    closed = std::move(*mapped);
  } else if (options.solids && input.georef.metric) {
    closed = BuildWithoutMap(scene, input, options, threads, findings);
  }
  const std::vector<Plane> planes = PlanesOfBuildings(scene);
  if (!closed.outlines.empty()) scene.buildings = OffTheMap(scene, closed.outlines, findings);
  const auto named = std::ranges::count(closed.buildings, "cloud", &Building::source);
  PlaneTable table = TableOf(scene, static_cast<size_t>(named));
  const auto view = [&] {
    return ViewPlanes(scene, table.planes, table.planes.size() - scene.ground.size(), threads);
  };
  auto views = view();
  std::vector<std::string> warnings;
  auto facets = OpenFacets(scene, table, views, threads, warnings);
  // Beside the map's buildings only solids count, which are made of planes.
  if (!mapped && TakeApart(scene, facets, options, table)) {
    views = view();
    facets = OpenFacets(scene, table, views, threads, warnings);
  }
  findings.warnings.insert(findings.warnings.end(), warnings.begin(), warnings.end());
  Proxy proxy;
  proxy.up = scene.up;
  proxy.metric = input.georef.metric;
  if (proxy.metric) TakeLeaves(scene, table, facets);
  proxy.buildings = OpenBuildings(table, scene.buildings.size(), std::move(facets));
  if (options.solids) {
    auto solids = CloseBuildings(scene, table, views, options, threads);
    ParallelFor(proxy.metric ? solids.size() : 0, threads,
                [&](size_t b) { RequireSoundAsWritten(scene.up, solids[b]); });
    TakeSolids(std::move(solids), mapped.has_value(), proxy.buildings, findings);
  }
  if (proxy.metric && !mapped) LeaveOutSmallThings(proxy.buildings, findings);
  proxy.buildings.insert(proxy.buildings.begin(), std::make_move_iterator(closed.buildings.begin()),
                         std::make_move_iterator(closed.buildings.end()));
  FollowTerrain(scene, proxy.buildings, findings);
  std::erase_if(proxy.buildings, [](const Building& building) { return building.facets.empty(); });
  if (proxy.buildings.empty()) {
    throw Error(ErrorKind::kStageFailed,
                "the planes in the dense cloud are too small or too thin for a single facet",
                "Lower proxy.level_of_detail or proxy.min_area, or look at dense/cloud.ply.");
  }
  NameFacets(input.georef, proxy.buildings);
  if (proxy.metric) MeasureParty(proxy.up, proxy.buildings);
  NameNotShown(scene, planes, proxy, threads, findings);
  return proxy;
}

}  // namespace stucco
