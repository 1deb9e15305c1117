// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/home.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "plan/map/internal/ogr.h"
#include "site/box_grid.h"
#include "survey/error.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

constexpr double kMargin_m = 1;        // kept from everything: a drone does not take off to the cm
constexpr double kNarrowestWay_m = 1;  // between two buildings, for a pilot
constexpr double kFarthest_m = 10000;  // a home farther away from the buildings is a mistake

// What makes a place unsafe; empty where it is safe.
class Hazards {
 public:
  explicit Hazards(const Site& site) : site_(site), grid_(Boxes(site), 50) {}

  std::string At(const Eigen::Vector2d& position) const {
    for (const Polygon& zone : site_.no_fly) {
      if (Distance(zone, position) <= 0) return "inside a no-fly zone";
      if (Distance(zone, position) < kMargin_m) return "at the border of a no-fly zone";
    }
    for (const int index : grid_.Touching({position, position})) {
      const Footprint& footprint = site_.footprints[index];
      const double distance = Distance(footprint.outline, position);
      if (distance < site_.d_min_m + kMargin_m) {
        return fmt::format("{:.0f} m from building {}, where nothing may fly", distance,
                           footprint.building);
      }
    }
    return "";
  }

 private:
  static std::vector<Eigen::AlignedBox2d> Boxes(const Site& site) {
    std::vector<Eigen::AlignedBox2d> boxes;
    const double reach = site.d_min_m + kMargin_m;
    for (const Footprint& footprint : site.footprints) {
      const Eigen::AlignedBox2d box = BoundsOf(footprint.outline);
      boxes.emplace_back(box.min().array() - reach, box.max().array() + reach);
    }
    return boxes;
  }

  const Site& site_;
  BoxGrid grid_;
};

// The yards that buildings close in together, to which a pilot may have no way.
std::vector<Polygon> ClosedYards(const Site& site) {
  std::vector<Polygon> walls;
  for (const Footprint& footprint : site.footprints) {
    if (footprint.is_obstacle) continue;
    for (Polygon& wall : internal::Around(footprint.outline, kNarrowestWay_m / 2)) {
      walls.push_back(std::move(wall));
    }
  }
  std::vector<Polygon> yards;
  for (const Polygon& block : internal::Union(walls)) {
    for (size_t hole = 1; hole < block.rings.size(); ++hole) {
      yards.push_back({{block.rings[hole]}});
    }
  }
  return yards;
}

Eigen::AlignedBox2d Captured(const Site& site) {
  Eigen::AlignedBox2d bounds;
  for (const Footprint& footprint : site.footprints) {
    if (footprint.in_area) bounds.extend(BoundsOf(footprint.outline));
  }
  return bounds;
}

Eigen::Vector3d OnGround(const Site& site, const Eigen::Vector2d& position) {
  return {position.x(), position.y(), site.terrain.HeightAt(position)};
}

// Safe places in a grid over what is captured and a little beyond.
std::vector<Eigen::Vector2d> SafeGrid(const Site& site) {
  constexpr double kMostPlaces = 2500;
  constexpr double kFinest_m = 10;
  constexpr double kBeyond_m = 5;
  const Hazards hazards(site);
  const std::vector<Polygon> yards = ClosedYards(site);
  Eigen::AlignedBox2d bounds = Captured(site);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(site.d_min_m + kBeyond_m);
  bounds = {bounds.min() - margin, bounds.max() + margin};
  const double step = std::max(kFinest_m, std::sqrt(bounds.volume() / kMostPlaces));
  std::vector<Eigen::Vector2d> places;
  for (double y = bounds.min().y(); y <= bounds.max().y(); y += step) {
    for (double x = bounds.min().x(); x <= bounds.max().x(); x += step) {
      const Eigen::Vector2d place(x, y);
      const auto holds = [&](const Polygon& yard) { return Contains(yard, place); };
      if (std::ranges::none_of(yards, holds) && hazards.At(place).empty()) places.push_back(place);
    }
  }
  return places;
}

}  // namespace

std::vector<Eigen::Vector3d> TakeOffPlaces(const Site& site, size_t most) {
  constexpr double kApart_m = 40;  // nearer ones save less than it takes to carry the things there
  const std::vector<Eigen::Vector2d> places = SafeGrid(site);
  std::vector<double> away;
  away.reserve(places.size());
  for (const auto& place : places) away.push_back((place - site.home.head<2>()).norm());
  std::vector<Eigen::Vector3d> chosen;
  while (chosen.size() < most && !places.empty()) {
    const auto farthest = std::ranges::max_element(away) - away.begin();
    if (away[farthest] < kApart_m) break;
    chosen.push_back(OnGround(site, places[farthest]));
    for (size_t i = 0; i < places.size(); ++i) {
      away[i] = std::min(away[i], (places[i] - places[farthest]).norm());
    }
  }
  return chosen;
}

Geodetic ParseHome(const std::string& text) {
  static const std::regex form(R"(\s*(-?\d+(?:\.\d+)?)\s*[,; ]\s*(-?\d+(?:\.\d+)?)\s*)");
  std::smatch found;
  if (std::regex_match(text, found, form)) {
    const Geodetic home{std::stod(found[1]), std::stod(found[2])};
    if (std::abs(home.latitude_deg) < 90 && std::abs(home.longitude_deg) <= 180) return home;
  }
  throw Error(ErrorKind::kUsage, fmt::format("--home {:?}: is no latitude and longitude", text),
              "give degrees as --home 50.10419,14.40238");
}

Eigen::Vector3d DefaultHome(const Site& site) {
  const Hazards hazards(site);
  const Eigen::AlignedBox2d bounds = Captured(site);
  constexpr double kBeyond_m = 5;
  const Eigen::Vector2d start(bounds.center().x(), bounds.min().y() - site.d_min_m - kBeyond_m);
  constexpr double kStep_m = 2;
  const double farthest = 2 * bounds.diagonal().norm() + 1000;
  for (double radius = 0; radius < farthest; radius += kStep_m) {
    const int places = std::max(1, static_cast<int>(2 * std::numbers::pi * radius / kStep_m));
    for (int i = 0; i < places; ++i) {  // from the south, turning clockwise
      const double angle = 2 * std::numbers::pi * i / places;
      const Eigen::Vector2d place =
          start - radius * Eigen::Vector2d(std::sin(angle), std::cos(angle));
      if (hazards.At(place).empty()) return OnGround(site, place);
    }
  }
  throw Error(ErrorKind::kBadInput, "the no-fly zones leave no place to take off",
              "give one with --home LATITUDE,LONGITUDE or make the no-fly zones smaller");
}

Eigen::Vector3d CheckedHome(const Site& site, const Eigen::Vector2d& position) {
  const double away = Captured(site).exteriorDistance(position);
  if (!(away <= kFarthest_m)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--home: lies {:.0f} km from the buildings", away / 1000),
                "give latitude first, then longitude, as --home 50.10419,14.40238");
  }
  const std::string hazard = Hazards(site).At(position);
  if (hazard.empty()) return OnGround(site, position);
  throw Error(ErrorKind::kUsage, fmt::format("--home: lies {}", hazard),
              "give a place in the open, or none: then one is chosen south of the buildings");
}

}  // namespace stucco::plan
