// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/sources.h"

#include <algorithm>
#include <array>
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

// The parts of a picture: plain ones, with few points, count as much as others.
constexpr int kColumns = 12, kRows = 9, kCells = kColumns * kRows;

// A sparse point in a photo.
struct SeenPoint {
  const TrackPoint* point = nullptr;
  DepthSeed seed;
  int cell = 0;
  double share = 0;  // of the cell's points
};

std::vector<SeenPoint> PointsIn(const Reconstruction& r, const RegisteredImage& photo,
                                const PinholeCamera& view) {
  std::vector<SeenPoint> seen;
  std::array<int, kCells> counts{};
  for (const Observation& observation : photo.observations) {
    if (!observation.point.IsValid()) continue;
    const TrackPoint& point = r.points.at(observation.point);
    const Eigen::Vector3d p = photo.cam_from_world * point.position;
    if (p.z() <= 0) continue;
    const DepthSeed seed{.x = static_cast<float>(view.fx * p.x() / p.z() + view.cx),
                         .y = static_cast<float>(view.fy * p.y() / p.z() + view.cy),
                         .depth = static_cast<float>(p.z())};
    const auto part_of = [](float at, int size, int parts) {
      return std::clamp(
          static_cast<int>((at + 0.5f) * static_cast<float>(parts) / static_cast<float>(size)), 0,
          parts - 1);
    };
    const int cell =
        part_of(seed.y, view.height, kRows) * kColumns + part_of(seed.x, view.width, kColumns);
    seen.push_back({.point = &point, .seed = seed, .cell = cell});
    ++counts[cell];
  }
  for (SeenPoint& one : seen) one.share = 1.0 / counts[one.cell];
  return seen;
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

  // `seen` are the points in the photo.
  std::vector<PhotoId> Of(PhotoId id, const std::vector<SeenPoint>& seen,
                          const std::vector<PhotoId>& others, size_t most) const {
    std::vector<Worth> worths;
    worths.reserve(others.size());
    for (const PhotoId other : others) worths.push_back(WorthOf(id, other, seen));
    Worth have{};
    std::vector<bool> taken(others.size(), false);
    std::vector<PhotoId> order;
    while (order.size() < std::min(most, others.size())) {
      const size_t best = BestOf(worths, taken, have);
      taken[best] = true;
      order.push_back(others[best]);
      for (size_t c = 0; c < kCells; ++c) have[c] += worths[best][c];
    }
    return order;
  }

 private:
  using Worth = std::array<double, kCells>;  // of a source in each part of a photo, up to 1

  static size_t BestOf(const std::vector<Worth>& worths, const std::vector<bool>& taken,
                       const Worth& have) {
    size_t best = 0;
    double most = -1;
    for (size_t i = 0; i < worths.size(); ++i) {
      if (taken[i]) continue;
      double added = 0;
      for (size_t c = 0; c < kCells; ++c) added += worths[i][c] / (1 + have[c]);
      if (added <= most) continue;
      most = added;
      best = i;
    }
    return best;
  }

  Worth WorthOf(PhotoId id, PhotoId other, const std::vector<SeenPoint>& seen) const {
    constexpr double kNotTracked = 0.5;  // something may stand between
    const RegisteredImage& from = reconstruction_.photos.at(id);
    const RegisteredImage& to = reconstruction_.photos.at(other);
    Worth worth{};
    for (const SeenPoint& one : seen) {
      const bool tracked =
          std::ranges::any_of(one.point->track, [&](const auto& a) { return a.photo == other; });
      if (!tracked && !Shows(views_.at(other), to.cam_from_world, one.point->position)) continue;
      worth[one.cell] += one.share * (tracked ? 1 : kNotTracked) *
                         PairWorth(reconstruction_, {from, centers_.at(id)},
                                   {to, centers_.at(other)}, one.point->position);
    }
    return worth;
  }

  static bool Shows(const PinholeCamera& view, const Pose& pose, const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = pose * point;
    if (p.z() <= 0) return false;
    const double x = view.fx * p.x() / p.z() + view.cx, y = view.fy * p.y() / p.z() + view.cy;
    return x >= -0.5 && y >= -0.5 && x < view.width - 0.5 && y < view.height - 0.5;
  }

  const Reconstruction& reconstruction_;
  std::map<PhotoId, PinholeCamera> views_;
  std::map<PhotoId, Eigen::Vector3d> centers_;
};

// The nearest and farthest depth but for a hundredth of the picture each.
void AddBounds(std::vector<SeenPoint> seen, SourceChoice& choice) {
  constexpr double kLeftOut = 0.01;
  std::ranges::stable_sort(seen, {}, [](const SeenPoint& one) { return one.seed.depth; });
  double all = 0;
  for (const SeenPoint& one : seen) all += one.share;
  const auto beyond = [&](auto begin, auto end) {
    double share = 0;
    return std::find_if(begin, end, [&](const SeenPoint& one) {
      share += one.share;
      return share > kLeftOut * all;
    });
  };
  choice.min_depth =
      static_cast<float>(beyond(seen.begin(), seen.end())->seed.depth / kDepthMargin);
  choice.max_depth =
      static_cast<float>(beyond(seen.rbegin(), seen.rend())->seed.depth * kDepthMargin);
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
    const auto seen = PointsIn(reconstruction, reconstruction.photos.at(id), order.ViewOf(id));
    if (seen.empty()) continue;
    SourceChoice& choice = choices[id];
    const auto most = static_cast<size_t>(std::max(limits.sources, limits.neighbours));
    choice.neighbours = order.Of(id, seen, usable, most);
    choice.sources = choice.neighbours;
    choice.sources.resize(std::min(choice.sources.size(), static_cast<size_t>(limits.sources)));
    choice.neighbours.resize(
        std::min(choice.neighbours.size(), static_cast<size_t>(limits.neighbours)));
    AddBounds(seen, choice);
    choice.seeds.reserve(seen.size());
    for (const SeenPoint& one : seen) choice.seeds.push_back(one.seed);
  }
  return choices;
}

}  // namespace stucco
