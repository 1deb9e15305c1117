// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/records/records.h"
#include "calib/results/summary_input.h"
#include "survey/calibration.h"
#include "survey/reconstruction.h"

namespace stucco {

// Every photo of the scene, which `reconstruction` is made of (ToReconstruction), then those of the
// models apart from it: how surely each is placed within its part, and why not to trust it.
std::vector<CalibratedPhoto> SummarizePhotos(const SummaryInput& input,
                                             const Reconstruction& reconstruction);

// The first part and the others.
std::vector<CalibratedPart> SummarizeParts(const SummaryInput& input);

// Photos without a pose whose record says where they were: ambiguous ones, and those of which
// nothing but the record is known. `errors` are those of the records, which are in the frame of the
// scene.
std::vector<CalibratedPhoto> SummarizeRecordOnly(const SummaryInput& input,
                                                 const std::vector<PoseRecord>& records,
                                                 const RecordErrors& errors);

}  // namespace stucco
