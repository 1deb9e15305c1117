// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "survey/image.h"

namespace stucco {

// Fills the texels of an R G B picture where `hole` is not zero with texture copied from where
// `source` is not zero, coarse to fine, so that all patches of 7 x 7 around the hole look like
// patches of the source (Wexler, Shechtman, Irani, "Space-Time Completion of Video", 2007; nearest
// patches by Barnes et al., "PatchMatch", 2009, with random numbers from `seed`). The picture must
// hold a smooth guess in its holes. Texels that are neither hole nor source are ignored. Works at
// no more than `max_side_px` and takes what is finer from the copied places. Does nothing where the
// source has too little to copy from.
void FillWithPatches(Image& picture, const std::vector<uint8_t>& hole,
                     const std::vector<uint8_t>& source, int max_side_px, uint32_t seed);

}  // namespace stucco
