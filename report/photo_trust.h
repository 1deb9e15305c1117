// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/survey_data.h"
#include "survey/calibration.h"
#include "survey/texture_set.h"

namespace stucco {

// Whether a photo is in the model that the stages after calibration use.
bool IsInMainModel(const Calibration& calibration, const CalibratedPhoto& photo);
int CountInMainModel(const Calibration& calibration);

// One standard deviation of a pose.
struct PlacementSigma {
  double position = 0;  // metres, or units of the model
  double rotation_deg = 0;
  double picture_px = -1;  // -1: not known
};

struct Placement {
  std::map<PhotoState, int> states;  // of all four; tied and weak ones of the main model
  int apart = 0;                     // photos in models of their own
  // Of the photos of the main model by each of the three; nothing where it was not computed.
  std::optional<PlacementSigma> middle;
  std::optional<PlacementSigma> nine_in_ten;  // are placed at least so well
};

Placement SummarizePlacement(const Calibration& calibration);

// Photos that are weak, ambiguous or known by their record alone, the least sure first.
std::vector<const CalibratedPhoto*> PhotosNotToTrust(const Calibration& calibration);

bool IsWeak(const SurveyData& data, const std::string& path);

// How surely the photos that paint a facet are placed, in pixels of them; nothing where it is not
// known.
struct FacetPlacement {
  double middle_px = 0;
  double worst_px = 0;
};
std::optional<FacetPlacement> PlacementOf(const SurveyData& data, const TexturedFacet& texture);

}  // namespace stucco
