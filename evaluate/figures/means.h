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

struct WeightedLikeness {
  Likeness figures;
  double weight = 0;
};

Likeness MeanLikeness(std::span<const WeightedLikeness> all);

struct WeightedPart {
  LikenessOfPart figures;
  double weight = 0;  // of the whole, of which the part is a share
};

// The share is the mean of all shares; each part weighs as much as its share of the whole.
LikenessOfPart MeanPart(std::span<const WeightedPart> all);

}  // namespace stucco::evaluate
