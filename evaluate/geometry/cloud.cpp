// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "survey/ply.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

constexpr uint64_t kMostForError = 500000;  // the 95th percentile is then known to 0.03 %
constexpr size_t kSurfaceSamples = 200000;
constexpr uint64_t kSeed = 1;

// Finds points near a given one: cells twice as wide as the radius, so that eight hold all.
class PointGrid {
 public:
  PointGrid(std::span<const SurfacePoint> points, double radius)
      : points_(points), radius_(radius), found_(points.size(), 0) {
    for (size_t i = 0; i < points.size(); ++i) {
      cells_[CellOf(points[i].position)].push_back(static_cast<uint32_t>(i));
    }
  }

  // Marks every point within the radius of `place`.
  void Mark(const Vector3d& place) {
    const Cell base = CellOf(place - Vector3d::Constant(radius_));
    for (int corner = 0; corner < 8; ++corner) {
      const Cell cell = {base[0] + (corner & 1), base[1] + (corner >> 1 & 1),
                         base[2] + (corner >> 2)};
      const auto in_cell = cells_.find(cell);
      if (in_cell == cells_.end()) continue;
      for (const uint32_t i : in_cell->second) {
        if ((points_[i].position - place).squaredNorm() <= radius_ * radius_) found_[i] = 1;
      }
    }
  }
  const std::vector<char>& found() const { return found_; }

 private:
  using Cell = std::array<int64_t, 3>;
  struct HashCell {
    size_t operator()(const Cell& cell) const {
      uint64_t hash = 0;
      for (const int64_t number : cell) {
        hash = (hash ^ static_cast<uint64_t>(number)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
      }
      return hash;
    }
  };
  Cell CellOf(const Vector3d& place) const {
    Cell cell;
    for (int i = 0; i < 3; ++i) {
      cell[static_cast<size_t>(i)] = static_cast<int64_t>(std::floor(place[i] / (2 * radius_)));
    }
    return cell;
  }

  std::span<const SurfacePoint> points_;
  double radius_;
  std::vector<char> found_;
  std::unordered_map<Cell, std::vector<uint32_t>, HashCell> cells_;
};

double Error95(std::span<const Vector3d> points, const SurfaceIndex& scene, int threads) {
  return Quantile(Distances(points, scene, threads), 0.95);
}

}  // namespace

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return kNotMeasured;
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void SetCompleteness(const TruthPoints& truth, std::span<const char> found,
                     SurfaceFigures& figures) {
  double seen = 0, seen_found = 0, all_found = 0;
  for (size_t i = 0; i < truth.points.size(); ++i) {
    all_found += found[i];
    if (!truth.seen[i]) continue;
    seen += 1;
    seen_found += found[i];
  }
  if (seen > 0) figures.completeness = seen_found / seen;
  if (!truth.points.empty()) {
    figures.completeness_all = all_found / static_cast<double>(truth.points.size());
  }
}

SurfaceFigures CompareCloud(const std::filesystem::path& ply, const Similarity& truth_from_world,
                            const SurfaceIndex& scene, const TruthPoints& truth, double tolerance_m,
                            int threads) {
  const uint64_t step = ReadPlyLayout(ply).points / kMostForError + 1;
  PointGrid grid(truth.points, tolerance_m);
  std::vector<Vector3d> chosen;
  uint64_t number = 0;
  ForEachPoint(ply, [&](const CloudPoint& point) {
    const Vector3d place = truth_from_world * point.position;
    grid.Mark(place);
    if (number++ % step == 0) chosen.push_back(place);
  });
  SurfaceFigures figures;
  figures.error95_m = Error95(chosen, scene, threads);
  SetCompleteness(truth, grid.found(), figures);
  return figures;
}

SurfaceFigures CompareSurface(const SurfaceIndex& result, const SurfaceIndex& scene,
                              const TruthPoints& truth, double tolerance_m, int threads) {
  SurfaceFigures figures;
  figures.error95_m =
      Error95(Positions(SamplePoints(result.surface(), kSurfaceSamples, kSeed)), scene, threads);
  std::vector<char> found;
  for (const double distance : Distances(Positions(truth.points), result, threads)) {
    found.push_back(distance <= tolerance_m ? 1 : 0);
  }
  SetCompleteness(truth, found, figures);
  return figures;
}

}  // namespace stucco::evaluate
