// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "site/surface_samples.h"
#include "survey/plan.h"

namespace stucco::plan {

struct PhotoGraph;

// A place of the site as the planned photos show it.
struct CoveredPlace {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  SurfaceKind kind = SurfaceKind::kGround;
  int photos = 0;
  double gsd_m = 0;  // in the photo that shows it largest; 0 where none shows it
};

// Walls, roofs and ground at points that lie about `spacing_m` apart.
struct PhotoCoverage {
  double spacing_m = 0;
  std::vector<CoveredPlace> places;
};

// A pixel's size on a surface is the square root of the area that it covers there: it grows with
// the distance and, unlike a distance over a focal length, with the slant.
PhotoCoverage CoverageOf(const PhotoGraph& photos, const PlannedCamera& camera);

// What to warn of where a good part of the walls is shown in larger pixels than asked for: what
// nothing dips to is as far away as the photos from above are. At most one line.
std::vector<std::string> CoverageWarnings(const PhotoCoverage& coverage, double asked_m);

}  // namespace stucco::plan
