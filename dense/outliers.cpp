// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/outliers.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "dense/scratch_file.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr int kNeighbours = 10;
constexpr size_t kBlock = 4096;      // points of a task
constexpr size_t kProbes = 200'000;  // points that the cloud is measured by
constexpr size_t kMostSlabs = 256;   // files that are open at a time
constexpr float kReach = 16;         // spacings
constexpr float kMostSpacing = 4;    // of all points' median: bounds what has to be looked through
constexpr double kNoStray = 2;       // means: in a regular grid's corner it is 1.5 of them

// What of a point its neighbours are found by, in floats relative to the layout's origin.
struct SlabPoint {
  float at[3];
  float spacing;
  uint64_t index;  // in the cloud
};

struct Layout {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int axis = 0;               // that slabs lie across
  std::vector<float> bounds;  // upper ones of all slabs but the last, along the axis
  float most_spacing = 0;

  size_t SlabOf(float at) const {
    return static_cast<size_t>(std::ranges::upper_bound(bounds, at) - bounds.begin());
  }
};

// The share's quantile of `values`, which it sorts in part. Requires one value or more.
template <typename Value>
Value Quantile(std::vector<Value>& values, double share) {
  assert(!values.empty());
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Layout LayOut(FusedPointsFile& points, size_t points_of_slab) {
  std::array<std::vector<double>, 3> at;
  std::vector<float> spacing;
  const size_t stride = std::max<size_t>(1, points.size() / kProbes);
  size_t i = 0;
  points.ForEach([&](const FusedPoint& point) {
    if (i++ % stride != 0) return;
    for (int k = 0; k < 3; ++k) at[k].push_back(point.point.position[k]);
    spacing.push_back(point.spacing);
  });
  Layout layout;
  double longest = -1;
  for (int k = 0; k < 3; ++k) {
    layout.origin[k] = Quantile(at[k], 0.5);
    const double length = Quantile(at[k], 0.99) - Quantile(at[k], 0.01);
    if (length <= longest) continue;
    longest = length;
    layout.axis = k;
  }
  layout.most_spacing = kMostSpacing * Quantile(spacing, 0.5);
  const size_t slabs = std::min(kMostSlabs, points.size() / points_of_slab + 1);
  for (size_t s = 1; s < slabs; ++s) {
    const double share = static_cast<double>(s) / static_cast<double>(slabs);
    const double bound = Quantile(at[layout.axis], share) - layout.origin[layout.axis];
    layout.bounds.push_back(static_cast<float>(bound));
  }
  return layout;
}

// The points of each slab, on disk.
class Slabs {
 public:
  Slabs(FusedPointsFile& points, const Layout& layout, const std::filesystem::path& folder)
      : layout_(layout), sizes_(layout.bounds.size() + 1) {
    for (size_t s = 0; s < sizes_.size(); ++s) files_.emplace_back(folder);
    uint64_t index = 0;
    points.ForEach([&](const FusedPoint& point) {
      const Eigen::Vector3f p = (point.point.position - layout.origin).cast<float>();
      const size_t slab = layout.SlabOf(p[layout.axis]);
      files_[slab].Write(SlabPoint{{p.x(), p.y(), p.z()}, point.spacing, index++});
      ++sizes_[slab];
    });
  }

  size_t count() const { return sizes_.size(); }

  // The points of a slab, in the cloud's order, and then those of others that are within reach.
  std::vector<SlabPoint> Read(size_t slab, float reach) {
    std::vector<SlabPoint> points;
    Append(slab, -kEverywhere, kEverywhere, points);
    const float low = slab == 0 ? -kEverywhere : layout_.bounds[slab - 1] - reach;
    const float high = slab == layout_.bounds.size() ? kEverywhere : layout_.bounds[slab] + reach;
    for (size_t s = layout_.SlabOf(low); s <= layout_.SlabOf(high); ++s) {
      if (s != slab) Append(s, low, high, points);
    }
    return points;
  }

  size_t size(size_t slab) const { return sizes_[slab]; }

 private:
  static constexpr float kEverywhere = std::numeric_limits<float>::max();

  void Append(size_t slab, float low, float high, std::vector<SlabPoint>& points) {
    files_[slab].Rewind();
    for (size_t i = 0; i < sizes_[slab]; ++i) {
      const auto point = files_[slab].Read<SlabPoint>();
      const float at = point.at[layout_.axis];
      if (at >= low && at <= high) points.push_back(point);
    }
  }

  const Layout& layout_;
  std::vector<ScratchFile> files_;
  std::vector<size_t> sizes_;
};

// Mean distance to the nearest neighbours of the first `count` points, in units of their spacing.
std::vector<float> NeighbourDistances(const std::vector<SlabPoint>& points, size_t count,
                                      float most_spacing, int threads) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(points.size());
  for (const SlabPoint& point : points) cloud->push_back({point.at[0], point.at[1], point.at[2]});
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  std::vector<float> distances(count);
  ParallelFor(count / kBlock + 1, threads, [&](size_t block) {
    std::vector<int> indices;
    std::vector<float> squares;
    for (size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      const float reach = kReach * std::min(points[i].spacing, most_spacing);
      const int found = tree.nearestKSearch((*cloud)[i], kNeighbours + 1, indices, squares);
      float sum = reach * static_cast<float>(kNeighbours + 1 - found);  // with itself
      for (int k = 0; k < found; ++k) sum += std::min(reach, std::sqrt(squares[k]));
      distances[i] = sum / kNeighbours / points[i].spacing;
    }
  });
  return distances;
}

}  // namespace

std::vector<bool> FindInliers(FusedPointsFile& points, const OutlierOptions& options,
                              const std::filesystem::path& folder) {
  if (points.size() <= kNeighbours) return std::vector<bool>(points.size(), true);
  const Layout layout = LayOut(points, options.points_of_slab);
  Slabs slabs(points, layout, folder);
  struct Measured {
    uint64_t index;
    float distance;
  };
  ScratchFile measured(folder);
  double sum = 0;
  double squares = 0;
  for (size_t s = 0; s < slabs.count(); ++s) {
    const std::vector<SlabPoint> near = slabs.Read(s, kReach * layout.most_spacing);
    const std::vector<float> distances =
        NeighbourDistances(near, slabs.size(s), layout.most_spacing, options.threads);
    for (size_t i = 0; i < distances.size(); ++i) {
      const double d = distances[i];
      sum += d;
      squares += d * d;
      measured.Write(Measured{near[i].index, distances[i]});
    }
  }
  const auto count = static_cast<double>(points.size());
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
  const double limit = std::max(mean + options.sigmas * deviation, kNoStray * mean);
  std::vector<bool> inliers(points.size());
  measured.Rewind();
  for (size_t i = 0; i < points.size(); ++i) {
    const auto point = measured.Read<Measured>();
    inliers[point.index] = point.distance <= limit;
  }
  return inliers;
}

}  // namespace stucco
