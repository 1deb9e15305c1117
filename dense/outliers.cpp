// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/outliers.h"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

namespace stucco {
namespace {

constexpr int kNeighbours = 10;

template <typename T>
void Keep(const std::vector<int>& kept, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> result;
  result.reserve(kept.size());
  for (const int i : kept) result.push_back(std::move(values[i]));
  values = std::move(result);
}

}  // namespace

size_t RemoveOutliers(double sigmas, PointCloud& cloud) {
  if (cloud.size() <= kNeighbours) return 0;
  // PCL works in floats: coordinates relative to the middle keep their digits.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : cloud.positions) middle += p / static_cast<double>(cloud.size());
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  points->reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.positions) {
    const Eigen::Vector3f f = (p - middle).cast<float>();
    points->push_back({f.x(), f.y(), f.z()});
  }
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(points);
  filter.setMeanK(kNeighbours);
  filter.setStddevMulThresh(sigmas);
  std::vector<int> kept;
  filter.filter(kept);
  const size_t removed = cloud.size() - kept.size();
  Keep(kept, cloud.positions);
  Keep(kept, cloud.normals);
  Keep(kept, cloud.colors);
  Keep(kept, cloud.views);
  return removed;
}

}  // namespace stucco
