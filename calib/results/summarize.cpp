// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/summarize.h"

#include <algorithm>
#include <cassert>

#include "calib/adjust/adjust.h"
#include "calib/results/record_findings.h"
#include "calib/results/summarize_photos.h"
#include "survey/degree.h"

namespace stucco {
namespace {

// A parameter whose uncertainty is still most of what was assumed beforehand is not measured.
constexpr double kUndetermined = 0.7;

CalibratedCamera SummarizeCamera(const CapturedCamera& captured, const SceneCamera& camera,
                                 const Eigen::VectorXd* sigma) {
  CalibratedCamera result;
  result.id = static_cast<int>(camera.intrinsics.id.value);
  result.label = captured.label;
  result.model = std::string(Name(camera.intrinsics.model));
  result.params = camera.intrinsics.params;
  for (const auto name : ParameterNames(camera.intrinsics.model)) result.names.emplace_back(name);
  if (camera.focal_sigma_ratio == 0) result.held = result.names;
  if (sigma == nullptr) return result;
  result.sigma.assign(sigma->begin(), sigma->end());
  for (size_t i = 0; i < result.names.size() && camera.focal_sigma_ratio > 0; ++i) {
    if (result.sigma[i] > kUndetermined * PriorSigma(camera, static_cast<int>(i))) {
      result.held.push_back(result.names[i]);
    }
  }
  return result;
}

CalibratedRecords SummarizeRecords(const RecordErrors& errors) {
  CalibratedRecords result;
  result.attitude_sigma_deg = errors.sigma_attitude_rad / kDegree;
  result.mount_deg = errors.mount_rad.norm() / kDegree;
  if (errors.sigma_hover_m > 0) result.hover_sigma_m = errors.sigma_hover_m;
  for (const FlightErrors& flight : errors.flights) {
    result.flights.push_back({flight.num_photos,
                              {flight.shift_m.x(), flight.shift_m.y(), flight.shift_m.z()},
                              flight.sigma_horizontal_m,
                              flight.sigma_vertical_m,
                              flight.yaw_rad / kDegree});
  }
  return result;
}

}  // namespace

Calibration Summarize(const SummaryInput& input) {
  assert(IsConsistent(input.scene));
  assert(input.capture_of_photo.size() == input.scene.photos.size());
  assert(input.captures.cameras.size() == input.scene.cameras.size());
  assert(input.priors.distance_m.size() == input.scene.photos.size());
  assert(input.sigmas.poses.size() == input.scene.photos.size());
  const std::vector<uint32_t> ids = PhotoIds(input);
  const Reconstruction reconstruction = ToReconstruction(input.scene, ids);
  Calibration result;
  result.photos_total = static_cast<int>(input.captures.photos.size());
  result.photos_posed = static_cast<int>(reconstruction.photos.size());
  result.reprojection_error_px = MeanReprojectionError(reconstruction);
  result.points = static_cast<int>(reconstruction.points.size());
  result.mean_track_length = MeanTrackLength(reconstruction);
  result.prior_rms_horizontal_m = input.priors.rms_horizontal_m;
  result.prior_rms_vertical_m = input.priors.rms_vertical_m;
  result.photos = SummarizePhotos(input, reconstruction);
  result.parts = SummarizeParts(input);
  if (input.records != nullptr) {
    result.records = SummarizeRecords(*input.records);
    result.findings = RecordFindings(result.records, result.photos);
  }
  for (const auto& [photo, why] : input.unregistered) {
    result.unposed.push_back({input.scene.photos[photo].name, why});
  }
  for (const CapturedPhoto& photo : input.captures.photos) {
    if (!photo.usable) result.unposed.push_back({photo.path, photo.why});
  }
  std::sort(result.unposed.begin(), result.unposed.end(),
            [](const UnposedPhoto& a, const UnposedPhoto& b) { return a.path < b.path; });
  const std::vector<Eigen::VectorXd>& sigmas = input.sigmas.intrinsics;
  for (size_t c = 0; c < input.scene.cameras.size(); ++c) {
    if (!reconstruction.cameras.contains(input.scene.cameras[c].intrinsics.id)) continue;
    result.cameras.push_back(SummarizeCamera(input.captures.cameras[c], input.scene.cameras[c],
                                             sigmas.empty() ? nullptr : &sigmas[c]));
  }
  return result;
}

}  // namespace stucco
