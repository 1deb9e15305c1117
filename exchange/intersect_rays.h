// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "exchange/exchanged_model.h"

namespace stucco {

// The place nearest to the rays of a point's pixels, for files that leave its position out. Nothing
// where it would lie behind a photo or the rays are all but parallel.
std::optional<Eigen::Vector3d> IntersectRays(const ExchangedPoint& point,
                                             const Reconstruction& model);

}  // namespace stucco
