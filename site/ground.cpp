// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/ground.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "survey/geometry2d.h"

namespace stucco {
namespace {

// How far around a position ground may rise and still lift the ceiling over it: more than a drone
// strays from its path.
constexpr double kCeilingReach_m = 30;

struct Grid {
  Eigen::AlignedBox2d bounds;
  double step_m = 1;

  int columns() const { return static_cast<int>(std::ceil(bounds.sizes().x() / step_m)) + 1; }
  int rows() const { return static_cast<int>(std::ceil(bounds.sizes().y() / step_m)) + 1; }
  Eigen::Vector2d At(int column, int row) const {
    return bounds.min() + step_m * Eigen::Vector2d(column, row);
  }
};

Grid CeilingGrid(const Site& site) {
  const TerrainGrid& terrain = site.terrain;
  const double step = terrain.step_m;
  const Eigen::Vector2d size = step * Eigen::Vector2d(terrain.columns - 1, terrain.rows - 1);
  const double steps = std::ceil(kCeilingReach_m / step) + 1;
  Eigen::AlignedBox2d bounds(terrain.corner, terrain.corner + size);
  for (const Footprint& footprint : site.footprints) {
    bounds.extend(BoundsOf(footprint.outline));
  }
  // Samples of the ceiling lie over samples of the ground.
  const Eigen::Vector2d reach(steps * step + site.d_min_m, steps * step + site.d_min_m);
  const Eigen::Array2d shift = ((bounds.min() - reach - terrain.corner) / step).array().floor();
  bounds.min() = terrain.corner + step * shift.matrix();
  bounds.max() += reach;
  return {bounds, step};
}

// Each value becomes the highest of those up to `reach` before and behind it, `stride` apart.
void SpreadHighest(std::vector<float>& values, size_t first, size_t stride, int count, int reach) {
  std::vector<float> line(count);
  for (int i = 0; i < count; ++i) line[i] = values[first + stride * i];
  for (int i = 0; i < count; ++i) {
    values[first + stride * i] = *std::max_element(line.begin() + std::max(0, i - reach),
                                                   line.begin() + std::min(count, i + reach + 1));
  }
}

// Samples that are high enough for every point of the cells around them, so that interpolating
// between them is nowhere too low.
TerrainGrid CeilingOf(const Site& site) {
  const Grid grid = CeilingGrid(site);
  const double step = grid.step_m;
  TerrainGrid ceiling{.corner = grid.bounds.min(),
                      .step_m = step,
                      .columns = grid.columns(),
                      .rows = grid.rows(),
                      .z_m = {}};
  std::vector<float>& z = ceiling.z_m;
  z.resize(static_cast<size_t>(ceiling.columns) * ceiling.rows);
  const auto index = [&](int column, int row) {
    return static_cast<size_t>(row) * ceiling.columns + column;
  };
  const auto rounded_up = [](double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
  };
  for (int row = 0; row < ceiling.rows; ++row) {
    for (int column = 0; column < ceiling.columns; ++column) {
      z[index(column, row)] =
          rounded_up(site.terrain.HeightAt(grid.At(column, row)) + site.safe_altitude_m);
    }
  }
  const int reach = static_cast<int>(std::ceil(kCeilingReach_m / step)) + 1;
  for (int row = 0; row < ceiling.rows; ++row) {
    SpreadHighest(z, index(0, row), 1, ceiling.columns, reach);
  }
  for (int column = 0; column < ceiling.columns; ++column) {
    SpreadHighest(z, column, ceiling.columns, ceiling.rows, reach);
  }
  const double beside = site.d_min_m + std::numbers::sqrt2 * step;
  for (const Footprint& footprint : site.footprints) {
    const Eigen::AlignedBox2d box = BoundsOf(footprint.outline);
    const Eigen::Array2d low = ((box.min() - ceiling.corner).array() - beside) / step;
    const Eigen::Array2d high = ((box.max() - ceiling.corner).array() + beside) / step;
    for (int row = std::max(0.0, low.y()); row <= std::min(ceiling.rows - 1.0, high.y()); ++row) {
      for (int column = std::max(0.0, low.x()); column <= std::min(ceiling.columns - 1.0, high.x());
           ++column) {
        float& at = z[index(column, row)];
        if (at >= footprint.blocked_to_m) continue;
        if (Distance(footprint.outline, grid.At(column, row)) > beside) continue;
        at = rounded_up(footprint.blocked_to_m);
      }
    }
  }
  return ceiling;
}

}  // namespace

Interval GroundUnder(const Polygon& polygon, const TerrainGrid& terrain) {
  if (terrain.IsFlat()) return {};
  Interval ground{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  const auto add = [&](const Eigen::Vector2d& position) {
    const double z = terrain.HeightAt(position);
    ground = {std::min(ground.from_m, z), std::max(ground.to_m, z)};
  };
  for (const Ring& ring : polygon.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d along = ring[(i + 1) % ring.size()] - ring[i];
      const int steps = 1 + static_cast<int>(2 * along.norm() / terrain.step_m);
      for (int k = 0; k < steps; ++k) add(ring[i] + k * along / steps);
    }
  }
  const Eigen::AlignedBox2d box = BoundsOf(polygon);
  for (double y = box.min().y(); y < box.max().y(); y += terrain.step_m) {
    for (double x = box.min().x(); x < box.max().x(); x += terrain.step_m) {
      if (Contains(polygon, {x, y})) add({x, y});
    }
  }
  return ground;
}

namespace {

// Heights above `ground` as z. `highest_top` bounds a top that is not known.
Interval OnGround(const Footprint& footprint, const Interval& ground, double highest_top) {
  const Interval& above = footprint.z_m;
  const double foot = above.from_m + ground.from_m;
  if (footprint.top_known) return {foot, above.to_m + ground.from_m};
  const bool is_expected = above.to_m > above.from_m;
  const double top = is_expected ? std::min(above.to_m + ground.to_m, highest_top) : highest_top;
  return {foot, std::max(foot, top)};
}

}  // namespace

void PlaceOnGround(Site& site) {
  struct Building {
    Interval ground{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
    bool tops_known = true;
  };
  std::map<std::string, Building> buildings;
  for (const Footprint& footprint : site.footprints) {
    Building& building = buildings[footprint.building];
    const Interval ground = GroundUnder(footprint.outline, site.terrain);
    building.ground = {std::min(building.ground.from_m, ground.from_m),
                       std::max(building.ground.to_m, ground.to_m)};
    building.tops_known = building.tops_known && footprint.top_known;
  }
  for (Footprint& footprint : site.footprints) {
    const Building& building = buildings.at(footprint.building);
    const double highest_blocked = building.ground.to_m + site.safe_altitude_m;
    footprint.z_m = OnGround(footprint, building.ground, highest_blocked - site.d_min_m);
    footprint.blocked_to_m =
        building.tops_known ? footprint.z_m.to_m + site.d_min_m : highest_blocked;
    const bool unknown = footprint.overgrown_to_m == std::numeric_limits<double>::infinity();
    footprint.blocked_to_m =
        std::max(footprint.blocked_to_m,
                 unknown ? highest_blocked : footprint.overgrown_to_m + site.d_min_m);
  }
  site.ceiling = site.terrain.IsFlat() ? TerrainGrid{} : CeilingOf(site);
}

}  // namespace stucco
