// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/outliers.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr int kNeighbours = 10;
constexpr size_t kBlock = 4096;  // points of a task

template <typename T>
void Keep(const std::vector<int>& kept, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> result;
  result.reserve(kept.size());
  for (const int i : kept) result.push_back(std::move(values[i]));
  values = std::move(result);
}

// Mean distance of each point to its nearest neighbours.
std::vector<float> NeighbourDistances(int threads, const PointCloud& cloud) {
  // PCL works in floats: coordinates relative to the middle keep their digits.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : cloud.positions) middle += p / static_cast<double>(cloud.size());
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  points->reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.positions) {
    const Eigen::Vector3f f = (p - middle).cast<float>();
    points->push_back({f.x(), f.y(), f.z()});
  }
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(points);
  std::vector<float> distances(cloud.size());
  const size_t num_blocks = cloud.size() / kBlock + 1;
  ParallelFor(num_blocks, threads, [&](size_t block) {
    std::vector<int> indices;
    std::vector<float> squares;
    for (size_t i = block * kBlock; i < std::min(cloud.size(), (block + 1) * kBlock); ++i) {
      tree.nearestKSearch((*points)[i], kNeighbours + 1, indices, squares);  // with itself
      float sum = 0;
      for (const float square : squares) sum += std::sqrt(square);
      distances[i] = sum / kNeighbours;
    }
  });
  return distances;
}

}  // namespace

size_t RemoveOutliers(double sigmas, const std::vector<float>& spacing, int threads,
                      PointCloud& cloud) {
  if (cloud.size() <= kNeighbours) return 0;
  const std::vector<float> distances = NeighbourDistances(threads, cloud);
  double sum = 0;
  double squares = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    const double d = distances[i] / spacing[i];
    sum += d;
    squares += d * d;
  }
  const auto count = static_cast<double>(distances.size());
  const double mean = sum / count;
  const double limit = mean + sigmas * std::sqrt(std::max(0.0, squares / count - mean * mean));
  std::vector<int> kept;
  for (size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] / spacing[i] <= limit) kept.push_back(static_cast<int>(i));
  }
  const size_t removed = cloud.size() - kept.size();
  Keep(kept, cloud.positions);
  Keep(kept, cloud.normals);
  Keep(kept, cloud.colors);
  Keep(kept, cloud.views);
  return removed;
}

}  // namespace stucco
