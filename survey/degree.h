// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace stucco {

inline constexpr double kDegree = std::numbers::pi / 180;  // in radians

}  // namespace stucco
