// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calib/results/summary_input.h"
#include "survey/calibration.h"
#include "survey/georef.h"
#include "survey/stage.h"

namespace stucco {

// Writes sparse/0, a folder beside it for every model apart from it, georef.json and
// calibration.json below `context.out`, and notes the main figures. Requires `summary.parts`.
void WriteResults(const SummaryInput& summary, const Georef& georef, Calibration calibration,
                  const StageContext& context);

}  // namespace stucco
