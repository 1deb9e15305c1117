// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/triangulate.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace stucco {
namespace {

// Pairs of elements tried for a long track; the pairs are spread over it.
constexpr int kMaxPairs = 60;

struct Ray {
  int element = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double sigma = 1;  // over that of a sharp keypoint
};

std::vector<Ray> RaysOf(const Scene& scene, const SceneTrack& track) {
  std::vector<Ray> rays;
  for (size_t i = 0; i < track.elements.size(); ++i) {
    const SceneElement& element = track.elements[i];
    const ScenePhoto& photo = scene.photos[element.photo];
    if (!photo.pose) continue;
    const auto ray = scene.CameraOf(element.photo).Unproject(photo.keypoints[element.keypoint]);
    if (!ray) continue;
    rays.push_back({static_cast<int>(i), photo.pose->Center(),
                    (photo.pose->rotation.conjugate() * ray->homogeneous()).normalized(),
                    photo.KeypointSigma(element.keypoint) / photo.keypoint_sigma_px});
  }
  return rays;
}

// Middle of the shortest segment between two rays.
std::optional<Eigen::Vector3d> ClosestPoint(const Ray& a, const Ray& b) {
  const Eigen::Vector3d between = b.center - a.center;
  const double cosine = a.direction.dot(b.direction);
  const double determinant = 1 - cosine * cosine;
  if (determinant < 1e-12) return std::nullopt;
  const double s = (between.dot(a.direction) - cosine * between.dot(b.direction)) / determinant;
  const double t = (cosine * between.dot(a.direction) - between.dot(b.direction)) / determinant;
  if (s <= 0 || t <= 0) return std::nullopt;
  return 0.5 * (a.center + s * a.direction + b.center + t * b.direction);
}

std::vector<int> AgreeingElements(const Scene& scene, const SceneTrack& track,
                                  const std::vector<Ray>& rays, const Eigen::Vector3d& point,
                                  double max_error_sigmas) {
  std::vector<int> agreeing;
  for (const Ray& ray : rays) {
    if (ReprojectionErrorInSigmas(scene, track.elements[ray.element], point) < max_error_sigmas) {
      agreeing.push_back(ray.element);
    }
  }
  return agreeing;
}

// Gauss-Newton on the angular residuals of the agreeing rays, in their standard deviations.
Eigen::Vector3d Refine(const std::vector<Ray>& rays, const std::vector<int>& agreeing,
                       Eigen::Vector3d point) {
  for (int iteration = 0; iteration < 3; ++iteration) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    size_t next = 0;
    for (const Ray& ray : rays) {
      if (next >= agreeing.size() || agreeing[next] != ray.element) continue;
      ++next;
      const double distance = (point - ray.center).norm();
      const Eigen::Matrix3d across =
          (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose()) /
          std::pow(distance * ray.sigma, 2);
      normal += across;
      right += across * ray.center;
    }
    point = normal.ldlt().solve(right);
  }
  return point;
}

}  // namespace

std::optional<Eigen::Vector3d> TriangulateTwoRays(const Eigen::Vector2d& first,
                                                  const Eigen::Vector2d& second,
                                                  const Pose& second_from_first) {
  const Ray a{0, Eigen::Vector3d::Zero(), first.homogeneous().normalized()};
  const Ray b{1, second_from_first.Center(),
              (second_from_first.rotation.conjugate() * second.homogeneous()).normalized()};
  return ClosestPoint(a, b);
}

void ClearPoint(SceneTrack& track) {
  track.position.reset();
  for (SceneElement& element : track.elements) element.used = false;
}

bool TriangulateTrack(const Scene& scene, const TriangulateOptions& options, SceneTrack& track) {
  ClearPoint(track);
  const std::vector<Ray> rays = RaysOf(scene, track);
  const int count = static_cast<int>(rays.size());
  if (count < 2) return false;
  const double max_cos = std::cos(options.min_angle_rad);
  const int stride = std::max(1, count * (count - 1) / 2 / kMaxPairs);
  std::vector<int> best;
  Eigen::Vector3d best_point = Eigen::Vector3d::Zero();
  int pair = 0;
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      if (pair++ % stride != 0 || rays[i].direction.dot(rays[j].direction) > max_cos) continue;
      const auto point = ClosestPoint(rays[i], rays[j]);
      if (!point) continue;
      auto agreeing = AgreeingElements(scene, track, rays, *point, options.max_error_sigmas);
      if (agreeing.size() <= best.size()) continue;
      best = std::move(agreeing);
      best_point = *point;
    }
  }
  if (best.size() < 2) return false;
  const Eigen::Vector3d refined = Refine(rays, best, best_point);
  auto agreeing = AgreeingElements(scene, track, rays, refined, options.max_error_sigmas);
  if (refined.allFinite() && agreeing.size() >= best.size()) {
    best = std::move(agreeing);
    best_point = refined;
  }
  track.position = best_point;
  for (const int i : best) track.elements[i].used = true;
  if (LargestRayAngle(scene, track) < options.min_angle_rad) {
    ClearPoint(track);
    return false;
  }
  return true;
}

}  // namespace stucco
