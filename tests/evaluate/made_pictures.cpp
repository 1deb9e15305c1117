// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/evaluate/made_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

namespace stucco::evaluate {
namespace {

uint8_t Code(double value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

double Uniform(std::mt19937& random) {
  return random() / 4294967296.0;
}

}  // namespace

Image Waves(int width_px, int height_px, double dx, double dy) {
  struct Wave {
    double fx, fy, phase, strength[3];
  };
  std::mt19937 random(5);
  std::vector<Wave> waves(30);
  for (Wave& wave : waves) {
    const double angle = 2 * std::numbers::pi * Uniform(random);
    const double frequency = 2 * std::numbers::pi / (6 + 34 * Uniform(random));
    wave = {frequency * std::cos(angle), frequency * std::sin(angle), 7 * Uniform(random), {}};
    for (double& strength : wave.strength) strength = 7 + 7 * Uniform(random);
  }
  Image image{width_px, height_px, 3, {}};
  image.data.reserve(size_t{3} * width_px * height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      double code[3] = {130, 125, 120};
      for (const Wave& wave : waves) {
        const double value = std::sin(wave.fx * (x - dx) + wave.fy * (y - dy) + wave.phase);
        for (int c = 0; c < 3; ++c) code[c] += wave.strength[c] * value;
      }
      for (const double value : code) image.data.push_back(Code(value));
    }
  }
  return image;
}

Image Plain(int width_px, int height_px, uint8_t red, uint8_t green, uint8_t blue) {
  Image image{width_px, height_px, 3, {}};
  for (int i = 0; i < width_px * height_px; ++i) {
    image.data.insert(image.data.end(), {red, green, blue});
  }
  return image;
}

Image Changed(const Image& image, const std::function<double(double)>& change) {
  Image changed = image;
  for (uint8_t& code : changed.data) code = Code(change(code));
  return changed;
}

Image Noisy(const Image& image, double sigma) {
  std::mt19937 random(9);
  return Changed(image, [&](double code) {
    double sum = -6;  // of twelve uniform numbers: nearly normal
    for (int i = 0; i < 12; ++i) sum += Uniform(random);
    return code + sigma * sum;
  });
}

Image Smoothed(const Image& image, double sigma_px) {
  Image smooth = image;
  cv::Mat pixels(image.height_px, image.width_px, CV_8UC3, smooth.data.data());
  cv::GaussianBlur(pixels.clone(), pixels, {0, 0}, sigma_px);
  return smooth;
}

}  // namespace stucco::evaluate
