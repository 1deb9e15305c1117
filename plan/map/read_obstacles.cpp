// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/read_obstacles.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "plan/map/internal/ogr.h"
#include "plan/map/map_crs.h"
#include "plan/map/read_map.h"
#include "site/box_grid.h"
#include "site/facades.h"
#include "site/ground.h"
#include "survey/error.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

// Walls nearer than kSnap_m would be one.
constexpr double kGap_m = kSnap_m + 0.01;
constexpr double kCell_m = 30;

double HeightOf(const MapObstacle& obstacle) {
  return obstacle.height_m.value_or(std::numeric_limits<double>::infinity());
}

// Valid polygons in place of one; a lamp post is small and stays, unlike what is no building.
std::vector<Polygon> ValidParts(const Polygon& polygon) {
  constexpr double kLeastArea_m2 = 0.01;
  const auto valid = internal::MadeValid(*internal::ToOgr(polygon));
  std::vector<Polygon> parts = valid ? internal::OrientedPolygons(*valid) : std::vector<Polygon>{};
  std::erase_if(parts, [](const Polygon& part) { return !(Area(part) >= kLeastArea_m2); });
  return parts;
}

// Maps and plans carry millimetres.
Polygon InMillimetres(Polygon polygon) {
  for (Ring& ring : polygon.rings) {
    for (Eigen::Vector2d& corner : ring) corner = (corner * 1000).array().round() / 1000;
  }
  return polygon;
}

std::vector<Polygon> OutlinesOf(const MapFeature& feature) {
  std::vector<Polygon> outlines;
  for (const Polygon& polygon : feature.polygons) {
    const bool finite = std::ranges::all_of(polygon.rings, [](const Ring& ring) {
      return std::ranges::all_of(ring, [](const auto& corner) { return corner.allFinite(); });
    });
    if (!finite || polygon.rings.empty()) continue;
    const std::vector<Polygon> shapes = feature.radius_m > 0
                                            ? internal::Around(polygon.rings[0], feature.radius_m)
                                            : std::vector<Polygon>{polygon};
    for (const Polygon& shape : shapes) {
      for (Polygon& part : ValidParts(shape)) outlines.push_back(std::move(part));
    }
  }
  return outlines;
}

// Cuts obstacles one after the other, the highest first.
class Cutter {
 public:
  Cutter(const std::vector<MapObstacle>& obstacles, Site& site)
      : obstacles_(obstacles),
        site_(site),
        buildings_(site.footprints.size()),
        near_(Boxes(site.footprints, obstacles), kCell_m) {}

  void Cut() {
    pieces_.resize(obstacles_.size());
    for (size_t i = 0; i < obstacles_.size(); ++i) CutOne(i);
    for (size_t i = 0; i < obstacles_.size(); ++i) {
      for (Polygon& piece : pieces_[i]) {
        site_.footprints.push_back({.building = obstacles_[i].id,
                                    .outline = std::move(piece),
                                    .z_m = {0, obstacles_[i].height_m.value_or(0)},
                                    .top_known = obstacles_[i].height_m.has_value(),
                                    .in_area = false,
                                    .is_obstacle = true});
      }
    }
  }

 private:
  // Of the buildings, then of the obstacles.
  static std::vector<Eigen::AlignedBox2d> Boxes(const std::vector<Footprint>& footprints,
                                                const std::vector<MapObstacle>& obstacles) {
    std::vector<Eigen::AlignedBox2d> boxes;
    const Eigen::Vector2d gap(kGap_m, kGap_m);
    const auto add = [&](const Polygon& outline) {
      const Eigen::AlignedBox2d box = BoundsOf(outline);
      boxes.emplace_back(box.min() - gap, box.max() + gap);
    };
    for (const Footprint& footprint : footprints) add(footprint.outline);
    for (const MapObstacle& obstacle : obstacles) add(obstacle.outline);
    return boxes;
  }

  void CutOne(size_t index) {
    const MapObstacle& obstacle = obstacles_[index];
    const double top = GroundUnder(obstacle.outline, site_.terrain).from_m + HeightOf(obstacle);
    std::vector<Polygon> winners;
    const auto add_around = [&](const Polygon& outline) {
      for (Polygon& part : internal::Around(outline, kGap_m)) winners.push_back(std::move(part));
    };
    for (const int other : near_.Touching(BoundsOf(obstacle.outline))) {
      if (other < static_cast<int>(buildings_)) {
        Footprint& footprint = site_.footprints[other];
        add_around(footprint.outline);
        if (!internal::InteriorsMeet(footprint.outline, obstacle.outline)) continue;
        footprint.overgrown_to_m = std::max(footprint.overgrown_to_m, top);
      } else if (static_cast<size_t>(other) < buildings_ + index) {
        for (const Polygon& piece : pieces_[other - buildings_]) add_around(piece);
      }
    }
    for (const Polygon& rest : internal::Difference(obstacle.outline, winners)) {
      for (const Polygon& part : ValidParts(InMillimetres(rest))) {
        pieces_[index].push_back(part);
      }
    }
  }

  const std::vector<MapObstacle>& obstacles_;
  Site& site_;
  size_t buildings_;
  BoxGrid near_;
  std::vector<std::vector<Polygon>> pieces_;  // of each obstacle
};

}  // namespace

std::vector<MapObstacle> ReadObstacles(const std::filesystem::path& path,
                                       const PlanOptions& options, const PlanOrigin& origin,
                                       RepairLog& repairs) {
  RawMap map = ReadObstacleMap(path);
  MoveToPlan(map, CrsOfMap(map, options.map_crs), origin);
  std::vector<MapObstacle> obstacles;
  for (MapFeature& feature : map.features) {
    // O0003 instead of B0003, which may be a building.
    const std::string id = "O" + feature.building.substr(1);
    const std::vector<Polygon> outlines = OutlinesOf(feature);
    if (outlines.empty()) repairs.Add(id, "obstacle without an area; left out");
    for (const Polygon& outline : outlines) {
      obstacles.push_back({id, outline, feature.height_m});
    }
  }
  for (const std::string& line : map.repairs.Lines()) repairs.Add("", "obstacles: " + line);
  if (!obstacles.empty()) return obstacles;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: has no obstacle of a usable size", path.string()),
              "check its coordinate system, or leave the option out");
}

void AddObstacles(std::vector<MapObstacle> obstacles, Site& site) {
  Eigen::AlignedBox2d reach = BoundsOf(site.area);
  for (const Footprint& footprint : site.footprints) reach.extend(BoundsOf(footprint.outline));
  std::erase_if(obstacles, [&](const MapObstacle& obstacle) {
    const Eigen::AlignedBox2d box = BoundsOf(obstacle.outline);
    return reach.squaredExteriorDistance(box) > kSurroundings_m * kSurroundings_m;
  });
  std::ranges::stable_sort(obstacles, std::greater<>{}, HeightOf);
  Cutter(obstacles, site).Cut();
}

}  // namespace stucco::plan
