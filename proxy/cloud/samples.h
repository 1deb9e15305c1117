// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "survey/ply.h"
#include "survey/point_cloud.h"
#include "survey/survey_photo.h"

namespace stucco {

// The cloud thinned to at most one point per grid cell: what every later step works on.
struct Samples {
  std::vector<Eigen::Vector3d> positions;  // mean of the cell's points
  std::vector<Eigen::Vector3d> normals;    // unit, towards the cameras; zero where not known
  std::vector<int> weights;                // cloud points a sample stands for
  std::vector<int> cameras;                // index into `camera_centers` of one that sees it, or -1
  std::vector<Eigen::Vector3d> camera_centers;  // of all photos of the survey, in their order
  double cell = 0;                              // side of the grid's cells; 0: nothing was thinned
  size_t dropped = 0;                           // points not finite or far away from all others

  size_t size() const { return positions.size(); }
  // Where a camera stood that sees sample i, or nothing.
  const Eigen::Vector3d* EyeOf(size_t i) const {
    return cameras[i] < 0 ? nullptr : &camera_centers[cameras[i]];
  }
};

// A cloud to go through several times, in the same order, without holding it.
struct PointStream {
  size_t count = 0;
  std::function<void(const PointVisit&)> for_each;
  // As ForSomePoints (ply.h); empty: it is only read as a whole.
  std::function<PlyPlace(const PlyPlace& from, uint64_t count, const PointVisit&)> for_some = {};
};

// The stream refers to the cloud.
PointStream StreamOf(const PointCloud& cloud);
PointStream StreamOf(const std::filesystem::path& ply);

// Thins to at most `max_points`, with cells of at least `min_cell`, in memory that grows with
// `max_points` and not with the cloud. Points that are not finite, or three times the size of the
// box of the middle 98 % away from it, are dropped.
Samples ThinCloud(const PointStream& stream, std::span<const SurveyPhoto> photos, int max_points,
                  double min_cell);

// The same in one go for what lies in a box: cells of this size, larger only where there would be
// more than `max_points`.
Samples ThinInside(const Eigen::AlignedBox3d& box, const PointStream& stream,
                   std::span<const SurveyPhoto> photos, int max_points, double cell);

}  // namespace stucco
