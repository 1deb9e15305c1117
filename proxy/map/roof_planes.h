// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/map/outline_fit.h"
#include "proxy/map/upright_survey.h"
#include "proxy/map/wall_tops.h"
#include "proxy/options/proxy_options.h"
#include "proxy/planes/plane.h"

namespace stucco {

// An upright plane inside of an outline, and from where to where it was seen: `from` and `to` along
// its normal turned to the left, seen from above.
struct RoofStep {
  Plane plane;
  double from = 0;
  double to = 0;

  // Metres before it; negative: behind.
  double Before(const Eigen::Vector2d& p) const {
    return plane.normal.head<2>().dot(p) - plane.offset;
  }
  bool Faces(const Eigen::Vector2d& p) const {
    const double along = plane.normal.x() * p.y() - plane.normal.y() * p.x();
    return along >= from && along <= to;
  }
};

// The steps that are not panes, loggias or balconies of a larger one: parallel to it, within
// three metres of it and along it.
std::vector<const RoofStep*> MainWalls(const std::vector<RoofStep>& steps);

// Samples of a roof in a square of this side, by half of what the cloud's spacing promises: with
// fewer, what grazing views leave there is as likely wrong as right.
double EnoughSamples(double side, double spacing);

// A photo's look at a point of an upright plane.
struct SightLine {
  Eigen::Vector3d wall;
  Eigen::Vector3d eye;
};

// What the cloud shows above a footprint, in the upright frame.
struct RoofEvidence {
  Samples samples;            // above the ground and not far below the tops of its walls
  std::vector<Plane> planes;  // roofs, by falling area; `points` are indices into `samples`
  std::vector<RoofStep> steps;
  std::vector<SightLine> sights;      // to main walls two metres or more inside of the outline
  std::vector<Eigen::Vector2d> open;  // inside of the outline, where the ground shows
  double seen_m2 = 0;  // of the footprint but for its rim, where the cloud has anything
  double bare_m2 = 0;  // of it, where the cloud shows the ground itself
};

// The planes of a building's roof, found among the samples above its own footprint, with details
// that do not depend on the rest of the survey, and regularised by themselves and its walls. Rough
// surfaces (crowns of trees) are none, nor is what lies inside of it, below the tops of its walls.
RoofEvidence FindRoofPlanes(const UprightSurvey& survey, const FittedBuilding& building,
                            const WallTops& walls, const ProxyOptions& options);

// The samples by their indices; the cameras stay behind.
Samples SubsetOf(const Samples& samples, const std::vector<int>& indices);

}  // namespace stucco
