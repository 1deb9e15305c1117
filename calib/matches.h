// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace stucco {

struct Match {
  int32_t first = 0;   // keypoint of the first photo
  int32_t second = 0;  // keypoint of the second photo
  auto operator<=>(const Match&) const = default;
};

// Mutual nearest neighbours that pass Lowe's ratio test (on angles between the descriptors) in both
// directions. `first` and `second` come from UnitDescriptors (descriptors.h). Sorted by
// Match::first.
std::vector<Match> MatchDescriptors(const std::vector<int16_t>& first,
                                    const std::vector<int16_t>& second, double ratio);

}  // namespace stucco
