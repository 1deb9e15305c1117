// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "calib/features/match.h"

namespace stucco {

// Mutual nearest neighbours that pass Lowe's ratio test (on angles between the descriptors) in both
// directions. Requires rows as UnitDescriptors gives them (descriptors.h). Sorted by
// Match::first.
std::vector<Match> MatchDescriptors(const std::vector<int16_t>& first,
                                    const std::vector<int16_t>& second, double ratio);

}  // namespace stucco
