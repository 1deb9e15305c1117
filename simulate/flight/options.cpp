// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/options.h"

namespace stucco::simulate {

void Describe(OptionTable& table, FlightOptions& options) {
  table.Add("seed", options.seed, 0, 1000000000, "Seed of everything that chance decides.");
  table.Add("scale", options.scale, 0.01, 1.0,
            "Of the planned camera's pixels: 0.25 gives photos a quarter as wide.");
  table.Add("position_sigma_m", options.position_sigma_m, 0.0, 10.0,
            "How far from the plan the drone really stands, in metres.");
  table.Add("gimbal_sigma_deg", options.gimbal_sigma_deg, 0.0, 20.0,
            "How far from the plan the camera really looks, in degrees.");
  table.Add("rtk", options.rtk,
            "Positions are recorded by an RTK receiver: no bias, 1.1 cm, 2 cm in height.");
  table.Add("gps_bias_m", options.gps_bias_m, 0.0, 50.0,
            "Length of the recorded positions' common shift, in metres.");
  table.Add("gps_sigma_m", options.gps_sigma_m, 0.0, 50.0,
            "Noise of each recorded position, in metres.");
  table.Add("geoid_m", options.geoid_m, -110.0, 90.0,
            "Height of the sea level above the ellipsoid at the place, in metres: what heights "
            "recorded without RTK are lower by.");
  table.Add("gimbal_noise_deg", options.gimbal_noise_deg, 0.0, 20.0,
            "Noise of the recorded gimbal angles, in degrees.");
  table.Add("distortion", options.distortion, 0.0, 2.0, "Times the distortion of a real lens.");
  table.Add("vignetting", options.vignetting, 0.0, 0.9, "Share of the light lost in the corners.");
  table.Add("exposure_drift", options.exposure_drift, 0.0, 1.0,
            "Share by which the exposure wanders over the flight.");
  table.Add("white_balance_drift", options.white_balance_drift, 0.0, 0.5,
            "Share by which red and blue wander over the flight.");
  table.Add("exposure_ev", options.exposure_ev, -3.0, 3.0,
            "How much brighter photos are than metered, in stops.");
  table.Add("warmth", options.warmth, -0.5, 0.5,
            "Share by which the white balance takes red up and blue down.");
  table.Add("noise", options.noise, 0.0, 0.2, "Noise of the sensor at white, share of white.");
  table.Add("motion_blur_px", options.motion_blur_px, 0.0, 20.0,
            "Typical movement of the picture while the shutter is open, in pixels.");
  table.Add("focus_blur_px", options.focus_blur_px, 0.0, 20.0,
            "Radius of the lens's blur, in pixels.");
  table.Add("sharpening", options.sharpening, 0.0, 3.0,
            "Sharpening in the camera; 1 is about what DJI drones do to their JPEGs, 0 none.");
  table.Add("facades", options.facades, {},
            "Only views that are planned for these facades or look at them, such as "
            "B0001/F00,B0002/F03; empty: all views.");
  table.Add("most_photos", options.most_photos, 0, 100000,
            "At most so many of the planned photos, spread over the facades; 0: all.");
  table.Add("lost_share", options.lost_share, 0.0, 0.9,
            "Share of the planned photos that is lost.");
  table.Add("duplicate_share", options.duplicate_share, 0.0, 0.9,
            "Share of the photos that is taken twice.");
  table.Add("haze_m", options.haze_m, 0.0, 1e6,
            "Distance in metres at which haze takes two thirds of the contrast; 0: clear air.");
  table.Add("start_hour", options.start_hour, 0.0, 24.0, "Local solar time of the first photo.");
  table.Add("day_of_year", options.day_of_year, 1, 366, "Day of the flight; 1 is January 1.");
  table.Add("sun", options.sun, "The sun shines; otherwise the sky is overcast.");
  table.Add("held_out", options.held_out, 0, 1000,
            "Photos beside the plan that only the truth folder has, to check renderings against.");
  table.Add("write_depth", options.write_depth, "Write exact depth maps into the truth folder.");
  table
      .Add("ground_control", options.ground_control, 0, 1000,
           "Surveyed points, every fourth of them a check point, and where photos show them: "
           "truth/gcp_list.txt.")
      .affects_result = false;  // on the photos
  table.Add("jpeg_quality", options.jpeg_quality, 10, 100, "Quality of the JPEG files.");
}

}  // namespace stucco::simulate
