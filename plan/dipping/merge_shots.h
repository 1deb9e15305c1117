// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/dipping/setting.h"

namespace stucco::plan {

// The photos of a hover, one instead of two that look nearly the same way wherever it holds what
// both are meant for: walls in one line, or nearly so, take one photo and not one each. Photos of
// different kinds stay apart.
std::vector<Shot> MergeAlike(const DippingSetting& setting, const Hover& hover);

// The photo turned and tilted, by no more than kMostAim_rad each, so that what it is meant for lies
// in its middle and not at its rim: sky above a low wall and fields beside it match nothing. What
// it holds of its targets it holds as before.
inline constexpr double kMostAim_rad = 0.2094;  // 12 degrees
Shot Aimed(const DippingSetting& setting, const Hover& hover, const Shot& shot);

}  // namespace stucco::plan
