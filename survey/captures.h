// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "survey/camera.h"

namespace stucco {

// WGS 84. Heights are as the photo states them, above the ellipsoid or the sea.
struct GeoPosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  bool has_height = false;
  // One standard deviation; from RTK data where the photo has it, else a stated default.
  double sigma_horizontal_m = 5;
  double sigma_vertical_m = 10;
  bool rtk_fixed = false;
};

// Direction of the camera (never of the aircraft). Yaw clockwise from north, pitch 0 level and -90
// down.
struct GimbalAngles {
  double yaw_deg = 0;
  double pitch_deg = 0;
  double roll_deg = 0;
};

struct CapturedPhoto {
  std::string path;  // relative to the photo folder, '/' between folders
  std::string hash;  // of the file's content
  bool usable = false;
  std::string why;  // when not usable: the reason and what to do
  int width_px = 0;
  int height_px = 0;
  int camera = -1;           // index into Captures::cameras; -1 when not usable
  std::string capture_time;  // EXIF DateTimeOriginal, "2025:03:01 12:00:00"; may be empty
  // Of the light of the scene what the sensor counted: seconds at ISO 100 and f/1 that count the
  // same, by EXIF.
  std::optional<double> exposure_s;
  std::optional<GeoPosition> position;
  std::optional<double> height_above_takeoff_m;  // by the barometer
  std::optional<GimbalAngles> gimbal;
  std::string view;          // id of the planned view; empty: extra
  double sharpness = 0;      // variance of the Laplacian at 1 megapixel
  std::string duplicate_of;  // path of an identical file; such a photo is not usable
};

// Seconds since 1970 by the camera's clock, as if that were UTC; nothing where it does not say.
std::optional<double> CaptureTime_s(const CapturedPhoto& photo);

// Where a camera's first focal length comes from, best first.
//   "option", "dewarp" (calibrated pixels), "exif_35mm", "exif_sensor" (focal plane resolution),
//   "sensor_table", "default"
struct CapturedCamera {
  std::string key;    // make, model, lens, size, focal length: what makes photos share intrinsics
  std::string label;  // for people: "DJI FC6360, 1600 x 1300, 5.7 mm"
  Camera intrinsics;  // id is the index + 1; the starting point of self-calibration
  std::string focal_source;
  bool fixed = false;  // hold the intrinsics in calibration
};

// What became of a view of the plan: "captured", "elsewhere", "unusable" or "missing".
struct CapturedView {
  std::string id;
  std::string status = "missing";
  std::string photo;  // path; empty when missing
};

struct Captures {
  std::vector<CapturedCamera> cameras;
  std::vector<CapturedPhoto> photos;  // by path
  std::vector<CapturedView> views;    // of the plan, in its order; none without a plan
};

// ingest/captures.json; the names in it are fixed (docs/formats.md). Throws Error (kBadInput).
Captures ReadCaptures(const std::filesystem::path& path);
void WriteCaptures(const Captures& captures, const std::filesystem::path& path);

}  // namespace stucco
