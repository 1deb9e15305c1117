// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

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

// A photo and where it was taken.
struct Viewpoint {
  const RegisteredImage& photo;
  const Eigen::Vector3d& center;
};

// How well two photos show a point together, from 0 to 1.
double PairWorth(const Reconstruction& r, const Viewpoint& a, const Viewpoint& b,
                 const Eigen::Vector3d& point) {
  const Eigen::Vector3d ray_a = point - a.center;
  const Eigen::Vector3d ray_b = point - b.center;
  const double angle = std::atan2(ray_a.cross(ray_b).norm(), ray_a.dot(ray_b)) * kDegrees;
  const double size_a = r.cameras.at(a.photo.camera).FocalX() / ray_a.norm();
  const double size_b = r.cameras.at(b.photo.camera).FocalX() / ray_b.norm();
  return AngleWeight(angle) * std::min(size_a, size_b) / std::max(size_a, size_b);
}

std::map<PhotoId, std::map<PhotoId, Shared>> ScorePairs(const Reconstruction& r) {
  std::map<PhotoId, Eigen::Vector3d> centers;
  for (const auto& [id, photo] : r.photos) centers[id] = photo.cam_from_world.Center();
  std::map<PhotoId, std::map<PhotoId, Shared>> scores;
  for (const auto& [point_id, point] : r.points) {
    for (const TrackElement& a : point.track) {
      for (const TrackElement& b : point.track) {
        if (a.photo == b.photo) continue;
        Shared& shared = scores[a.photo][b.photo];
        shared.score += PairWorth(r, {r.photos.at(a.photo), centers.at(a.photo)},
                                  {r.photos.at(b.photo), centers.at(b.photo)}, point.position);
        ++shared.points;
      }
    }
  }
  return scores;
}

// Photos in order: each the one that adds most to those before it.
class SourceOrder {
 public:
  SourceOrder(const Reconstruction& r, int max_image_px) : reconstruction_(r) {
    for (const auto& [id, photo] : r.photos) {
      views_[id] =
          PinholeLevels(r.cameras.at(photo.camera), photo.cam_from_world, max_image_px, 1)[0];
      centers_[id] = photo.cam_from_world.Center();
    }
  }

  const PinholeCamera& ViewOf(PhotoId id) const { return views_.at(id); }

  std::vector<PhotoId> Of(PhotoId id, const std::vector<PhotoId>& others, size_t most) const {
    const std::vector<Part> parts = PartsOf(id);
    std::vector<Worth> worths;
    worths.reserve(others.size());
    for (const PhotoId other : others) worths.push_back(WorthOf(id, other, parts));
    Worth have{};
    std::vector<bool> taken(others.size(), false);
    std::vector<PhotoId> order;
    while (order.size() < std::min(most, others.size())) {
      size_t best = others.size();
      double most_added = -1;
      for (size_t i = 0; i < others.size(); ++i) {
        if (taken[i]) continue;
        double added = 0;
        for (size_t c = 0; c < kCells; ++c) added += worths[i][c] / (1 + have[c]);
        if (added <= most_added) continue;
        most_added = added;
        best = i;
      }
      taken[best] = true;
      order.push_back(others[best]);
      for (size_t c = 0; c < kCells; ++c) have[c] += worths[best][c];
    }
    return order;
  }

 private:
  static constexpr size_t kColumns = 12, kRows = 9, kCells = kColumns * kRows;
  using Worth = std::array<double, kCells>;  // of a source in each part of a photo, up to 1

  // A sparse point in a photo.
  struct Part {
    size_t cell = 0;
    double share = 0;  // of the cell's points
    const TrackPoint* point = nullptr;
  };

  std::vector<Part> PartsOf(PhotoId id) const {
    const RegisteredImage& photo = reconstruction_.photos.at(id);
    const PinholeCamera& view = views_.at(id);
    std::vector<Part> parts;
    std::array<int, kCells> counts{};
    for (const Observation& observation : photo.observations) {
      if (!observation.point.IsValid()) continue;
      const TrackPoint& point = reconstruction_.points.at(observation.point);
      const auto at = PixelIn(view, photo.cam_from_world, point.position);
      if (!at) continue;
      const auto column = static_cast<size_t>(at->x() * kColumns / view.width);
      const auto row = static_cast<size_t>(at->y() * kRows / view.height);
      const size_t cell = std::min(row, kRows - 1) * kColumns + std::min(column, kColumns - 1);
      parts.push_back({.cell = cell, .point = &point});
      ++counts[cell];
    }
    for (Part& part : parts) part.share = 1.0 / counts[part.cell];
    return parts;
  }

  // Of the whole picture, from the corner of the first pixel on; nothing outside of it.
  static std::optional<Eigen::Vector2d> PixelIn(const PinholeCamera& view, const Pose& pose,
                                                const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = pose * point;
    if (p.z() <= 0) return std::nullopt;
    const Eigen::Vector2d at(view.fx * p.x() / p.z() + view.cx + 0.5,
                             view.fy * p.y() / p.z() + view.cy + 0.5);
    const bool inside = at.x() >= 0 && at.y() >= 0 && at.x() < view.width && at.y() < view.height;
    return inside ? std::optional(at) : std::nullopt;
  }

  Worth WorthOf(PhotoId id, PhotoId other, const std::vector<Part>& parts) const {
    constexpr double kNotTracked = 0.5;  // something may stand between
    const RegisteredImage& from = reconstruction_.photos.at(id);
    const RegisteredImage& to = reconstruction_.photos.at(other);
    Worth worth{};
    for (const Part& part : parts) {
      const bool tracked =
          std::ranges::any_of(part.point->track, [&](const auto& a) { return a.photo == other; });
      const double seen = tracked ? 1
                          : PixelIn(views_.at(other), to.cam_from_world, part.point->position)
                              ? kNotTracked
                              : 0;
      if (seen == 0) continue;
      worth[part.cell] += part.share * seen *
                          PairWorth(reconstruction_, {from, centers_.at(id)},
                                    {to, centers_.at(other)}, part.point->position);
    }
    return worth;
  }

  const Reconstruction& reconstruction_;
  std::map<PhotoId, PinholeCamera> views_;
  std::map<PhotoId, Eigen::Vector3d> centers_;
};

void AddSeeds(const Reconstruction& r, const RegisteredImage& photo, const PinholeCamera& view,
              SourceChoice& choice) {
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
  const SourceOrder order(reconstruction, limits.max_image_px);
  std::map<PhotoId, SourceChoice> choices;
  for (const auto& [id, others] : ScorePairs(reconstruction)) {
    std::vector<PhotoId> usable;
    for (const auto& [other, shared] : others) {
      if (shared.points >= kLeastShared && shared.score > 1) usable.push_back(other);
    }
    if (usable.empty()) continue;
    SourceChoice& choice = choices[id];
    const auto most = static_cast<size_t>(std::max(limits.sources, limits.neighbours));
    choice.neighbours = order.Of(id, usable, most);
    choice.sources = choice.neighbours;
    choice.sources.resize(std::min(choice.sources.size(), static_cast<size_t>(limits.sources)));
    choice.neighbours.resize(
        std::min(choice.neighbours.size(), static_cast<size_t>(limits.neighbours)));
    AddSeeds(reconstruction, reconstruction.photos.at(id), order.ViewOf(id), choice);
  }
  return choices;
}

}  // namespace stucco
