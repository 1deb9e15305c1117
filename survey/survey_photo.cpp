// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/survey_photo.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "survey/colmap_io.h"
#include "survey/median.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

double MedianSharpness(const Captures& captures) {
  std::vector<double> values;
  for (const CapturedPhoto& photo : captures.photos) {
    if (photo.usable && photo.sharpness > 0) values.push_back(photo.sharpness);
  }
  return Median(std::move(values)).value_or(0);
}

}  // namespace

std::vector<SurveyPhoto> JoinPhotos(const Reconstruction& reconstruction,
                                    const Captures& captures) {
  std::map<std::string, const CapturedPhoto*> by_path;
  for (const CapturedPhoto& photo : captures.photos) by_path[photo.path] = &photo;
  const double typical = MedianSharpness(captures);
  std::vector<SurveyPhoto> photos;
  for (const auto& [id, image] : reconstruction.photos) {
    SurveyPhoto& photo = photos.emplace_back();
    photo.id = id;
    const auto captured = by_path.find(image.name);
    if (captured != by_path.end()) photo.captured = *captured->second;
    photo.captured.path = image.name;
    photo.camera = reconstruction.cameras.at(image.camera);
    photo.cam_from_world = image.cam_from_world;
    const double sharpness = photo.captured.sharpness;
    if (typical > 0 && sharpness > 0) photo.relative_sharpness = sharpness / typical;
    photo.safe_radius_squared = SafeRadiusSquared(photo.camera);
  }
  return photos;
}

std::vector<SurveyPhoto> ReadSurveyPhotos(const std::filesystem::path& survey) {
  const std::filesystem::path captures = survey / kCapturesFile;
  return JoinPhotos(ReadColmapModel(survey / kSparseFolder),
                    std::filesystem::exists(captures) ? ReadCaptures(captures) : Captures{});
}

void JoinPlan(const Plan& plan, std::span<SurveyPhoto> photos) {
  std::map<std::string, const PlannedView*> views;
  for (const PlannedView& view : plan.views) views[view.id] = &view;
  for (SurveyPhoto& photo : photos) {
    photo.planned_facades.clear();
    const auto view = views.find(photo.captured.view);
    if (view == views.end()) continue;
    for (const PlannedTarget& target : view->second->targets) {
      photo.planned_facades.push_back(target.facade);
    }
  }
}

double SafeRadiusSquared(const Camera& camera) {
  double farthest = 0;
  const double width = camera.width_px;
  const double height = camera.height_px;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(width, 0), Eigen::Vector2d(0, height),
        Eigen::Vector2d(width, height)}) {
    const auto ray = camera.Unproject(corner);
    if (!ray) return 0;
    farthest = std::max(farthest, ray->squaredNorm());
  }
  const Eigen::Vector2d edge(std::sqrt(farthest), 0);
  return camera.IsInvertibleAt(edge) ? farthest : 0;
}

std::optional<Eigen::Vector2d> ProjectIntoPhoto(const SurveyPhoto& photo,
                                                const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector3d point_in_cam = photo.cam_from_world * point_in_world;
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const Eigen::Vector2d ray = point_in_cam.head<2>() / point_in_cam.z();
  const Eigen::Vector2d pixel = photo.camera.Distort(ray);
  if (!photo.camera.Contains(pixel)) return std::nullopt;
  if (ray.squaredNorm() > photo.safe_radius_squared && !photo.camera.IsInvertibleAt(ray)) {
    return std::nullopt;
  }
  return pixel;
}

}  // namespace stucco
