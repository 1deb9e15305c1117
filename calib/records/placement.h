// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/pose.h"
#include "survey/reconstruction.h"

namespace stucco {

// Where a model that another program adjusted lies, as far as the records of its photos tell.
struct ModelPlace {
  Georef georef;                      // of the frame that `world_from_model` leads to
  Similarity world_from_model;        // the identity where nothing is known
  std::vector<std::string> outliers;  // photos whose recorded position contradicts the others
  std::string why_not;                // why the frame is not "enu"; empty where it is
};

// The way of our own calibrations: a robust similarity from camera centres to recorded positions;
// for cameras on one line "up" from the gimbal; without positions that fit only "up", where the
// gimbal tells it. Photos go by their paths.
ModelPlace PlaceByRecords(const Captures& captures, const Reconstruction& model);

struct PositionDifferences {
  std::map<std::string, double> distance_m;  // by path of the photos that have both
  double rms_horizontal_m = -1;              // outliers left out; -1 without positions
  double rms_vertical_m = -1;
  double median_horizontal_m = -1;
};

// From recorded positions to the camera centres of a model. Requires that its frame, `georef`, is
// "enu".
PositionDifferences CompareWithPositions(const Captures& captures, const Georef& georef,
                                         const Reconstruction& model,
                                         const std::vector<std::string>& outliers);

}  // namespace stucco
