// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace stucco {

inline constexpr double kFlat_m = 0.12;  // what stereo makes of a flat surface lies within

// Mean of the numbers in the window of this width that holds most of them: where a surface lies
// that is flat but for what stands a hand before or behind it (windows, a parapet), which the mean
// or the median of all would be drawn to. Requires at least one number, ascending.
double MeanOfDensest(std::span<const double> ascending, double width);

}  // namespace stucco
