// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "survey/image.h"

namespace stucco::evaluate {

// Waves of 6 to 40 pixels in all directions, moved right by `dx` and down by `dy` pixels: exactly,
// because the picture is a formula.
Image Waves(int width_px, int height_px, double dx = 0, double dy = 0);

Image Plain(int width_px, int height_px, uint8_t red, uint8_t green, uint8_t blue);

// Every code through a function, limited to 0 to 255.
Image Changed(const Image& image, const std::function<double(double)>& change);
Image Noisy(const Image& image, double sigma);
Image Smoothed(const Image& image, double sigma_px);

}  // namespace stucco::evaluate
