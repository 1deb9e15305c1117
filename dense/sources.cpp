// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stucco {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kDepthMargin = 1.4;
constexpr size_t kLeastShared = 10;

double AngleWeight(double degrees) {
  if (degrees < 1) return 0;
  if (degrees < 5) return degrees / 5;
  return degrees <= 30 ? 1 : std::exp(-(degrees - 30) * (degrees - 30) / (2 * 15.0 * 15.0));
}

struct Shared {
  double score = 0;
  size_t points = 0;
};

std::map<PhotoId, std::map<PhotoId, Shared>> ScorePairs(const Reconstruction& r) {
  std::map<PhotoId, Eigen::Vector3d> centers;
  for (const auto& [id, photo] : r.photos) centers[id] = photo.cam_from_world.Center();
  std::map<PhotoId, std::map<PhotoId, Shared>> scores;
  for (const auto& [point_id, point] : r.points) {
    for (const TrackElement& a : point.track) {
      for (const TrackElement& b : point.track) {
        if (a.photo == b.photo) continue;
        const Eigen::Vector3d ray_a = point.position - centers.at(a.photo);
        const Eigen::Vector3d ray_b = point.position - centers.at(b.photo);
        const double angle = std::atan2(ray_a.cross(ray_b).norm(), ray_a.dot(ray_b)) * kDegrees;
        const double size_a = r.cameras.at(r.photos.at(a.photo).camera).FocalX() / ray_a.norm();
        const double size_b = r.cameras.at(r.photos.at(b.photo).camera).FocalX() / ray_b.norm();
        const double ratio = std::min(size_a, size_b) / std::max(size_a, size_b);
        Shared& shared = scores[a.photo][b.photo];
        shared.score += AngleWeight(angle) * ratio;
        ++shared.points;
      }
    }
  }
  return scores;
}

void AddSeeds(const Reconstruction& r, const RegisteredImage& photo, int max_image_px,
              SourceChoice& choice) {
  const PinholeCamera view =
      PinholeLevels(r.cameras.at(photo.camera), photo.cam_from_world, max_image_px, 1)[0];
  std::vector<float> depths;
  for (const Observation& observation : photo.observations) {
    if (!observation.point.IsValid()) continue;
    const Eigen::Vector3d p = photo.cam_from_world * r.points.at(observation.point).position;
    if (p.z() <= 0) continue;
    const float depth = static_cast<float>(p.z());
    depths.push_back(depth);
    choice.seeds.push_back({static_cast<float>(view.fx * p.x() / p.z() + view.cx),
                            static_cast<float>(view.fy * p.y() / p.z() + view.cy), depth});
  }
  if (depths.empty()) return;
  std::sort(depths.begin(), depths.end());
  choice.min_depth = static_cast<float>(depths[depths.size() / 100] / kDepthMargin);
  choice.max_depth =
      static_cast<float>(depths[depths.size() - 1 - depths.size() / 100] * kDepthMargin);
}

}  // namespace

std::map<PhotoId, SourceChoice> ChooseSources(const Reconstruction& reconstruction,
                                              const SourceLimits& limits) {
  std::map<PhotoId, SourceChoice> choices;
  for (const auto& [id, others] : ScorePairs(reconstruction)) {
    std::vector<std::pair<double, PhotoId>> order;
    for (const auto& [other, shared] : others) {
      if (shared.points >= kLeastShared && shared.score > 1)
        order.emplace_back(-shared.score, other);
    }
    if (order.empty()) continue;
    std::sort(order.begin(), order.end());
    SourceChoice& choice = choices[id];
    for (const auto& [score, other] : order) {
      if (std::ssize(choice.sources) < limits.sources) choice.sources.push_back(other);
      if (std::ssize(choice.neighbours) < limits.neighbours) choice.neighbours.push_back(other);
    }
    AddSeeds(reconstruction, reconstruction.photos.at(id), limits.max_image_px, choice);
  }
  return choices;
}

}  // namespace stucco
