// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/survey_photo.h"

namespace stucco {

// Where file names do not say which view of the plan photos are (photos that were renamed, a model
// of another program): writes `captured.view` of those that stand and look as a view does. A shift
// of the whole frame against the plan (records without RTK, heights of another system) is found
// first, as the median over the photos: over those whose names say their view, where there are any.
// A view has at most one photo, the named one or the nearest; names stay as they are. Writes
// nothing where the frame is not "enu", and where fewer than half of the photos stand at views:
// then the plan is another flight's.
void NameViewsByPose(const Plan& plan, const Georef& georef, std::span<SurveyPhoto> photos);

}  // namespace stucco
