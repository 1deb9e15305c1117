// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/seen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "site/incidence.h"
#include "survey/parallel.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

const double kLeastCosine = std::cos(kMaxShownIncidence_rad);
constexpr double kLiftM = 0.01;  // off the surface, so that it does not hide itself
constexpr size_t kPointsOfTask = 256;

bool Sees(const simulate::FlownPhoto& photo, const SurfacePoint& point, const SurfaceIndex& scene) {
  return IsInPhoto(photo, point.position, point.normal) &&
         !scene.Blocked(point.position + kLiftM * point.normal, photo.cam_from_world.Center());
}

}  // namespace

bool IsInPhoto(const simulate::FlownPhoto& photo, const Vector3d& place, const Vector3d& normal) {
  const Vector3d towards = photo.cam_from_world.Center() - place;
  if (!(normal.dot(towards) >= kLeastCosine * towards.norm())) return false;
  const Camera& camera = photo.camera;
  const Vector3d in_camera = photo.cam_from_world * place;
  const std::optional<Eigen::Vector2d> pixel = camera.Project(in_camera);
  // Far outside the picture a distortion polynomial can turn back into it.
  return pixel && camera.Contains(*pixel) && camera.IsInvertibleAt(in_camera.hnormalized());
}

std::vector<const simulate::FlownPhoto*> DeliveredPhotos(const simulate::Flight& flight) {
  std::vector<const simulate::FlownPhoto*> delivered;
  for (const simulate::FlownPhoto& photo : flight.photos) {
    if (!photo.lost && !photo.held_out) delivered.push_back(&photo);
  }
  return delivered;
}

std::vector<char> PhotosThatShow(std::span<const SurfacePoint> points,
                                 std::span<const simulate::FlownPhoto* const> photos,
                                 const SurfaceIndex& scene, char enough, int threads) {
  std::vector<char> showing(points.size(), 0);
  ParallelFor((points.size() + kPointsOfTask - 1) / kPointsOfTask, threads, [&](size_t block) {
    size_t first = 0;  // that saw the point before: it mostly sees this one, too
    const size_t end = std::min(points.size(), (block + 1) * kPointsOfTask);
    for (size_t i = block * kPointsOfTask; i < end; ++i) {
      const size_t start = first;
      for (size_t k = 0; k < photos.size() && showing[i] < enough; ++k) {
        const size_t photo = (start + k) % photos.size();
        if (!Sees(*photos[photo], points[i], scene)) continue;
        if (showing[i]++ == 0) first = photo;
      }
    }
  });
  return showing;
}

}  // namespace stucco::evaluate
