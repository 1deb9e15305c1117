// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "proxy/solids/solid_cells.h"

namespace stucco {
namespace {

constexpr size_t kMostRays = 15000;

// The part of a segment inside the box, from `a` on; false when it misses.
bool Clip(const Eigen::AlignedBox3d& box, Eigen::Vector3d& a, Eigen::Vector3d& b) {
  double from = 0, to = 1;
  const Eigen::Vector3d d = b - a;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(d[axis]) < 1e-12) {
      if (a[axis] < box.min()[axis] || a[axis] > box.max()[axis]) return false;
      continue;
    }
    double t0 = (box.min()[axis] - a[axis]) / d[axis], t1 = (box.max()[axis] - a[axis]) / d[axis];
    if (t0 > t1) std::swap(t0, t1);
    from = std::max(from, t0);
    to = std::min(to, t1);
  }
  if (from >= to) return false;
  const Eigen::Vector3d start = a;
  a = start + from * d;
  b = start + to * d;
  return true;
}

// Free space along the rays to points on any plane.
void CastRays(const Partition& partition, const Eigen::AlignedBox3d& box, const SolidInput& input,
              CellEvidence& evidence) {
  const Samples& samples = input.scene->samples;
  const std::vector<int>& support = input.scene->support;
  const size_t stride = std::max<size_t>(1, support.size() / kMostRays);
  const double spacing = input.scene->tolerances.spacing;
  const double weight = static_cast<double>(stride) * spacing * spacing;
  const double detail = input.scene->tolerances.level_of_detail;
  for (size_t k = 0; k < support.size(); k += stride) {
    const int i = support[k];
    const Eigen::Vector3d* seen_from = samples.EyeOf(i);
    if (seen_from == nullptr) continue;
    Eigen::Vector3d eye = input.local_from_world * *seen_from;
    Eigen::Vector3d end = input.local_from_world * samples.positions[i];
    const Eigen::Vector3d ray = end - eye;
    if (ray.norm() < 2 * detail) continue;
    end -= detail * ray.normalized();
    if (!Clip(box, eye, end)) continue;
    partition.ForEachCrossed(eye, end, [&](int cell, double length) {
      evidence.outside[cell] += weight * std::min(1.0, length / detail);
    });
  }
}

void VoteBehindPoints(const Partition& partition, const Eigen::AlignedBox3d& box,
                      const SolidInput& input, CellEvidence& evidence) {
  for (const PlaneView* view : input.views) {
    if (view == nullptr) continue;
    const Plane& plane = *view->plane;
    const size_t stride = std::max<size_t>(1, plane.points.size() / 4000);
    const double weight =
        plane.area / std::max<double>(1, double(plane.points.size())) * double(stride);
    const Eigen::Vector3d normal = input.local_from_world.linear() * plane.normal;
    for (size_t k = 0; k < plane.points.size(); k += stride) {
      const Eigen::Vector3d p =
          input.local_from_world * input.scene->samples.positions[plane.points[k]];
      for (const double depth : {1.0, 3.0}) {
        const Eigen::Vector3d step = depth * input.scene->tolerances.level_of_detail * normal;
        if (box.contains(p - step)) evidence.inside[partition.CellAt(p - step)] += weight / 2;
        if (box.contains(p + step)) evidence.outside[partition.CellAt(p + step)] += weight / 2;
      }
    }
  }
}

// Faces of a partition by their plane and the cells below and above it.
using FacesBetween = std::map<std::array<int, 3>, std::vector<int>>;

// Centres of the raster cells with points, in the partition's frame and inside the box.
std::vector<Eigen::Vector3d> SeenCentres(const PlaneView& view, const Eigen::AlignedBox3d& box,
                                         const SolidInput& input) {
  std::vector<Eigen::Vector3d> centres;
  for (int y = 0; y < view.raster.height; ++y) {
    for (int x = 0; x < view.raster.width; ++x) {
      if (view.evidence[view.raster.Index(x, y)] != Evidence::kSeen) continue;
      const Eigen::Vector3d p =
          input.local_from_world * view.raster.frame.ToWorld(view.raster.Center(x, y));
      if (box.contains(p)) centres.push_back(p);
    }
  }
  return centres;
}

// Raster cells with points, added to the face of the plane that they lie in.
void CoverFaces(const Partition& partition, const Eigen::AlignedBox3d& box, const SolidInput& input,
                CellEvidence& evidence) {
  FacesBetween faces;
  for (size_t f = 0; f < partition.faces.size(); ++f) {
    const auto& face = partition.faces[f];
    faces[{face.plane, face.below, face.above}].push_back(static_cast<int>(f));
  }
  for (size_t v = 0; v < input.views.size(); ++v) {
    if (input.views[v] == nullptr) continue;
    const PlaneView& view = *input.views[v];
    const int plane = Partition::kBoxPlanes + static_cast<int>(v);
    if (plane >= static_cast<int>(partition.planes.size())) break;
    const Eigen::Vector3d normal = input.local_from_world.linear() * view.plane->normal;
    const double step = 1e-3 * input.scene->tolerances.level_of_detail;
    const double area = view.raster.cell * view.raster.cell;
    for (const Eigen::Vector3d& p : SeenCentres(view, box, input)) {
      const int below = partition.CellAt(p - step * normal);
      const int above = partition.CellAt(p + step * normal);
      const auto found = faces.find({plane, below, above});
      if (found == faces.end()) continue;
      for (const int f : found->second) evidence.covered[f] += area / double(found->second.size());
    }
  }
}

}  // namespace

CellEvidence GatherEvidence(const Partition& partition, const Eigen::AlignedBox3d& box,
                            const SolidInput& input) {
  CellEvidence evidence;
  evidence.inside.assign(partition.cells.size(), 0);
  evidence.outside.assign(partition.cells.size(), 0);
  evidence.covered.assign(partition.faces.size(), 0);
  CastRays(partition, box, input, evidence);
  VoteBehindPoints(partition, box, input, evidence);
  CoverFaces(partition, box, input, evidence);
  return evidence;
}

}  // namespace stucco
