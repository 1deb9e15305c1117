// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/summarize_photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>

#include "calib/parts/weak_pose.h"
#include "survey/degree.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr int kCoverageCells = 10;

double Coverage(const Camera& camera, const RegisteredImage& photo) {
  std::set<int> filled;
  for (const Observation& o : photo.observations) {
    const int column = static_cast<int>(o.pixel.x() / camera.width_px * kCoverageCells);
    const int row = static_cast<int>(o.pixel.y() / camera.height_px * kCoverageCells);
    filled.insert(row * kCoverageCells + column);
  }
  return static_cast<double>(filled.size()) / (kCoverageCells * kCoverageCells);
}

CalibratedPhoto DescribePhoto(const Reconstruction& reconstruction,
                              const RegisteredImage& registered) {
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
  photo.coverage = Coverage(camera, registered);
  return photo;
}

void SetSigma(const PoseSigma& sigma, CalibratedPhoto& photo) {
  if (sigma.position >= 0) {
    photo.position_sigma = sigma.position;
    photo.rotation_sigma_deg = sigma.rotation_rad / kDegree;
  }
  if (sigma.picture_px >= 0) photo.picture_sigma_px = sigma.picture_px;
}

// What has a reason already is weak.
void JudgePart(int part, std::vector<CalibratedPhoto>& photos) {
  std::vector<double> positions;
  for (const CalibratedPhoto& photo : photos) {
    if (photo.part == part) positions.push_back(photo.position_sigma);
  }
  const double usual = Median(std::move(positions)).value_or(0);
  for (CalibratedPhoto& photo : photos) {
    if (photo.part != part) continue;
    if (photo.why.empty()) {
      photo.why = WhyWeak(photo.position_sigma, photo.observations, usual);
    }
    photo.state = photo.why.empty() ? PhotoState::kTied : PhotoState::kWeak;
  }
}

// Photos of one model, and how surely each is placed.
void AddPhotos(const Reconstruction& reconstruction, const std::vector<uint32_t>& ids,
               const std::vector<PoseSigma>& sigmas, const SummaryInput& input,
               std::vector<CalibratedPhoto>& photos) {
  for (size_t i = 0; i < ids.size(); ++i) {
    const auto registered = reconstruction.photos.find(PhotoId{ids[i]});
    if (registered == reconstruction.photos.end()) continue;
    CalibratedPhoto& photo = photos.emplace_back(DescribePhoto(reconstruction, registered->second));
    SetSigma(sigmas[i], photo);
    if (input.parts != nullptr) photo.part = input.parts->part_of_photo[i];
  }
}

int NumPoints(const Scene& scene) {
  return static_cast<int>(std::ranges::count_if(
      scene.tracks, [](const SceneTrack& track) { return track.position.has_value(); }));
}

}  // namespace

std::vector<CalibratedPhoto> SummarizePhotos(const SummaryInput& input,
                                             const Reconstruction& reconstruction) {
  const std::vector<uint32_t> ids = PhotoIds(input);
  std::vector<CalibratedPhoto> photos;
  AddPhotos(reconstruction, ids, input.sigmas.poses, input, photos);
  size_t next = 0;
  for (size_t i = 0; i < ids.size(); ++i) {
    if (!reconstruction.photos.contains(PhotoId{ids[i]})) continue;
    CalibratedPhoto& photo = photos[next++];
    photo.prior_residual_m = input.priors.distance_m[i];
    photo.prior_outlier = std::ranges::count(input.prior_outliers, static_cast<int>(i)) > 0;
    if (std::ranges::binary_search(input.off_together, static_cast<int>(i))) {
      photo.why = "it and photos around it are off their records together";
    }
  }
  if (input.parts == nullptr) {
    JudgePart(0, photos);
    return photos;
  }
  for (const ScenePart& part : input.parts->others) {
    if (part.model == 0) continue;
    AddPhotos(ToReconstruction(part.scene, ids), ids, part.sigmas.poses, input, photos);
  }
  for (int part = 0; part <= static_cast<int>(input.parts->others.size()); ++part) {
    JudgePart(part, photos);
  }
  return photos;
}

std::vector<CalibratedPart> SummarizeParts(const SummaryInput& input) {
  if (input.parts == nullptr) return {};
  const SceneParts& parts = *input.parts;
  std::vector<CalibratedPart> result(1);
  result[0].model = "sparse/0";
  result[0].points = NumPoints(input.scene);
  for (const ScenePart& part : parts.others) {
    CalibratedPart& added = result.emplace_back();
    added.model = fmt::format("sparse/{}", part.model);
    added.points = NumPoints(part.scene);
    added.placed_by = part.place ? "records" : "nothing";
    added.why = part.why;
    if (part.model == 0) result[0].points -= added.points;
    if (!part.place) continue;
    added.position_sigma_m = part.place->position_sigma_m;
    added.rotation_sigma_deg = part.place->rotation_sigma_rad / kDegree;
    added.shared_surface = part.place->shared_surface;
  }
  for (const int part : parts.part_of_photo) {
    if (part >= 0) ++result[part].photos;
  }
  return result;
}

std::vector<CalibratedPhoto> SummarizeRecordOnly(const SummaryInput& input,
                                                 const std::vector<PoseRecord>& records,
                                                 const RecordErrors& errors) {
  assert(records.size() == input.scene.photos.size());
  Scene corrected;  // of records alone
  corrected.photos.resize(records.size());
  ApplyRecords(records, errors, corrected);
  std::vector<CalibratedPhoto> photos;
  for (const auto& [index, why] : input.unregistered) {
    const ScenePhoto& recorded = corrected.photos[index];
    const bool is_placed = input.parts != nullptr && input.parts->part_of_photo[index] >= 0;
    if (is_placed || !recorded.prior || !recorded.attitude) continue;
    CalibratedPhoto& photo = photos.emplace_back();
    photo.path = input.scene.photos[index].name;
    photo.state = std::ranges::binary_search(input.ambiguous, index) ? PhotoState::kAmbiguous
                                                                     : PhotoState::kRecordOnly;
    photo.why = why;
    photo.part = -1;
    photo.position_sigma = std::sqrt(2 * std::pow(recorded.prior->sigma_horizontal_m, 2) +
                                     std::pow(recorded.prior->sigma_vertical_m, 2));
    photo.rotation_sigma_deg = std::sqrt(3) * recorded.attitude->sigma_rad / kDegree;
    const Eigen::Vector3d& center = recorded.prior->position;
    const Eigen::Quaterniond& rotation = recorded.attitude->cam_from_world;
    photo.center = {center.x(), center.y(), center.z()};
    photo.rotation = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
  }
  return photos;
}

}  // namespace stucco
