// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "simulate/paint/internal/noise.h"
#include "simulate/paint/internal/tile.h"

namespace stucco::simulate::internal {

// A crack runs where a rough function of the place changes its sign: a coarse one, which bends the
// crack, and a finer one, which frays it.
struct Cracks {
  float near = 0.6f;   // how near to 0 the coarse part must be for the fine one to matter
  float fine = 0.17f;  // height of the finer part
  Octaves waves;       // of the finer part
  float half_width_m = 0.004f;
  float texel_m = 0;
};

// The share of a texel that cracks cover. `coarse` is the coarse part there, `open` how wide cracks
// are: 0 closed, 1 as wide as they get.
inline float CrackShare(const Cracks& cracks, float x, float y, float coarse, float open) {
  constexpr float kSlope =
      2.2f;  // of the coarse part where it changes its sign, per metre, roughly
  if (open <= 0 || std::abs(coarse) >= cracks.near) return 0;
  const float level = coarse + cracks.fine * Noise(x, y, cracks.waves, cracks.texel_m);
  return Edge(cracks.half_width_m * open - std::abs(level) / kSlope, cracks.texel_m);
}

}  // namespace stucco::simulate::internal
