// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/describe_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace stucco {
namespace {

CalibratedPhoto DescribePhoto(const Reconstruction& model, const RegisteredImage& photo,
                              const PlacedModel& place) {
  CalibratedPhoto result;
  result.path = photo.name;
  const Camera& camera = model.cameras.at(photo.camera);
  double sum_px = 0;
  for (const Observation& observation : photo.observations) {
    const auto point = model.points.find(observation.point);
    if (point == model.points.end()) continue;
    const auto pixel = camera.Project(photo.cam_from_world * point->second.position);
    if (!pixel) continue;
    sum_px += (*pixel - observation.pixel).norm();
    ++result.observations;
  }
  result.reprojection_error_px = result.observations > 0 ? sum_px / result.observations : 0;
  const auto distance = place.differences.distance_m.find(photo.name);
  if (distance != place.differences.distance_m.end()) result.prior_residual_m = distance->second;
  result.prior_outlier =
      std::find(place.outliers.begin(), place.outliers.end(), photo.name) != place.outliers.end();
  return result;
}

CalibratedCamera DescribeCamera(const Camera& camera) {
  CalibratedCamera result;
  result.id = static_cast<int>(camera.id.value);
  result.label =
      fmt::format("camera {}, {} x {}", camera.id.value, camera.width_px, camera.height_px);
  result.model = Name(camera.model);
  const auto names = ParameterNames(camera.model);
  result.names.assign(names.begin(), names.end());
  result.params = camera.params;
  return result;
}

}  // namespace

Calibration DescribeModel(const Reconstruction& model, const PlacedModel& place,
                          const Captures* captures) {
  Calibration calibration;
  std::set<std::string> posed;
  for (const auto& [id, photo] : model.photos) {
    calibration.photos.push_back(DescribePhoto(model, photo, place));
    posed.insert(photo.name);
  }
  std::sort(calibration.photos.begin(), calibration.photos.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  if (captures != nullptr) {
    for (const CapturedPhoto& photo : captures->photos) {
      if (photo.usable && !posed.contains(photo.path)) {
        calibration.unposed.push_back({photo.path, "not in the imported model"});
      }
    }
  }
  calibration.photos_posed = static_cast<int>(posed.size());
  calibration.photos_total = static_cast<int>(posed.size() + calibration.unposed.size());
  calibration.reprojection_error_px = MeanReprojectionError(model);
  calibration.points = static_cast<int>(model.points.size());
  calibration.mean_track_length = MeanTrackLength(model);
  calibration.prior_rms_horizontal_m = place.differences.rms_horizontal_m;
  calibration.prior_rms_vertical_m = place.differences.rms_vertical_m;
  for (const auto& [id, camera] : model.cameras) {
    calibration.cameras.push_back(DescribeCamera(camera));
  }
  return calibration;
}

}  // namespace stucco
