// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace stucco {

// Columns or rows [begin, end) of a raster, and [low, high) around them up to what lies beside.
struct Stretch {
  int begin = 0;
  int end = 0;
  int low = 0;
  int high = 0;
};

// Of stretches apart from each other by gaps, strips of at least three values in which hardly
// anything speaks (a tenth of the mean), the one with the largest sum. `speaks`: at least 0. All of
// it where nothing speaks.
Stretch LargestStretch(std::span<const double> speaks);

}  // namespace stucco
