// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/placement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "calib/records/georeference.h"
#include "calib/scene/scene.h"
#include "survey/median.h"

namespace stucco {
namespace {

// The photos of a model that the captures know, as a scene of poses alone.
struct PosedCaptures {
  Scene scene;
  std::vector<const CapturedPhoto*> captures;  // by photo of the scene
};

PosedCaptures PosesOf(const Captures& captures, const Reconstruction& model) {
  std::map<std::string, const CapturedPhoto*> by_path;
  for (const CapturedPhoto& photo : captures.photos) by_path[photo.path] = &photo;
  PosedCaptures result;
  for (const auto& [id, photo] : model.photos) {
    const auto capture = by_path.find(photo.name);
    if (capture == by_path.end()) continue;
    ScenePhoto& added = result.scene.photos.emplace_back();
    added.name = photo.name;
    added.pose = photo.cam_from_world;
    result.captures.push_back(capture->second);
  }
  return result;
}

ModelPlace WithoutPositions(const PosedCaptures& poses, std::string why_not) {
  ModelPlace place;
  place.georef.up = UpFromGimbal(poses.captures, poses.scene);
  place.georef.source = place.georef.up ? "gimbal" : "none";
  place.why_not = std::move(why_not);
  return place;
}

bool HasPosition(const CapturedPhoto* photo) {
  return photo->position && photo->position->has_height;
}

}  // namespace

ModelPlace PlaceByRecords(const Captures& captures, const Reconstruction& model) {
  PosedCaptures poses = PosesOf(captures, model);
  const auto frame = FrameFromPositions(poses.captures, poses.scene);
  if (!frame) {
    return WithoutPositions(poses, "fewer than three of its photos have a recorded position");
  }
  const auto up = UpFromGimbal(poses.captures, poses.scene);
  const auto fit = FitToPriors(poses.scene, up);
  if (!fit) {
    return WithoutPositions(poses,
                            "the photos' recorded positions contradict its camera positions, or "
                            "are too close together");
  }
  ModelPlace place;
  place.world_from_model = fit->enu_from_scene;
  if (fit->holds == FitHolds::kScale) {
    Transform(fit->enu_from_scene, poses.scene);
    place.georef = WithoutPositions(poses, {}).georef;
    place.georef.metric = true;
    place.why_not =
        "its photos were taken along one line, which gives the scale, but not which way is up";
    return place;
  }
  place.georef = *frame;
  for (const int photo : fit->outliers) place.outliers.push_back(poses.scene.photos[photo].name);
  return place;
}

PositionDifferences CompareWithPositions(const Captures& captures, const Georef& georef,
                                         const Reconstruction& model,
                                         const std::vector<std::string>& outliers) {
  assert(georef.frame == "enu");
  const PosedCaptures poses = PosesOf(captures, model);
  PositionDifferences result;
  std::vector<double> horizontal;
  double horizontal_squares = 0;
  double vertical_squares = 0;
  int count = 0;
  for (size_t i = 0; i < poses.captures.size(); ++i) {
    if (!HasPosition(poses.captures[i])) continue;
    const GeoPosition& recorded = *poses.captures[i]->position;
    const Eigen::Vector3d difference =
        poses.scene.photos[i].pose->Center() -
        EnuFromGeodetic(georef, recorded.latitude_deg, recorded.longitude_deg, recorded.height_m);
    const std::string& path = poses.scene.photos[i].name;
    result.distance_m[path] = difference.norm();
    if (std::find(outliers.begin(), outliers.end(), path) != outliers.end()) continue;
    horizontal.push_back(difference.head<2>().norm());
    horizontal_squares += difference.head<2>().squaredNorm();
    vertical_squares += difference.z() * difference.z();
    ++count;
  }
  if (count == 0) return result;
  result.rms_horizontal_m = std::sqrt(horizontal_squares / count);
  result.rms_vertical_m = std::sqrt(vertical_squares / count);
  result.median_horizontal_m = *Median(std::move(horizontal));
  return result;
}

}  // namespace stucco
