// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "site/frustum.h"
#include "survey/plan.h"

namespace stucco::plan {

// A drone and its camera (presets.toml).
struct CameraPreset {
  PlannedCamera camera;
  int dji_drone = 0;  // droneEnumValue of DJI's WPML; 0: the drone has none
  int dji_drone_sub = 0;
  int dji_payload = 0;
  double battery_scale = 1;  // batteries of a Mavic 3E that one of this drone is worth

  double HorizontalFov() const;  // radians
  double PixelPitch() const { return camera.sensor_width_m / camera.width_px; }
  // Size of what the sensor sees on a plane at this distance.
  double WidthAt(double distance_m) const {
    return camera.sensor_width_m / camera.focal_m * distance_m;
  }
  double HeightAt(double distance_m) const {
    return camera.sensor_height_m / camera.focal_m * distance_m;
  }
  FieldOfView Field() const { return {WidthAt(0.5), HeightAt(0.5)}; }
  // The distance at which a pixel covers `gsd_m`.
  double DistanceForGsd(double gsd_m) const { return gsd_m * camera.focal_m / PixelPitch(); }
};

// By name: mavic-3e, phantom-4-rtk, m300-p1-35, mini-3-pro. Or a camera of its own as
// "WIDTHxHEIGHTmm,FOCALmm,PIXELSxPIXELS" ("17.3x13mm,12.29mm,5280x3956"). Throws Error (kUsage)
// that lists the names.
CameraPreset FindCamera(const std::string& name);
std::vector<std::string> CameraNames();

}  // namespace stucco::plan
