// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/render/internal/shade.h"
#include "simulate/render/internal/view.h"
#include "simulate/render/pictures.h"

namespace stucco::simulate::internal {

// Draws what a view sees: one ray through the centre of every pixel, then eight more through those
// whose neighbours show something else.
Radiance DrawPicture(const View& view, const Shader& shader, int threads);

// The way along the ray through every pixel's centre, 0 where there is nothing.
std::vector<float> MeasureWays(const View& view, const RayScene& scene,
                               const RenderOptions& options);

}  // namespace stucco::simulate::internal
