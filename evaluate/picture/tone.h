// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "simulate/render/renderer.h"
#include "survey/image.h"

namespace stucco::evaluate {

// Textures are made of photos, so their codes are what the camera's curve makes of light
// (simulate::CameraCurve), and the truth has to go through the same curve.
uint8_t CodeOfLight(double light);
float LightOfCode(uint8_t code);  // of the code's middle

// The picture whose light is `gains` times that of `radiance`, by channel. Requires 3 values per
// pixel.
Image Developed(std::span<const float> radiance_rgb, ImageSize size,
                const std::array<double, 3>& gains);

// Logarithms of `to` over `from` by channel; nothing where a channel is too dark or too bright to
// say anything.
std::optional<std::array<double, 3>> LogRatios(const float* from_rgb, const float* to_rgb);

// Pairs of light on the same spots: what the scene sends and what the result says of it.
struct LightPairs {
  std::array<std::vector<double>, 3> log_ratios;  // result over truth, by channel

  void Add(const float* truth_rgb, const float* result_rgb);
  void Append(const LightPairs& other);
};

// Gains that bring the truth's light to the result's: the median ratio of each channel; 1 where
// there is no pair.
std::array<double, 3> FitGains(LightPairs pairs);

}  // namespace stucco::evaluate
