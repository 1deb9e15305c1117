// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/detect.h"

#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/property_map.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace stucco {
namespace {

// Walls seen by stereo have about 0.95, directions drawn at random 0.15.
constexpr double kLeastAgreement = 0.5;

// CGAL's NeighborQuery concept over our grid.
class Neighbours {
 public:
  Neighbours(const Samples& samples, const GridIndex& index, double radius)
      : samples_(samples), index_(index), radius_(radius) {}
  void operator()(size_t query, std::vector<size_t>& neighbours) const {
    index_.ForEachNear(samples_.positions[query], radius_,
                       [&](int i) { neighbours.push_back(static_cast<size_t>(i)); });
  }

 private:
  const Samples& samples_;
  const GridIndex& index_;
  double radius_;
};

// CGAL's RegionType concept: a plane refitted from running sums, so that a region of n samples
// costs n instead of n per growth ring. Unlike CGAL's own, the two sides of a thin wall stay apart.
class PlaneRegion {
 public:
  PlaneRegion(const Samples& samples, const DetectOptions& options)
      : samples_(samples),
        options_(options),
        min_cos_(std::cos(options.normal_angle_deg * std::numbers::pi / 180)) {}

  bool is_part_of_region(size_t, size_t query, const std::vector<size_t>&) const {
    return std::abs(normal_.dot(samples_.positions[query] - seed_) - offset_) <= options_.epsilon &&
           normal_.dot(samples_.normals[query]) >= min_cos_;
  }
  bool is_valid_region(const std::vector<size_t>& region) const {
    return region.size() >= static_cast<size_t>(options_.min_points);
  }
  void update(const std::vector<size_t>& region) {
    if (region.size() == 1) Restart(region[0]);
    for (; summed_ < region.size(); ++summed_) Add(region[summed_]);
    Fit();
  }

 private:
  void Restart(size_t seed) {
    seed_ = samples_.positions[seed];
    summed_ = 0;
    sum_.setZero();
    squares_.setZero();
    normals_.setZero();
  }
  void Add(size_t i) {
    const Eigen::Vector3d d = samples_.positions[i] - seed_;
    sum_ += d;
    squares_ += d * d.transpose();
    normals_ += samples_.normals[i];
  }
  void Fit() {
    // A few samples say less about the plane than their normals do.
    constexpr size_t kFewest = 40;
    const Eigen::Vector3d mean = sum_ / double(summed_);
    const Eigen::Vector3d mean_normal =
        normals_.squaredNorm() > 1e-12 ? normals_.normalized() : Eigen::Vector3d::UnitZ();
    normal_ = mean_normal;
    if (summed_ >= kFewest) {
      const Eigen::Matrix3d covariance = squares_ / double(summed_) - mean * mean.transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
      normal_ = solver.eigenvectors().col(0);
      if (normal_.dot(mean_normal) < 0) normal_ = -normal_;
    }
    offset_ = normal_.dot(mean);
  }

  const Samples& samples_;
  const DetectOptions& options_;
  double min_cos_;
  Eigen::Vector3d seed_ = Eigen::Vector3d::Zero();  // origin of the sums and of the offset
  size_t summed_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d normals_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  double offset_ = 0;
};

}  // namespace

std::vector<Plane> DetectPlanes(const Samples& samples, const GridIndex& index,
                                const std::vector<double>& agreement,
                                const DetectOptions& options) {
  std::vector<Plane> planes;
  if (samples.size() == 0) return planes;
  std::vector<size_t> seeds(samples.size());
  std::iota(seeds.begin(), seeds.end(), size_t{0});
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](size_t a, size_t b) { return agreement[a] > agreement[b]; });
  Neighbours neighbours(samples, index, options.radius);
  PlaneRegion region_type(samples, options);
  std::erase_if(seeds, [&](size_t i) { return agreement[i] < kLeastAgreement; });
  seeds.resize(samples.size(), static_cast<size_t>(-1));  // CGAL skips these
  const auto seed_map = CGAL::make_property_map(seeds);
  CGAL::Shape_detection::Region_growing<std::vector<Eigen::Vector3d>, Neighbours, PlaneRegion,
                                        std::remove_const_t<decltype(seed_map)>>
      growing(samples.positions, neighbours, region_type, seed_map);
  std::vector<std::vector<size_t>> regions;
  growing.detect(std::back_inserter(regions));
  for (const auto& region : regions) {
    Plane plane;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (const size_t i : region) {
      plane.points.push_back(static_cast<int>(i));
      normal += samples.normals[i];
    }
    std::sort(plane.points.begin(), plane.points.end());
    plane.normal = normal.normalized();
    Refit(samples, plane);
    planes.push_back(std::move(plane));
  }
  std::stable_sort(planes.begin(), planes.end(), [](const Plane& a, const Plane& b) {
    return a.points.size() > b.points.size();
  });
  return planes;
}

}  // namespace stucco
