// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "proxy/planes/plane.h"
#include "survey/survey_photo.h"

namespace stucco {

struct UpEstimate {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::string source;               // for the log: "calibration", "photos and walls" ...
  double explained = 0;             // share of the planes' area that is a wall, floor or flat roof
  double from_first_guess_deg = 0;  // how far the walls moved it
};

// Up from how the cameras were held: photos are taken without roll, so their x axes lie level
// (Szeliski, "Image alignment and stitching", 2006, section 4), the tops of their pictures point up
// rather than down, and cameras do not look into the sky on average. Nothing without photos.
std::vector<Eigen::Vector3d> UpFromPhotos(std::span<const SurveyPhoto> photos);

// The best of the cameras' up and the directions of large planes by the area it explains, refined
// so that walls become vertical: the least squares of the wall normals' components along it, with
// weights that let go of planes that are none. Requires planes with measured areas; with none of
// them and no photos the result is z.
UpEstimate EstimateUp(const std::vector<Plane>& planes, std::span<const SurveyPhoto> photos);

// A direction that is known to some degrees.
struct UpGuess {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double tolerance_deg = 5;                        // walls (and flat planes) within it count
  std::optional<double> sigma_deg = std::nullopt;  // one standard deviation, where it was measured
};

// Refines it by walls and flat planes. One wall is taken to lean by half a degree as measured:
// panes stand behind it, eaves and balconies before it.
Eigen::Vector3d RefineUp(const std::vector<Plane>& planes, const UpGuess& guess);

}  // namespace stucco
