// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/captures.h"

#include <fmt/format.h>

#include <cassert>
#include <ctime>
#include <iomanip>
#include <sstream>

#include "survey/error.h"
#include "survey/internal/json.h"

namespace stucco {

template <typename Archive, internal::Is<GeoPosition> T>
static void Fields(Archive& archive, T& position) {
  archive.Required("latitude_deg", position.latitude_deg);
  archive.Required("longitude_deg", position.longitude_deg);
  archive.Optional("height_m", position.height_m);
  archive.Optional("has_height", position.has_height);
  archive.Optional("sigma_horizontal_m", position.sigma_horizontal_m);
  archive.Optional("sigma_vertical_m", position.sigma_vertical_m);
  archive.Optional("rtk_fixed", position.rtk_fixed);
}

template <typename Archive, internal::Is<GimbalAngles> T>
static void Fields(Archive& archive, T& angles) {
  archive.Required("yaw_deg", angles.yaw_deg);
  archive.Required("pitch_deg", angles.pitch_deg);
  archive.Optional("roll_deg", angles.roll_deg);
}

template <typename Archive, internal::Is<Camera> T>
static void Fields(Archive& archive, T& camera) {
  archive.Required("id", camera.id.value);
  std::string model(Name(camera.model));
  archive.Required("model", model);
  if constexpr (Archive::kReads) {
    const auto known = CameraModelFromName(model);
    if (!known) archive.Fail("model", fmt::format("is \"{}\", which is no known model", model));
    camera.model = *known;
  }
  archive.Required("width_px", camera.width_px);
  archive.Required("height_px", camera.height_px);
  archive.Required("params", camera.params);
  if constexpr (Archive::kReads) {
    if (const auto problem = FindProblem(camera)) archive.Fail("params", "is wrong: " + *problem);
  }
}

template <typename Archive, internal::Is<CapturedCamera> T>
static void Fields(Archive& archive, T& camera) {
  archive.Required("key", camera.key);
  archive.Optional("label", camera.label);
  archive.Required("intrinsics", camera.intrinsics);
  archive.Optional("focal_source", camera.focal_source);
  archive.Optional("fixed", camera.fixed);
}

template <typename Archive, internal::Is<CapturedPhoto> T>
static void Fields(Archive& archive, T& photo) {
  archive.Required("path", photo.path);
  archive.Optional("hash", photo.hash);
  archive.Required("usable", photo.usable);
  archive.Optional("why", photo.why);
  archive.Optional("width_px", photo.width_px);
  archive.Optional("height_px", photo.height_px);
  archive.Optional("camera", photo.camera);
  archive.Optional("capture_time", photo.capture_time);
  archive.Optional("exposure_s", photo.exposure_s);
  archive.Optional("position", photo.position);
  archive.Optional("height_above_takeoff_m", photo.height_above_takeoff_m);
  archive.Optional("gimbal", photo.gimbal);
  archive.Optional("view", photo.view);
  archive.Optional("sharpness", photo.sharpness);
  archive.Optional("duplicate_of", photo.duplicate_of);
}

template <typename Archive, internal::Is<CapturedView> T>
static void Fields(Archive& archive, T& view) {
  archive.Required("id", view.id);
  archive.Optional("status", view.status);
  archive.Optional("photo", view.photo);
}

template <typename Archive, internal::Is<Captures> T>
static void Fields(Archive& archive, T& captures) {
  archive.Required("cameras", captures.cameras);
  archive.Required("photos", captures.photos);
  archive.Optional("views", captures.views);
}

// The first photo that has no camera and needs one, or whose camera is missing; null: none.
static const CapturedPhoto* FindCameraless(const Captures& captures) {
  for (const CapturedPhoto& photo : captures.photos) {
    const bool has_camera =
        photo.camera >= 0 && static_cast<size_t>(photo.camera) < captures.cameras.size();
    if (!has_camera && (photo.camera != -1 || photo.usable)) return &photo;
  }
  return nullptr;
}

std::optional<double> CaptureTime_s(const CapturedPhoto& photo) {
  std::tm time = {};
  std::istringstream text(photo.capture_time);
  text >> std::get_time(&time, "%Y:%m:%d %H:%M:%S");
  if (text.fail()) return std::nullopt;
  return static_cast<double>(timegm(&time));
}

Captures ReadCaptures(const std::filesystem::path& path) {
  Captures captures = internal::ReadJsonFile<Captures>(path);
  if (const CapturedPhoto* photo = FindCameraless(captures)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: photo {} has camera {}, but there are {} cameras", path.string(),
                            photo->path, photo->camera, captures.cameras.size()));
  }
  return captures;
}

void WriteCaptures(const Captures& captures, const std::filesystem::path& path) {
  assert(FindCameraless(captures) == nullptr);
  internal::WriteJsonFile(captures, path);
}

}  // namespace stucco
