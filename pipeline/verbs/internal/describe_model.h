// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/verbs/internal/place_model.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/reconstruction.h"

namespace stucco {

// What calibration.json says of a model that was imported: all that can be measured of it.
// `captures` may be null.
Calibration DescribeModel(const Reconstruction& model, const PlacedModel& place,
                          const Captures* captures);

}  // namespace stucco
