// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "capture_ingest/photo_record.h"

namespace stucco {

// Holds the position and height of each usable photo against those of the others and drops what
// cannot belong to the same survey: a single wrong value must not tilt or move the model, and must
// not switch GPS off for the rest. What was dropped is added to the record's doubts.
void QuarantineOutliers(std::vector<PhotoRecord>& records);

// When no photo of the survey has a height above sea, the heights above take-off serve instead.
// Returns whether that was so.
bool UseHeightAboveTakeoff(std::vector<PhotoRecord>& records);

}  // namespace stucco
