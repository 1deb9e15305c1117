// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/focal.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "capture_ingest/sensors.h"

namespace stucco {
namespace {

// Of the longer side: fields of view from 3 to 118 degrees.
bool IsPlausible(double focal_px, int width_px, int height_px) {
  const double ratio = focal_px / std::max(width_px, height_px);
  return ratio >= 0.3 && ratio <= 20;
}

Camera Undistorted(double focal_x_px, double focal_y_px, int width_px, int height_px) {
  Camera camera;
  camera.model = CameraModel::kOpenCv;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.params = {focal_x_px, focal_y_px, width_px / 2.0, height_px / 2.0, 0, 0, 0, 0};
  return camera;
}

// k1 and k2 whose polynomial k1 r^2 + k2 r^4 is nearest to one with a term k3 r^6, up to the radius
// of the picture's corner, weighted by area.
Eigen::Vector2d FoldThirdTerm(double k1, double k2, double k3, double corner_radius) {
  if (k3 == 0) return {k1, k2};
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  constexpr int kSamples = 64;
  for (int i = 1; i <= kSamples; ++i) {
    const double r = corner_radius * i / kSamples;
    // The displacement in the picture is r times the polynomial.
    const Eigen::Vector2d basis(r * r * r, std::pow(r, 5));
    const double wanted = k1 * basis[0] + k2 * basis[1] + k3 * std::pow(r, 7);
    normal += r * basis * basis.transpose();
    right += r * basis * wanted;
  }
  return normal.ldlt().solve(right);
}

std::optional<InitialCamera> FromDewarpData(const Tags& tags, int width_px, int height_px) {
  // DJI states its calibration for full size; a photo that was made smaller later keeps the tags.
  double scale = 1;
  if (const auto center = Number(tags, "Xmp.drone-dji.CalibratedOpticalCenterX")) {
    if (*center > 0) scale = width_px / (2 * *center);
  }
  auto camera =
      CameraFromDewarpData(Text(tags, "Xmp.drone-dji.DewarpData"), width_px, height_px, scale);
  if (camera) {
    const bool already_dewarped = Number(tags, "Xmp.drone-dji.DewarpFlag").value_or(0) == 1;
    if (already_dewarped) std::fill(camera->params.begin() + 4, camera->params.end(), 0.0);
    return InitialCamera{*camera, "dewarp"};
  }
  for (const char* key :
       {"Xmp.drone-dji.CalibratedFocalLength", "Xmp.drone-skydio.CalibratedFocalLength"}) {
    const double focal_px = Number(tags, key).value_or(0) * scale;
    if (IsPlausible(focal_px, width_px, height_px)) {
      return InitialCamera{Undistorted(focal_px, focal_px, width_px, height_px), "dewarp"};
    }
  }
  return std::nullopt;
}

double DigitalZoom(const Tags& tags) {
  return std::max(1.0, Number(tags, "Exif.Photo.DigitalZoomRatio").value_or(1));
}

// The equivalent is defined over the picture's diagonal (CIPA DCG-001); 35 mm film has one of
// 43.27 mm. Wide pictures are cuts of a 4:3 sensor, to which the equivalent belongs.
double FocalFrom35mm(const Tags& tags, int width_px, int height_px) {
  constexpr double kFilmDiagonal_mm = 43.2666;
  constexpr double kWide = 1.6;
  const double equivalent_mm = Number(tags, "Exif.Photo.FocalLengthIn35mmFilm").value_or(0);
  const double longer = std::max(width_px, height_px);
  const double shorter = std::min(width_px, height_px);
  const double diagonal_px = longer / shorter > kWide ? 1.25 * longer : std::hypot(longer, shorter);
  return equivalent_mm / kFilmDiagonal_mm * diagonal_px;
}

// Pixels per millimetre on the sensor; 0 when not known. ResolutionUnit 2 inch, 3 cm, 4 mm, 5 um.
double FocalPlanePixelsPerMm(const Tags& tags) {
  const double resolution = Number(tags, "Exif.Photo.FocalPlaneXResolution").value_or(0);
  const int unit =
      static_cast<int>(Number(tags, "Exif.Photo.FocalPlaneResolutionUnit").value_or(2));
  if (!(resolution > 0)) return 0;
  switch (unit) {
    case 3:
      return resolution / 10;
    case 4:
      return resolution;
    case 5:
      return resolution * 1000;
    default:
      return resolution / 25.4;
  }
}

double FocalFromSensor(const Tags& tags, int width_px) {
  const double focal_mm = Number(tags, "Exif.Photo.FocalLength").value_or(0);
  // The resolution is that of the size in PixelXDimension, which editors leave behind.
  const double original_width = Number(tags, "Exif.Photo.PixelXDimension").value_or(0);
  const double resized = original_width > 0 ? width_px / original_width : 1;
  return focal_mm * FocalPlanePixelsPerMm(tags) * resized * DigitalZoom(tags);
}

double FocalFromTable(const Tags& tags, int width_px, int height_px) {
  const double focal_mm = Number(tags, "Exif.Photo.FocalLength").value_or(0);
  std::string model = Text(tags, "Exif.Image.Model");
  if (model.empty()) model = Text(tags, "Exif.Photo.LensModel");  // phone apps that drop the model
  const auto width_mm = SensorWidth_mm(model);
  if (!width_mm) return 0;
  return focal_mm / *width_mm * std::max(width_px, height_px) * DigitalZoom(tags);
}

}  // namespace

std::optional<Camera> CameraFromDewarpData(std::string_view text, int width_px, int height_px,
                                           double scale) {
  assert(width_px > 0 && height_px > 0);
  const size_t semicolon = text.find(';');
  if (semicolon != std::string_view::npos) text.remove_prefix(semicolon + 1);
  const auto values = ParseNumbers(text);
  if (!values || values->size() < 8 || values->size() > 9) return std::nullopt;
  const auto& v = *values;
  if (!IsPlausible(v[0] * scale, width_px, height_px) ||
      !IsPlausible(v[1] * scale, width_px, height_px)) {
    return std::nullopt;
  }
  Camera camera = Undistorted(v[0] * scale, v[1] * scale, width_px, height_px);
  camera.params[2] += v[2] * scale;
  camera.params[3] += v[3] * scale;
  const double corner_radius =
      std::hypot(width_px / 2.0 / camera.params[0], height_px / 2.0 / camera.params[1]);
  const Eigen::Vector2d radial =
      FoldThirdTerm(v[4], v[5], v.size() == 9 ? v[8] : 0.0, corner_radius);
  camera.params[4] = radial[0];
  camera.params[5] = radial[1];
  camera.params[6] = v[6];
  camera.params[7] = v[7];
  if (!camera.Contains(camera.PrincipalPoint())) return std::nullopt;
  return camera;
}

InitialCamera InitialIntrinsics(const Tags& tags, int width_px, int height_px) {
  assert(width_px > 0 && height_px > 0);
  if (auto calibrated = FromDewarpData(tags, width_px, height_px)) return *calibrated;
  const std::pair<double, const char*> guesses[] = {
      {FocalFrom35mm(tags, width_px, height_px), "exif_35mm"},
      {FocalFromSensor(tags, width_px), "exif_sensor"},
      {FocalFromTable(tags, width_px, height_px), "sensor_table"}};
  for (const auto& [focal_px, source] : guesses) {
    if (!IsPlausible(focal_px, width_px, height_px)) continue;
    return {Undistorted(focal_px, focal_px, width_px, height_px), source};
  }
  const double focal_px = 1.2 * std::max(width_px, height_px);
  return {Undistorted(focal_px, focal_px, width_px, height_px), "default"};
}

}  // namespace stucco
