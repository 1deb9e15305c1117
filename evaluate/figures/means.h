// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "evaluate/figures/evaluation.h"

namespace stucco::evaluate {

struct WeightedPicture {
  PictureFigures figures;
  double weight = 0;
};

// Weighted mean of each measure over the pictures that have it; not measured where none has.
PictureFigures MeanFigures(std::span<const WeightedPicture> pictures);

}  // namespace stucco::evaluate
