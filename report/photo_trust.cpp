// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/photo_trust.h"

#include <algorithm>
#include <utility>

#include "survey/median.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

const CalibratedPhoto* Find(const SurveyData& data, const std::string& path) {
  if (!data.calibration) return nullptr;
  const auto& photos = data.calibration->photos;
  const auto found = std::ranges::find(photos, path, &CalibratedPhoto::path);
  return found == photos.end() ? nullptr : &*found;
}

}  // namespace

bool IsInMainModel(const Calibration& calibration, const CalibratedPhoto& photo) {
  if (!IsInModel(photo.state) || photo.part < 0) return false;
  const auto part = static_cast<size_t>(photo.part);
  return part >= calibration.parts.size() ||
         "calib/" + calibration.parts[part].model == kSparseFolder;
}

int CountInMainModel(const Calibration& calibration) {
  return static_cast<int>(std::ranges::count_if(
      calibration.photos, [&](const auto& photo) { return IsInMainModel(calibration, photo); }));
}

Placement SummarizePlacement(const Calibration& calibration) {
  Placement placement;
  for (const PhotoState state :
       {PhotoState::kTied, PhotoState::kWeak, PhotoState::kAmbiguous, PhotoState::kRecordOnly}) {
    placement.states[state] = 0;
  }
  std::vector<double> positions;
  std::vector<double> rotations;
  std::vector<double> pictures;
  for (const CalibratedPhoto& photo : calibration.photos) {
    if (IsInModel(photo.state) && !IsInMainModel(calibration, photo)) {
      ++placement.apart;
      continue;
    }
    ++placement.states[photo.state];
    if (!IsInModel(photo.state) || photo.position_sigma < 0) continue;
    positions.push_back(photo.position_sigma);
    rotations.push_back(photo.rotation_sigma_deg);
    if (photo.picture_sigma_px >= 0) pictures.push_back(photo.picture_sigma_px);
  }
  if (positions.empty()) return placement;
  const auto sigma = [&](double share) {
    return PlacementSigma{*Quantile(positions, share), *Quantile(rotations, share),
                          Quantile(pictures, share).value_or(-1)};
  };
  placement.middle = sigma(0.5);
  placement.nine_in_ten = sigma(0.9);
  return placement;
}

std::vector<const CalibratedPhoto*> PhotosNotToTrust(const Calibration& calibration) {
  std::vector<const CalibratedPhoto*> photos;
  for (const CalibratedPhoto& photo : calibration.photos) {
    if (photo.state == PhotoState::kTied) continue;
    if (IsInModel(photo.state) && !IsInMainModel(calibration, photo)) continue;
    photos.push_back(&photo);
  }
  std::ranges::stable_sort(photos, [](const auto* a, const auto* b) {
    return std::pair(a->state, a->position_sigma) > std::pair(b->state, b->position_sigma);
  });
  return photos;
}

bool IsWeak(const SurveyData& data, const std::string& path) {
  const CalibratedPhoto* photo = Find(data, path);
  return photo != nullptr && photo->state == PhotoState::kWeak;
}

std::optional<FacetPlacement> PlacementOf(const SurveyData& data, const TexturedFacet& texture) {
  std::vector<double> sigmas_px;
  for (const std::string& path : texture.photos) {
    const CalibratedPhoto* photo = Find(data, path);
    if (photo != nullptr && photo->picture_sigma_px >= 0) {
      sigmas_px.push_back(photo->picture_sigma_px);
    }
  }
  if (sigmas_px.empty()) return std::nullopt;
  const double worst = *std::ranges::max_element(sigmas_px);
  return FacetPlacement{*Median(std::move(sigmas_px)), worst};
}

}  // namespace stucco
