// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace stucco {

// 1 where a pixel's centre (column + 0.5, row + 0.5) is inside an odd number of the rings, by row.
// Requires sizes of at least 0.
std::vector<uint8_t> RasterizeRings(std::span<const std::vector<Eigen::Vector2d>> rings,
                                    int width_px, int height_px);

}  // namespace stucco
