// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/colmap_io.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <system_error>

#include "survey/error.h"
#include "survey/internal/colmap.h"

namespace stucco {
namespace internal {

void FailColmap(const std::string& where, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", where, reason),
              "write the COLMAP model again with the program it came from");
}

void FailCameraModel(const std::string& where, const std::string& model) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: camera model {} is not supported", where, model),
              "use SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV or FULL_OPENCV; other "
              "lenses can be undistorted first (colmap image_undistorter)");
}

void AddCamera(Camera camera, const std::string& where, Reconstruction& reconstruction) {
  if (const auto problem = FindProblem(camera)) {
    FailColmap(where, fmt::format("camera {}: {}", camera.id.value, *problem));
  }
  const CameraId id = camera.id;
  if (!id.IsValid() || !reconstruction.cameras.emplace(id, std::move(camera)).second) {
    FailColmap(where, fmt::format("camera id {} is invalid or there twice", id.value));
  }
}

void AddPhoto(RegisteredImage photo, const std::string& where, Reconstruction& reconstruction) {
  if (photo.name.empty()) FailColmap(where, fmt::format("image {} has no name", photo.id.value));
  const PhotoId id = photo.id;
  if (!id.IsValid() || !reconstruction.photos.emplace(id, std::move(photo)).second) {
    FailColmap(where, fmt::format("image id {} is invalid or there twice", id.value));
  }
}

void AddPoint(TrackPoint point, const std::string& where, Reconstruction& reconstruction) {
  const PointId id = point.id;
  if (!id.IsValid() || !reconstruction.points.emplace(id, std::move(point)).second) {
    FailColmap(where, fmt::format("point id {} is invalid or there twice", id.value));
  }
}

Eigen::Quaterniond UnitRotation(double w, double x, double y, double z, const std::string& where) {
  const Eigen::Quaterniond rotation(w, x, y, z);
  const double norm = rotation.norm();
  if (!std::isfinite(norm) || !(norm > 0)) FailColmap(where, "the rotation is not valid");
  // What we wrote ourselves reads back to the last bit.
  constexpr double kRounding = 1e-14;
  return std::abs(norm - 1) < kRounding ? rotation : Eigen::Quaterniond(rotation.coeffs() / norm);
}

}  // namespace internal

namespace {

// Nothing when all three files are there, else the first that is not.
std::optional<std::string> MissingFile(const std::filesystem::path& folder,
                                       const std::string& extension) {
  for (const char* stem : {"cameras", "images", "points3D"}) {
    const std::string name = stem + extension;
    std::error_code unreadable;  // as good as missing
    if (!std::filesystem::exists(folder / name, unreadable)) return name;
  }
  return std::nullopt;
}

}  // namespace

Reconstruction ReadColmapModel(const std::filesystem::path& folder) {
  const auto missing_binary = MissingFile(folder, ".bin");
  const auto missing_text = MissingFile(folder, ".txt");
  if (missing_binary && missing_text) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no COLMAP model: {} and {} are missing", folder.string(),
                            *missing_binary, *missing_text),
                "name the folder that holds cameras, images and points3D as .bin or .txt");
  }
  Reconstruction reconstruction =
      missing_binary ? internal::ReadColmapText(folder) : internal::ReadColmapBinary(folder);
  if (const auto problem = FindProblem(reconstruction)) {
    internal::FailColmap(folder.string(), *problem);
  }
  return reconstruction;
}

}  // namespace stucco
