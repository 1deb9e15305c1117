// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/site/made_site.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "site/facades.h"
#include "site/ground.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

// In [low, high). The distributions of the standard library differ from one library to the next.
double Uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// Within 12 m of the origin.
Ring RandomShape(std::mt19937_64& random) {
  const double width = Uniform(random, 9, 18);
  const double depth = Uniform(random, 9, 15.5);
  const double x = width / 2;
  const double y = depth / 2;
  const double wing = Uniform(random, 0.3, 0.4);
  const double cut = y - Uniform(random, 0.4, 0.6) * depth;
  const double shape = Uniform(random, 0, 1);
  if (shape < 0.5) return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  const double inner = -x + wing * width;
  if (shape < 0.8) return {{-x, -y}, {x, -y}, {x, cut}, {inner, cut}, {inner, y}, {-x, y}};
  const double other = x - wing * width;
  return {{-x, -y}, {x, -y}, {x, y}, {other, y}, {other, cut}, {inner, cut}, {inner, y}, {-x, y}};
}

Eigen::AlignedBox2d Bounds(const std::vector<Polygon>& footprints) {
  Eigen::AlignedBox2d bounds;
  for (const Polygon& footprint : footprints) bounds.extend(BoundsOf(footprint));
  return bounds;
}

}  // namespace

Site MadeSite(const std::vector<Polygon>& footprints, const MadeSiteOptions& options) {
  Site site;
  site.crs = "+proj=tmerc +lat_0=50 +lon_0=14 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m";
  site.origin = {.latitude_deg = 50, .longitude_deg = 14, .height_m = 0};
  site.no_fly = options.no_fly;
  site.terrain = options.terrain;
  site.d_min_m = options.d_min_m;
  site.safe_altitude_m = options.safe_altitude_m;
  site.min_altitude_m = options.min_altitude_m;
  for (size_t i = 0; i < footprints.size(); ++i) {
    const double height = i < options.heights_m.size() ? options.heights_m[i] : 0;
    Polygon outline = footprints[i];
    for (Ring& ring : outline.rings) ring = FromSouthWest(ring);
    site.footprints.push_back({.building = fmt::format("B{:04}", i + 1),
                               .outline = outline,
                               .z_m = {0, height},
                               .top_known = height > 0});
  }
  PlaceOnGround(site);
  site.facades = MakeFacades(site.footprints);
  const Eigen::AlignedBox2d bounds = Bounds(footprints);
  const Eigen::Vector2d low = bounds.min().array() - options.margin_m;
  const Eigen::Vector2d high = bounds.max().array() + options.margin_m;
  site.area = {{Rectangle(low.x(), low.y(), high.x(), high.y())}};
  const Eigen::Vector2d home(bounds.center().x(), bounds.min().y() - options.d_min_m - 5);
  site.home = {home.x(), home.y(), site.terrain.HeightAt(home)};
  return site;
}

Site MadeSite(const std::vector<Ring>& footprints, const MadeSiteOptions& options) {
  std::vector<Polygon> polygons;
  for (const Ring& ring : footprints) polygons.push_back({{ring}});
  return MadeSite(polygons, options);
}

Site LoneHouse() {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10)},
                  {.safe_altitude_m = 25, .heights_m = {9}});
}

Ring Rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring Reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

std::vector<Ring> RandomTown(uint64_t seed, int buildings) {
  constexpr double kLot_m = 26;  // two circles of 12 m radius fit with 2 m between them
  constexpr double kStreet_m = 16;
  std::mt19937_64 random(seed);
  const int per_side = static_cast<int>(std::ceil(std::sqrt(buildings)));
  const auto place = [&](int lot) { return kLot_m * lot + kStreet_m * (lot / 2); };
  const double middle = place(per_side - 1) / 2;
  const Eigen::Rotation2Dd grid(Uniform(random, 0, std::numbers::pi));
  std::vector<Ring> town;
  for (int i = 0; i < buildings; ++i) {
    const Eigen::Vector2d lot(place(i % per_side) - middle, place(i / per_side) - middle);
    const Eigen::Vector2d jitter(Uniform(random, -0.9, 0.9), Uniform(random, -0.9, 0.9));
    const Eigen::Rotation2Dd turn(Uniform(random, 0, 2 * std::numbers::pi));
    Ring ring = RandomShape(random);
    for (Eigen::Vector2d& corner : ring) corner = grid * (lot + jitter + turn * corner);
    town.push_back(ring);
  }
  return town;
}

}  // namespace stucco
