// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "simulate/flight/exposure.h"
#include "survey/captures.h"

namespace stucco::simulate {

// What a drone writes into a photo.
struct PhotoMetadata {
  std::string model;      // "M3E"
  std::string exif_time;  // "2026:04:30 10:00:12"
  int milliseconds = 0;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  double above_takeoff_m = 0;
  GimbalAngles gimbal;
  bool rtk = false;
  Eigen::Vector3d rtk_sigma_m = Eigen::Vector3d::Zero();  // east, north, up
  Shutter shutter;
  double focal_mm = 0;
  int focal_35mm_mm = 0;
  int width_px = 0;
  int height_px = 0;
  std::string uuid;  // of the exposure
};

// The EXIF model of the cameras that the planner knows ("mavic-3e" is M3E); other names as they
// are.
std::string ExifModel(const std::string& camera);

// The JPEG with EXIF and DJI's XMP packet, as the drone writes them: signed numbers as attributes
// of one description, gimbal angles in tenths of a degree. The software is named Stucco: nobody
// shall take it for a real photo. Throws Error (kStageFailed).
std::string WithMetadata(std::string_view jpeg, const PhotoMetadata& metadata);

}  // namespace stucco::simulate
