// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/sky_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <ranges>
#include <span>
#include <utility>

#include "survey/parallel.h"

namespace stucco::simulate::internal {
namespace {

constexpr double kSpacing_m = 0.5;
constexpr double kMostValues =
    1.5e6;  // beyond that the spacing grows: time and memory stay bounded
constexpr int kRays = 64;
constexpr int kRaysForSmall = 32;  // triangles with a single value
constexpr int kRaysForLeaves = 16;
constexpr float kLift_m = 2e-3f;   // off the surface
constexpr float kInset_m = 2e-2f;  // away from the triangle's border, where other walls stand
// A place from which most rays meet the backs of surfaces lies in a solid, or its triangle is
// turned the wrong way.
constexpr float kMostlyBacks = 0.5f;

struct Seen {
  float sky = 0;    // share of the cosine-weighted hemisphere
  float backs = 0;  // share of the rays that met the back of a surface
};

// Points of the unit square, each in its own cell of a grid and each row and column used once
// (Hammersley's set), turned round the normal by an amount that depends on the place.
Eigen::Vector2f Hammersley(int i, int count, float turn) {
  uint32_t bits = static_cast<uint32_t>(i);
  float radical = 0;
  for (float digit = 0.5f; bits != 0; bits >>= 1, digit /= 2) {
    if (bits & 1) radical += digit;
  }
  const float around = radical + turn;
  return {(static_cast<float>(i) + 0.5f) / static_cast<float>(count), around - std::floor(around)};
}

// The same for the same place, to a centimetre, so that triangles agree where they meet.
float TurnAt(const Eigen::Vector3f& place) {
  uint32_t hash = 2166136261u;
  for (int k = 0; k < 3; ++k) {
    hash ^= static_cast<uint32_t>(static_cast<int32_t>(std::lround(place[k] * 100)));
    hash *= 16777619u;
    hash ^= hash >> 15;
  }
  hash *= 2246822519u;
  hash ^= hash >> 13;
  return static_cast<float>(hash >> 8) / static_cast<float>(1u << 24);
}

Seen LookUp(const RayScene& scene, const Eigen::Vector3f& place, const Eigen::Vector3f& normal,
            int rays) {
  const Eigen::Vector3f tangent = normal.unitOrthogonal();
  const Eigen::Vector3f other = normal.cross(tangent);
  const float turn = TurnAt(place);
  Seen seen;
  for (int first = 0; first < rays; first += kLanes) {
    RayPack pack;
    for (int lane = 0; lane < kLanes; ++lane) {
      const Eigen::Vector2f s = Hammersley(first + lane, rays, turn);
      const float radius = std::sqrt(s.x());
      const float angle = 2 * std::numbers::pi_v<float> * s.y();
      pack[lane].origin = place + kLift_m * normal;
      pack[lane].direction = radius * std::cos(angle) * tangent + radius * std::sin(angle) * other +
                             std::sqrt(1 - s.x()) * normal;
    }
    const HitPack hits = scene.Nearest(pack, kLanes, {}, /*neighbours=*/false);
    for (int lane = 0; lane < kLanes; ++lane) {
      const Eigen::Vector3f& direction = pack[lane].direction;
      if (hits[lane].triangle < 0) {
        seen.sky += direction.z() > 0 ? 1.0f : 0.0f;
        continue;
      }
      const Surface& surface = scene.surface(hits[lane].triangle);
      const bool leaf = scene.scene().materials[surface.material].cut_out;
      if (!leaf && surface.normal.dot(direction) > 0) seen.backs += 1;
    }
  }
  seen.sky /= static_cast<float>(rays);
  seen.backs /= static_cast<float>(rays);
  return seen;
}

// What the sky gives to a place on a surface, or nothing known (negative) inside solids.
float SkyAt(const RayScene& scene, const Eigen::Vector3f& place, const Surface& surface, int rays) {
  // Leaves let light through: what counts is how open the sky above them is.
  if (scene.scene().materials[surface.material].cut_out) {
    return LookUp(scene, place, Eigen::Vector3f::UnitZ(), kRaysForLeaves).sky;
  }
  const Seen front = LookUp(scene, place, surface.normal, rays);
  const bool is_free = front.backs <= kMostlyBacks;
  if (is_free && front.sky > 0) return front.sky;
  // Turned the wrong way: in a model that is closed, or of one sheet with nothing below.
  const Seen back = LookUp(scene, place, -surface.normal, rays);
  if (back.backs <= kMostlyBacks && back.sky > 0) return back.sky;
  return is_free ? 0 : -1;
}

float Distance(const Scene& scene, const Eigen::Vector3i& triangle, int a, int b) {
  return (scene.positions[triangle[a]] - scene.positions[triangle[b]]).norm();
}

bool IsUnknown(float value) {
  return value < 0;
}

// Of what is known of a value of a grid and of those around it; where nothing is, the value.
float MeanAround(const std::vector<float>& values, int width, int row, int column) {
  const int height = static_cast<int>(values.size()) / width;
  float sum = 0;
  int known = 0;
  for (int r = std::max(0, row - 1); r <= std::min(height - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(width - 1, column + 1); ++c) {
      const float neighbour = values[static_cast<size_t>(r) * width + c];
      if (IsUnknown(neighbour)) continue;
      sum += neighbour;
      ++known;
    }
  }
  return known > 0 ? sum / static_cast<float>(known)
                   : values[static_cast<size_t>(row) * width + column];
}

}  // namespace

SkyLight::SkyLight(const RayScene& scene) {
  LayOut(scene);
  // By rows, since one triangle may be the whole ground.
  std::vector<std::pair<int, int>> rows;
  for (size_t i = 0; i < grids_.size(); ++i) {
    for (int row = 0; row <= grids_[i].rows; ++row) rows.emplace_back(static_cast<int>(i), row);
  }
  constexpr size_t kRowsPerUnit = 64;
  const size_t units = (rows.size() + kRowsPerUnit - 1) / kRowsPerUnit;
  ParallelFor(units, std::numeric_limits<int>::max(), [&](size_t unit) {
    const size_t end = std::min(rows.size(), (unit + 1) * kRowsPerUnit);
    for (size_t i = unit * kRowsPerUnit; i < end; ++i) {
      ComputeRow(scene, rows[i].first, rows[i].second);
    }
  });
  for (const Grid& grid : grids_) FillUnknown(grid);
}

SkyLight::Grid SkyLight::GridOf(const Scene& model, size_t triangle, double spacing) {
  const Eigen::Vector3i& t = model.triangles[triangle];
  const std::array<float, 3> sides = {Distance(model, t, 1, 2), Distance(model, t, 2, 0),
                                      Distance(model, t, 0, 1)};
  Grid grid;
  grid.apex = static_cast<uint8_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const double base = sides[grid.apex];
  const bool leaf = model.materials[model.materials_of[triangle]].cut_out;
  if (!(base > spacing) || leaf) return grid;
  const Eigen::Vector3f along =
      model.positions[t[(grid.apex + 2) % 3]] - model.positions[t[(grid.apex + 1) % 3]];
  const Eigen::Vector3f aside =
      model.positions[t[grid.apex]] - model.positions[t[(grid.apex + 1) % 3]];
  const double height = along.cross(aside).norm() / base;
  const auto cells = [&](double length) {
    return static_cast<uint16_t>(std::clamp(std::ceil(length / spacing), 1.0, 60000.0));
  };
  grid.columns = cells(base);
  grid.rows = cells(height);
  return grid;
}

void SkyLight::LayOut(const RayScene& scene) {
  const Scene& model = scene.scene();
  grids_.resize(model.triangles.size());
  for (double spacing = kSpacing_m;; spacing *= 1.5) {
    size_t values = 0;
    for (size_t i = 0; i < grids_.size(); ++i) {
      grids_[i] = GridOf(model, i, spacing);
      grids_[i].first = values;
      values += static_cast<size_t>(grids_[i].columns + 1) * (grids_[i].rows + 1);
    }
    // One value each cannot be undercut.
    if (static_cast<double>(values) <=
        std::max(kMostValues, 1.5 * static_cast<double>(grids_.size()))) {
      values_.assign(values, 0);
      return;
    }
  }
}

void SkyLight::ComputeRow(const RayScene& scene, int triangle, int row) {
  const Grid& grid = grids_[triangle];
  const Surface& surface = scene.surface(triangle);
  if (surface.normal.isZero()) return;  // without area: nobody sees it
  const Eigen::Vector3i& t = scene.scene().triangles[triangle];
  const auto corner = [&](int k) { return scene.scene().positions[t[(grid.apex + k) % 3]]; };
  const Eigen::Vector3f centre = (corner(0) + corner(1) + corner(2)) / 3;
  float* values = &values_[grid.first + static_cast<size_t>(row) * (grid.columns + 1)];
  if (grid.columns == 0) {
    *values = SkyAt(scene, centre, surface, kRaysForSmall);
    return;
  }
  const float up = static_cast<float>(row) / static_cast<float>(grid.rows);
  for (int column = 0; column <= grid.columns; ++column) {
    if (row == grid.rows && column > 0) {  // all the same place: the apex
      values[column] = values[0];
      continue;
    }
    const float along = static_cast<float>(column) / static_cast<float>(grid.columns);
    const Eigen::Vector3f place =
        up * corner(0) + (1 - up) * ((1 - along) * corner(1) + along * corner(2));
    const Eigen::Vector3f inwards = centre - place;
    const float inset = std::min(kInset_m, 0.25f * inwards.norm());
    values[column] = SkyAt(scene, place + inset * inwards.normalized(), surface, kRays);
  }
}

// Places inside solids take over from the places around them, step by step; what is still unknown
// then is dark.
void SkyLight::FillUnknown(const Grid& grid) {
  constexpr int kSteps = 4;
  const int width = grid.columns + 1;
  const int height = grid.rows + 1;
  float* values = &values_[grid.first];
  for (int step = 0; step < kSteps; ++step) {
    const std::span<const float> now(values, static_cast<size_t>(width) * height);
    if (std::ranges::none_of(now, IsUnknown)) return;
    const std::vector<float> before(now.begin(), now.end());
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const size_t i = static_cast<size_t>(row) * width + column;
        if (IsUnknown(before[i])) values[i] = MeanAround(before, width, row, column);
      }
    }
  }
  for (int i = 0; i < width * height; ++i) values[i] = std::max(0.0f, values[i]);
}

float SkyLight::At(int triangle, float b1, float b2) const {
  const Grid& grid = grids_[triangle];
  if (grid.columns == 0) return values_[grid.first];
  const std::array<float, 3> weights = {1 - b1 - b2, b1, b2};
  const float up = std::clamp(weights[grid.apex], 0.0f, 1.0f);
  const float left = weights[(grid.apex + 1) % 3];
  const float right = weights[(grid.apex + 2) % 3];
  const float along = std::clamp(right / std::max(left + right, 1e-9f), 0.0f, 1.0f);
  const float x = along * static_cast<float>(grid.columns);
  const float y = up * static_cast<float>(grid.rows);
  const int column = std::min(static_cast<int>(x), grid.columns - 1);
  const int row = std::min(static_cast<int>(y), grid.rows - 1);
  const float tx = x - static_cast<float>(column);
  const float ty = y - static_cast<float>(row);
  const float* below =
      &values_[grid.first + static_cast<size_t>(row) * (grid.columns + 1) + column];
  const float* above = below + grid.columns + 1;
  const float low = below[0] + tx * (below[1] - below[0]);
  const float high = above[0] + tx * (above[1] - above[0]);
  return low + ty * (high - low);
}

}  // namespace stucco::simulate::internal
