// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/sight_lines.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace stucco {
namespace {

constexpr double kBelow_m = 0.5;  // a roof
constexpr double kThin_m = 0.3;   // floors of balconies

// Heights of the lowest of a building's large roofs.
class LowestRoof {
 public:
  explicit LowestRoof(const std::vector<Plane>& planes) {
    constexpr double kLarge = 0.1;  // of all
    double all = 0;
    for (const Plane& plane : planes) all += plane.area;
    for (const Plane& plane : planes) {
      if (plane.area > kLarge * all) large_.push_back(&plane);
    }
  }
  bool IsKnown() const { return !large_.empty(); }
  double At(const Eigen::Vector2d& p) const {
    double lowest = std::numeric_limits<double>::max();
    for (const Plane* plane : large_) {
      const Eigen::Vector3d& n = plane->normal;
      lowest = std::min(lowest, (plane->offset - n.head<2>().dot(p)) / n.z());
    }
    return lowest;
  }

 private:
  std::vector<const Plane*> large_;
};

// What lies above each cell of the ground plan.
struct Overhead {
  std::vector<char> roofed;   // one of the large roofs, or what is as high
  std::vector<float> lowest;  // the lowest of all
};

Overhead OverheadOf(const RoofEvidence& evidence, const LowestRoof& roof, const PlaneRaster& raster,
                    double spacing) {
  const size_t cells = static_cast<size_t>(raster.width) * raster.height;
  std::vector<int> counts(cells, 0);
  Overhead overhead{.roofed = std::vector<char>(cells, 0),
                    .lowest = std::vector<float>(cells, std::numeric_limits<float>::max())};
  for (const Eigen::Vector3d& p : evidence.samples.positions) {
    const int at = raster.IndexAt(p.head<2>());
    if (at < 0) continue;
    overhead.lowest[at] = std::min(overhead.lowest[at], static_cast<float>(p.z()));
    if (p.z() > roof.At(p.head<2>()) - kBelow_m) ++counts[at];
  }
  const double enough = EnoughSamples(raster.cell, spacing);
  for (size_t at = 0; at < cells; ++at) overhead.roofed[at] = counts[at] >= enough ? 1 : 0;
  return overhead;
}

}  // namespace

std::vector<char> SeenThrough(const RoofEvidence& evidence, const PlaneRaster& raster,
                              const Tolerances& tolerances) {
  constexpr double kEaves_m = 1;
  constexpr int kFewest = 2;  // lines
  std::vector<char> through(static_cast<size_t>(raster.width) * raster.height, 0);
  const LowestRoof roof(evidence.planes);
  if (!roof.IsKnown()) return through;
  const Overhead overhead = OverheadOf(evidence, roof, raster, tolerances.spacing);
  std::vector<int> counts(through.size(), 0), below;
  for (const SightLine& sight : evidence.sights) {
    const Eigen::Vector3d ray = sight.eye - sight.wall;
    const double far = ray.head<2>().norm();
    below.clear();
    bool blocked = false;
    for (double way = raster.cell; way < far && !blocked; way += raster.cell) {
      const Eigen::Vector3d p = sight.wall + way / far * ray;
      const int at = raster.IndexAt(p.head<2>());
      if (at < 0 || p.z() > roof.At(p.head<2>()) - kBelow_m) break;
      const bool roofed = overhead.roofed[at] != 0;
      blocked = roofed && way > kEaves_m;
      if (!roofed && p.z() < overhead.lowest[at] - kThin_m) below.push_back(at);
    }
    if (blocked) continue;
    for (const int at : below) ++counts[at];
  }
  for (size_t at = 0; at < counts.size(); ++at) through[at] = counts[at] >= kFewest ? 1 : 0;
  return through;
}

}  // namespace stucco
