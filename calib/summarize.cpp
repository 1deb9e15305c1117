// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/summarize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "calib/adjust.h"
#include "survey/median.h"

namespace stucco {
namespace {

// A parameter whose uncertainty is still most of what was assumed beforehand is not measured.
constexpr double kUndetermined = 0.7;
constexpr int kCoverageCells = 10;
constexpr double kDegree = M_PI / 180;
// A pose is weak when so few observations hold it, when it is this many times less certain than the
// middle one, or when it and its neighbours' are off their records together.
constexpr int kFewObservations = 50;
constexpr double kUncertain = 5;
// What a photo's keypoints share and its pose takes up shows in no residual: in simulated flights
// poses were this much farther off than their residuals say (docs/benchmarks.md).
constexpr double kSharedErrors = 1.4;

double Coverage(const Camera& camera, const RegisteredImage& photo) {
  std::set<int> filled;
  for (const Observation& o : photo.observations) {
    const int column = static_cast<int>(o.pixel.x() / camera.width_px * kCoverageCells);
    const int row = static_cast<int>(o.pixel.y() / camera.height_px * kCoverageCells);
    filled.insert(row * kCoverageCells + column);
  }
  return static_cast<double>(filled.size()) / (kCoverageCells * kCoverageCells);
}

CalibratedPhoto SummarizePhoto(const SummaryInput& input, const Reconstruction& reconstruction,
                               const RegisteredImage& registered, int index) {
  CalibratedPhoto photo;
  photo.path = registered.name;
  const Camera& camera = reconstruction.cameras.at(registered.camera);
  double sum = 0;
  for (const Observation& o : registered.observations) {
    const auto pixel =
        camera.Project(registered.cam_from_world * reconstruction.points.at(o.point).position);
    if (pixel) sum += (*pixel - o.pixel).norm();
  }
  photo.observations = static_cast<int>(registered.observations.size());
  photo.reprojection_error_px = photo.observations > 0 ? sum / photo.observations : 0;
  photo.prior_residual_m = input.priors.distance_m[index];
  photo.prior_outlier = std::find(input.prior_outliers.begin(), input.prior_outliers.end(),
                                  index) != input.prior_outliers.end();
  photo.coverage = Coverage(camera, registered);
  return photo;
}

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

// Photos of the scene in the order of `result.photos`.
void AddSigmas(const SummaryInput& input, const std::vector<int>& photos, Calibration& result) {
  const std::vector<PoseSigma>& sigmas = input.sigmas.poses;
  std::vector<double> positions;
  positions.reserve(photos.size());
  for (const int photo : photos) positions.push_back(sigmas[photo].position);
  const double usual = Median(std::move(positions)).value_or(0);
  for (size_t i = 0; i < photos.size(); ++i) {
    CalibratedPhoto& photo = result.photos[i];
    const PoseSigma& sigma = sigmas[photos[i]];
    if (sigma.position >= 0) {
      photo.position_sigma = kSharedErrors * sigma.position;
      photo.rotation_sigma_deg = kSharedErrors * sigma.rotation_rad / kDegree;
    }
    const bool is_weak = sigma.position < 0 || sigma.position > kUncertain * usual ||
                         photo.observations < kFewObservations ||
                         std::ranges::binary_search(input.off_together, photos[i]);
    photo.state = is_weak ? "weak" : "tied";
  }
}

CalibratedRecords SummarizeRecords(const RecordErrors& errors) {
  CalibratedRecords result;
  result.attitude_sigma_deg = errors.sigma_attitude_rad / kDegree;
  result.mount_deg = errors.mount_rad.norm() / kDegree;
  for (const FlightErrors& flight : errors.flights) {
    result.flights.push_back({flight.num_photos,
                              {flight.shift_m.x(), flight.shift_m.y(), flight.shift_m.z()},
                              flight.sigma_horizontal_m,
                              flight.sigma_vertical_m,
                              flight.yaw_rad / kDegree});
  }
  return result;
}

// Sentences for what a user should look after.
void AddFindings(const CalibratedRecords& records, Calibration& result) {
  constexpr double kMuchYaw_deg = 2;
  constexpr double kMuchMount_deg = 1;
  constexpr double kMuchShift_m = 1;
  for (size_t f = 0; f < records.flights.size(); ++f) {
    const CalibratedFlight& flight = records.flights[f];
    const double shift =
        std::hypot(flight.shift_m[0], std::hypot(flight.shift_m[1], flight.shift_m[2]));
    if (std::abs(flight.yaw_deg) > kMuchYaw_deg) {
      result.findings.push_back(
          fmt::format("flight {}: its recorded yaw is {:.1f} degrees off; calibrate the compass",
                      f + 1, std::abs(flight.yaw_deg)));
    }
    if (shift > kMuchShift_m) {
      result.findings.push_back(
          fmt::format("flight {}: its positions are shifted by {:.1f} m against those of the "
                      "other flights, which was taken into account",
                      f + 1, shift));
    }
  }
  if (records.mount_deg > kMuchMount_deg) {
    result.findings.push_back(fmt::format(
        "the camera looks {:.1f} degrees beside what the gimbal says; calibrate the gimbal",
        records.mount_deg));
  }
}

}  // namespace

Reconstruction ToReconstruction(const Scene& scene, const std::vector<uint32_t>& photo_ids) {
  assert(photo_ids.size() == scene.photos.size());
  Reconstruction result;
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    const ScenePhoto& photo = scene.photos[i];
    if (!photo.pose) continue;
    const Camera& camera = scene.CameraOf(static_cast<int>(i));
    result.cameras[camera.id] = camera;
    RegisteredImage& registered = result.photos[PhotoId{photo_ids[i]}];
    registered.id = PhotoId{photo_ids[i]};
    registered.camera = camera.id;
    registered.name = photo.name;
    registered.cam_from_world = *photo.pose;
  }
  uint64_t next = 1;
  for (const SceneTrack& track : scene.tracks) {
    // The last filtering may have taken a pose, and with it all but one view of a point.
    const auto used = std::count_if(track.elements.begin(), track.elements.end(),
                                    [](const SceneElement& e) { return e.used; });
    if (!track.position || used < 2) continue;
    TrackPoint point;
    point.id = PointId{next++};
    point.position = *track.position;
    double error = 0;
    for (const SceneElement& element : track.elements) {
      if (!element.used) continue;
      const ScenePhoto& photo = scene.photos[element.photo];
      RegisteredImage& registered = result.photos.at(PhotoId{photo_ids[element.photo]});
      if (point.track.empty()) point.rgb = photo.colors[element.keypoint];
      point.track.push_back({registered.id, static_cast<uint32_t>(registered.observations.size())});
      registered.observations.push_back({photo.keypoints[element.keypoint], point.id});
      error += ReprojectionError(scene, element, point.position);
    }
    point.error_px = error / static_cast<double>(point.track.size());
    result.points[point.id] = std::move(point);
  }
  return result;
}

std::vector<uint32_t> PhotoIds(const SummaryInput& input) {
  std::vector<uint32_t> ids;
  for (const int capture : input.capture_of_photo) {
    ids.push_back(static_cast<uint32_t>(capture) + 1);
  }
  return ids;
}

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
  std::vector<int> posed;
  for (size_t i = 0; i < input.scene.photos.size(); ++i) {
    const auto registered = reconstruction.photos.find(PhotoId{ids[i]});
    if (registered == reconstruction.photos.end()) continue;
    posed.push_back(static_cast<int>(i));
    result.photos.push_back(
        SummarizePhoto(input, reconstruction, registered->second, static_cast<int>(i)));
  }
  AddSigmas(input, posed, result);
  if (input.records != nullptr) {
    result.records = SummarizeRecords(*input.records);
    AddFindings(result.records, result);
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
