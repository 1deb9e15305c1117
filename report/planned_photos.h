// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "report/survey_data.h"
#include "survey/plan.h"

namespace stucco {

// Views of the plan that cannot serve, by id, and why: "was not taken", "cannot be used: cut off
// after 3 %", "has no pose: ...".
using LostViews = std::map<std::string, std::string>;

// The views without a photo, with one that cannot be used, and, where calibration is done, with one
// that the model of the later stages does not have. Empty where photos were matched to no plan.
LostViews FindLostViews(const SurveyData& data);

// "1 of its 2 planned photos is lost: h0012v1 was not taken", of those meant for `facade`; empty
// where none of them is.
std::string LostViewsText(const PlannedFacade& facade, const LostViews& lost);

}  // namespace stucco
