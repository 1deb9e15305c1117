// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "survey/image.h"

namespace stucco::evaluate {

// Two pictures of the same thing at the same resolution, pixel on pixel: sRGB, three channels.
struct PicturePair {
  Image truth;
  Image result;
  std::vector<uint8_t> mask;  // by pixel: not 0 where both have content; empty: everywhere
};

// Throws Error (kStageFailed) where sizes differ or a picture has no pixels or not three channels.
void CheckPair(const PicturePair& pair);

}  // namespace stucco::evaluate
