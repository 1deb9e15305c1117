// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "survey/internal/json.h"

namespace stucco {
namespace {

constexpr std::array<std::pair<PhotoState, std::string_view>, 4> kStates = {{
    {PhotoState::kTied, "tied"},
    {PhotoState::kWeak, "weak"},
    {PhotoState::kAmbiguous, "ambiguous"},
    {PhotoState::kRecordOnly, "record-only"},
}};

// Whether lists that belong together are of one length, and parts that photos name are there.
[[maybe_unused]] bool FitsTogether(const Calibration& calibration) {
  const auto parts = static_cast<int>(calibration.parts.size());  // none of an imported model
  const auto has = [](const std::vector<double>& numbers, size_t count) {
    return numbers.empty() || numbers.size() == count;
  };
  return std::ranges::all_of(calibration.photos,
                             [&](const CalibratedPhoto& photo) {
                               return photo.part >= -1 && (parts == 0 || photo.part < parts) &&
                                      has(photo.center, 3) && has(photo.rotation, 4);
                             }) &&
         std::ranges::all_of(calibration.cameras, [&](const CalibratedCamera& camera) {
           return camera.params.size() == camera.names.size() &&
                  has(camera.sigma, camera.names.size());
         });
}

}  // namespace

std::string_view Name(PhotoState state) {
  for (const auto& [known, name] : kStates) {
    if (known == state) return name;
  }
  return "";
}

std::optional<PhotoState> PhotoStateFromName(std::string_view name) {
  for (const auto& [state, known] : kStates) {
    if (known == name) return state;
  }
  return std::nullopt;
}

bool IsInModel(PhotoState state) {
  return state == PhotoState::kTied || state == PhotoState::kWeak;
}

template <typename Archive, internal::Is<CalibratedPhoto> T>
static void Fields(Archive& archive, T& photo) {
  archive.Required("path", photo.path);
  archive.Required("reprojection_error_px", photo.reprojection_error_px);
  archive.Required("observations", photo.observations);
  archive.Optional("prior_residual_m", photo.prior_residual_m);
  archive.Optional("prior_outlier", photo.prior_outlier);
  archive.Optional("coverage", photo.coverage);
  std::string state(Name(photo.state));
  archive.Optional("state", state);
  if constexpr (Archive::kReads) {
    const auto known = PhotoStateFromName(state);
    if (!known) archive.Fail("state", fmt::format("is \"{}\", which is no known state", state));
    photo.state = *known;
  }
  archive.Optional("why", photo.why);
  archive.Optional("part", photo.part);
  archive.Optional("position_sigma", photo.position_sigma);
  archive.Optional("rotation_sigma_deg", photo.rotation_sigma_deg);
  archive.Optional("picture_sigma_px", photo.picture_sigma_px);
  archive.Optional("center", photo.center);
  archive.Optional("rotation", photo.rotation);
}

template <typename Archive, internal::Is<CalibratedPart> T>
static void Fields(Archive& archive, T& part) {
  archive.Required("model", part.model);
  archive.Required("photos", part.photos);
  archive.Required("points", part.points);
  archive.Required("placed_by", part.placed_by);
  archive.Optional("position_sigma_m", part.position_sigma_m);
  archive.Optional("rotation_sigma_deg", part.rotation_sigma_deg);
  archive.Optional("shared_surface", part.shared_surface);
  archive.Optional("why", part.why);
}

template <typename Archive, internal::Is<CalibratedFlight> T>
static void Fields(Archive& archive, T& flight) {
  archive.Required("photos", flight.photos);
  archive.Required("shift_m", flight.shift_m);
  archive.Required("sigma_horizontal_m", flight.sigma_horizontal_m);
  archive.Required("sigma_vertical_m", flight.sigma_vertical_m);
  archive.Required("yaw_deg", flight.yaw_deg);
}

template <typename Archive, internal::Is<CalibratedRecords> T>
static void Fields(Archive& archive, T& records) {
  archive.Optional("flights", records.flights);
  archive.Optional("shift_m", records.shift_m);
  archive.Optional("attitude_sigma_deg", records.attitude_sigma_deg);
  archive.Optional("hover_sigma_m", records.hover_sigma_m);
  archive.Optional("mount_deg", records.mount_deg);
  archive.Optional("barometric_photos", records.barometric_photos);
  archive.Optional("satellite_heights_sigma_m", records.satellite_heights_sigma_m);
}

template <typename Archive, internal::Is<CalibratedPoint> T>
static void Fields(Archive& archive, T& point) {
  archive.Required("name", point.name);
  archive.Required("role", point.role);
  archive.Required("state", point.state);
  archive.Optional("why", point.why);
  archive.Optional("photos", point.photos);
  archive.Optional("error_m", point.error_m);
  archive.Optional("reprojection_error_px", point.reprojection_error_px);
  archive.Optional("ground_pixel_m", point.ground_pixel_m);
  archive.Optional("verdict", point.verdict);
}

template <typename Archive, internal::Is<CalibratedPointSet> T>
static void Fields(Archive& archive, T& set) {
  archive.Required("points", set.points);
  archive.Required("east_rms_m", set.east_rms_m);
  archive.Required("north_rms_m", set.north_rms_m);
  archive.Required("horizontal_rms_m", set.horizontal_rms_m);
  archive.Required("vertical_rms_m", set.vertical_rms_m);
  archive.Required("reprojection_error_px", set.reprojection_error_px);
  archive.Required("ground_pixel_m", set.ground_pixel_m);
  archive.Required("verdict", set.verdict);
}

template <typename Archive, internal::Is<UnposedPhoto> T>
static void Fields(Archive& archive, T& photo) {
  archive.Required("path", photo.path);
  archive.Required("why", photo.why);
}

template <typename Archive, internal::Is<CalibratedCamera> T>
static void Fields(Archive& archive, T& camera) {
  archive.Required("id", camera.id);
  archive.Optional("label", camera.label);
  archive.Required("model", camera.model);
  archive.Required("names", camera.names);
  archive.Required("params", camera.params);
  archive.Optional("sigma", camera.sigma);
  archive.Optional("held", camera.held);
}

template <typename Archive, internal::Is<CalibratedMap> T>
static void Fields(Archive& archive, T& map) {
  archive.Required("shift_m", map.shift_m);
  archive.Required("turn_deg", map.turn_deg);
  archive.Required("sigma_m", map.sigma_m);
  archive.Required("walls", map.walls);
  archive.Required("moved", map.moved);
}

template <typename Archive, internal::Is<Calibration> T>
static void Fields(Archive& archive, T& calibration) {
  archive.Required("photos_total", calibration.photos_total);
  archive.Required("photos_posed", calibration.photos_posed);
  archive.Required("reprojection_error_px", calibration.reprojection_error_px);
  archive.Required("points", calibration.points);
  archive.Required("mean_track_length", calibration.mean_track_length);
  archive.Group("prior_rms_m", [&](auto& group) {
    group.Required("horizontal", calibration.prior_rms_horizontal_m);
    group.Required("vertical", calibration.prior_rms_vertical_m);
  });
  archive.Required("photos", calibration.photos);
  archive.Required("unposed", calibration.unposed);
  archive.Optional("parts", calibration.parts);
  archive.Required("cameras", calibration.cameras);
  archive.Optional("records", calibration.records);
  archive.Optional("ground_control", calibration.ground_control);
  archive.Optional("control_rms", calibration.control_rms);
  archive.Optional("check_rms", calibration.check_rms);
  archive.Optional("map", calibration.map);
  archive.Optional("findings", calibration.findings);
}

Calibration ReadCalibration(const std::filesystem::path& path) {
  return internal::ReadJsonFile<Calibration>(path);
}

void WriteCalibration(const Calibration& calibration, const std::filesystem::path& path) {
  assert(FitsTogether(calibration));
  internal::WriteJsonFile(calibration, path);
}

}  // namespace stucco
