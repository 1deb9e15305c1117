// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/views_by_pose.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "survey/median.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

// Gimbals and compasses are good to a degree or two; the views of one stop look farther apart.
constexpr double kSameDirection_deg = 10;
// Drones stand within a metre of where they were sent, receivers without RTK err by a few in all.
constexpr double kLargestShift_m = 6;
constexpr double kSamePlace_m = 2;
constexpr int kRounds = 5;

struct Stand {
  Vector3d position = Vector3d::Zero();
  Vector3d direction = Vector3d::UnitY();  // unit
};

Stand StandOf(const PlannedView& view, const Plan& plan, const Georef& georef) {
  const double to_rad = std::numbers::pi / 180;
  const double yaw = view.yaw_deg * to_rad;
  const double pitch = view.pitch_deg * to_rad;
  Stand stand;
  stand.position.head<2>() = EnuFromPlan(plan.origin, georef, view.position_m.head<2>());
  stand.position.z() = view.position_m.z();
  stand.direction = {std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch),
                     std::sin(pitch)};
  return stand;
}

Stand StandOf(const SurveyPhoto& photo) {
  return {photo.cam_from_world.Center(),
          photo.cam_from_world.rotation.conjugate() * Vector3d::UnitZ()};
}

// The view that looks the same way and is nearest, each axis of the difference to it weighed;
// nothing beyond `reach_m`.
std::optional<size_t> Nearest(const Stand& photo, const std::vector<Stand>& views,
                              const Vector3d& weights, double reach_m) {
  const double least_cos = std::cos(kSameDirection_deg * std::numbers::pi / 180);
  std::optional<size_t> best;
  double nearest = reach_m;
  for (size_t v = 0; v < views.size(); ++v) {
    if (views[v].direction.dot(photo.direction) < least_cos) continue;
    const double distance = (photo.position - views[v].position).cwiseProduct(weights).norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    best = v;
  }
  return best;
}

Vector3d MedianOf(std::span<const Vector3d> offsets) {
  Vector3d median;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> along;
    along.reserve(offsets.size());
    for (const Vector3d& offset : offsets) along.push_back(offset[k]);
    median[k] = Median(std::move(along)).value_or(0);
  }
  return median;
}

// By how much photos stand off the views that are nearest to them; heights do not count where the
// weight of z is 0.
Vector3d MedianOffset(const std::vector<Stand>& photos, const std::vector<Stand>& views,
                      const Vector3d& weights) {
  std::vector<Vector3d> offsets;
  for (const Stand& photo : photos) {
    const auto view = Nearest(photo, views, weights, kLargestShift_m);
    if (view) offsets.push_back(photo.position - views[*view].position);
  }
  return MedianOf(offsets);
}

void Move(std::vector<Stand>& views, const Vector3d& offset) {
  for (Stand& view : views) view.position += offset;
}

// Brings views to where the photos stand: by the photos whose view is known, else by the views
// that are nearest to each.
void ShiftToPhotos(const std::vector<Stand>& photos,
                   const std::vector<std::optional<size_t>>& view_of, std::vector<Stand>& views) {
  std::vector<Vector3d> known;
  for (size_t p = 0; p < photos.size(); ++p) {
    if (view_of[p]) known.push_back(photos[p].position - views[*view_of[p]].position);
  }
  if (!known.empty()) {
    Move(views, MedianOf(known));
    return;
  }
  // Heights of plan and world may have nothing in common; places do.
  Move(views, MedianOffset(photos, views, {1, 1, 0}));
  for (int round = 0; round < kRounds; ++round) {
    Move(views, MedianOffset(photos, views, Vector3d::Ones()));
  }
}

// Of each photo the view that its file name says, where the plan has it.
std::vector<std::optional<size_t>> ViewsByName(const Plan& plan,
                                               std::span<const SurveyPhoto> photos) {
  std::map<std::string, size_t> views;
  for (size_t v = 0; v < plan.views.size(); ++v) views[plan.views[v].id] = v;
  std::vector<std::optional<size_t>> found(photos.size());
  for (size_t p = 0; p < photos.size(); ++p) {
    const auto view = views.find(photos[p].captured.view);
    if (view != views.end()) found[p] = view->second;
  }
  return found;
}

}  // namespace

void NameViewsByPose(const Plan& plan, const Georef& georef, std::span<SurveyPhoto> photos) {
  if (georef.frame != "enu") return;
  std::vector<Stand> stands;
  for (const SurveyPhoto& photo : photos) stands.push_back(StandOf(photo));
  std::vector<Stand> views;
  for (const PlannedView& view : plan.views) views.push_back(StandOf(view, plan, georef));
  const std::vector<std::optional<size_t>> named = ViewsByName(plan, photos);
  ShiftToPhotos(stands, named, views);
  std::vector<std::optional<size_t>> photo_of(views.size());
  for (size_t p = 0; p < named.size(); ++p) {
    if (named[p]) photo_of[*named[p]] = p;
  }
  const std::vector<std::optional<size_t>> photo_by_name = photo_of;
  size_t found = 0;
  for (size_t p = 0; p < stands.size(); ++p) {
    if (named[p]) ++found;
    if (!photos[p].captured.view.empty()) continue;
    const auto view = Nearest(stands[p], views, Vector3d::Ones(), kSamePlace_m);
    if (!view) continue;
    ++found;
    const auto away = [&](size_t photo) {
      return (stands[photo].position - views[*view].position).norm();
    };
    std::optional<size_t>& taken = photo_of[*view];
    if (!photo_by_name[*view] && (!taken || away(p) < away(*taken))) taken = p;
  }
  if (2 * found < photos.size()) return;
  for (size_t v = 0; v < views.size(); ++v) {
    if (photo_of[v]) photos[*photo_of[v]].captured.view = plan.views[v].id;
  }
}

}  // namespace stucco
