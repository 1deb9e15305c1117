// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "survey/parallel.h"
#include "survey/ply.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

// Most lie on ground around the survey; of a facade there may be one in a hundred.
constexpr uint64_t kMostForError = 2000000;
constexpr size_t kSurfaceSamples = 1000000;
constexpr uint64_t kCloudSeed = 1;

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

// How far points of a result are from the scene. Those of ground that is none of the survey's are
// left out.
ResultPoints MeasurePoints(std::span<const Vector3d> points, const SceneIndex& scene, int threads) {
  constexpr size_t kBlock = 1024;  // points for one task
  std::vector<NearestPlace> nearest(points.size());
  std::vector<char> counts(points.size());
  ParallelFor((points.size() + kBlock - 1) / kBlock, threads, [&](size_t block) {
    for (size_t i = block * kBlock; i < std::min(points.size(), (block + 1) * kBlock); ++i) {
      nearest[i] = scene.everything.Nearest(points[i]);
      counts[i] = IsOfBuilding(nearest[i].group) ||
                  scene.buildings.Distance(nearest[i].place) <= kGroundReachM;
    }
  });
  ResultPoints measured;
  for (size_t i = 0; i < points.size(); ++i) {
    if (counts[i]) measured.Add(nearest[i].distance, nearest[i].group);
  }
  return measured;
}

}  // namespace

PartFigures CompareCloud(const std::filesystem::path& ply, const Similarity& truth_from_world,
                         const SceneIndex& scene, const TruthPoints& truth,
                         const CompareOptions& options) {
  const uint64_t step = ReadPlyLayout(ply).points / kMostForError + 1;
  PointGrid grid(truth.points, options.tolerance_m);
  std::vector<Vector3d> chosen;
  uint64_t number = 0;
  ForEachPoint(ply, [&](const CloudPoint& point) {
    const Vector3d place = truth_from_world * point.position;
    grid.Mark(place);
    if (number++ % step == 0) chosen.push_back(place);
  });
  return FiguresOf(MeasurePoints(chosen, scene, options.threads), truth, grid.found());
}

PartFigures CompareSurface(const SurfaceIndex& result, const SceneIndex& scene,
                           const TruthPoints& truth, const CompareOptions& options) {
  const auto points = Positions(SamplePoints(result.surface(), kSurfaceSamples, kCloudSeed));
  return FiguresOf(MeasurePoints(points, scene, options.threads), truth,
                   Distances(Positions(truth.points), result, options.threads),
                   options.tolerance_m);
}

}  // namespace stucco::evaluate
