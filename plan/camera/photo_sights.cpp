// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/camera/photo_sights.h"

#include <algorithm>
#include <cmath>

namespace stucco::plan {
namespace {

// What of a frame a patch fills that turns to the camera by `facing` (a cosine), `ray` away from
// it.
double FrameShare(const Frustum& frame, const Eigen::Vector3d& ray, double facing,
                  double patch_m2) {
  const double distance = ray.norm();
  const double depth = ray.dot(frame.forward);
  const double on_image_plane = patch_m2 * facing * distance / std::pow(depth, 3);
  return std::min(1.0, on_image_plane / (4 * frame.half_width * frame.half_height));
}

}  // namespace

std::vector<Sight> SightsOf(const SurfaceView& view, double patch_m2,
                            const Eigen::Vector3d& position, const Shot& shot) {
  const Viewpoint place = ViewpointOf(view.field, {position, {shot}}, view.reach_m);
  std::vector<Sight> out;
  for (const Sighting& sighting : SightingsFrom(place, view)) {
    const SurfaceSample& sample = view.samples[sighting.sample];
    const Eigen::Vector3d ray = sample.position - position;
    const double distance = ray.norm();
    const Eigen::Vector3d way = -ray / distance;
    const double share = FrameShare(place.pictures.front(), ray, way.dot(sample.normal), patch_m2);
    out.push_back({sighting.sample, static_cast<float>(share), way.cast<float>(),
                   static_cast<float>(distance)});
  }
  return out;
}

}  // namespace stucco::plan
