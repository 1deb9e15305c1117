// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>

namespace stucco {

struct Match {
  int32_t first = 0;                               // keypoint of the first photo
  int32_t second = 0;                              // keypoint of the second photo
  auto operator<=>(const Match&) const = default;  // NOLINT(modernize-use-nullptr)
};

}  // namespace stucco
