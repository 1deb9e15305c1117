// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/options.h"

namespace stucco::plan {

inline constexpr double kMostAltitude_m = 500;
inline constexpr double kMostWind_m_per_s = 12;  // what the data sheet of the Mavic 3E resists

struct PlanOptions {
  std::string method = "cocapture";
  std::string camera = "mavic-3e";
  double altitude_m = 0;      // H above the ground; 0: d_min above the tallest building
  double gsd_m = 0.02;        // the coarsest acceptable pixel; gives d_max
  double d_min_m = 10;        // distance to buildings on the map; holds the errors below
  double d_max_m = 0;         // 0: from gsd_m
  double min_altitude_m = 5;  // above the ground
  double forward_overlap = 0.8;
  double side_overlap = 0.8;
  double map_error_m = 2;         // of outlines, horizontally
  double height_error_m = 2;      // of the map's heights
  double position_error_m = 2;    // of the drone, in every direction
  double margin_m = 0;            // how far views go beyond the buildings; 0: as H
  double vertical_step = 0.8;     // k_d of the paper
  double reconstructability = 0;  // tau_r; 0: six times that of one good pair
  bool links = true;              // photos between those that would not match
  double battery_percent = 80;    // used up per flight at most
  double wind_m_per_s = 3;        // that flights are reckoned with
  std::string date;               // of the flight, 2026-06-21; empty: three days of the year
  std::string map_layer;          // empty: one named after buildings, else the first with polygons
  std::string height_field;       // empty: the usual names
  std::string id_field;           // empty: the usual names
  std::string map_crs;            // for maps that name none: "EPSG:25832"
};

void Describe(OptionTable& table, PlanOptions& options);

}  // namespace stucco::plan
