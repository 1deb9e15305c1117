// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "survey/calibration.h"

namespace stucco {

// Sentences on what is wrong with the records of photos, for whoever flew: a compass or a gimbal
// that is off, positions or angles that scatter, single positions that lie elsewhere.
std::vector<std::string> RecordFindings(const CalibratedRecords& records,
                                        std::span<const CalibratedPhoto> photos);

// Sentences on how far positions and map are apart; none where that is within what both are good
// to.
std::vector<std::string> MapFindings(const CalibratedMap& map);

}  // namespace stucco
