// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/flip.h"
#include "evaluate/picture/lpips.h"
#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

struct MeasuredPair {
  PictureFigures figures;
  FlipMap flip;
};

// Every measure of a pair of pictures; LPIPS where there is a network.
MeasuredPair MeasurePair(const PicturePair& pair, const Lpips* lpips = nullptr);

}  // namespace stucco::evaluate
