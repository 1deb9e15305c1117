// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "survey/image.h"

namespace stucco {

// Gives every texel without a value (`known` zero) the weighted mean of known ones around it,
// nearer ones more, by averaging over a pyramid (push-pull: Gortler et al., "The Lumigraph", 1996).
// Three values per texel. Leaves everything at zero when nothing is known.
void FillSmoothly(std::vector<float>& rgb, const std::vector<uint8_t>& known, int width,
                  int height);

// The same on a picture of three channels, with less memory; what is known stays as it is.
void FillPictureSmoothly(Image& picture, const std::vector<uint8_t>& known);

}  // namespace stucco
