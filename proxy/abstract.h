// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "proxy/samples.h"
#include "proxy/stations.h"
#include "survey/georef.h"
#include "survey/options.h"
#include "survey/point_cloud.h"
#include "survey/proxy.h"
#include "survey/stage.h"

namespace stucco {

// Lengths are world units: metres when the survey is metric, else the free unit of calibration.
// 0 means "derive it from the data" (proxy/scale.h says how).
struct ProxyOptions {
  double level_of_detail = 0;
  double epsilon = 0;
  double normal_angle_deg = 35;
  double min_area = 0;
  int min_points = 0;
  double fill_gap = 0;
  double vertical_tolerance_deg = 8;
  double align_tolerance_deg = 6;
  int max_points = 2000000;
  bool solids = true;
  double solid_support = 0.65;
  int max_planes = 60;
  std::vector<double> up = {};
};

void Describe(OptionTable& table, ProxyOptions& options);

// What was found on the way: one line each for the log, the last ones are warnings.
struct ProxyFindings {
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
};

// The planar model of what the cloud shows: every building closed where its planes close and agree
// with the points, else its seen facets, open; the ground apart as "G0". Throws Error
// (kStageFailed) when the cloud shows no plane.
Proxy AbstractCloud(const PointStream& cloud, const Stations& stations, const Georef& georef,
                    const ProxyOptions& options, int threads, ProxyFindings& findings);
Proxy AbstractCloud(const PointCloud& cloud, const Stations& stations, const Georef& georef,
                    const ProxyOptions& options, int threads, ProxyFindings& findings);

// `max_points`, or what half of the memory holds, but never under 100000.
int PointsWithin(uint64_t memory_limit_bytes, int max_points);

// dense/cloud.ply, calib/sparse/0, calib/georef.json and, where there is one, plan/plan.json ->
// facets.json, proxy.obj, proxy.city.json.
void RunProxy(const ProxyOptions& options, StageContext& context);

}  // namespace stucco
