// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/photos/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace stucco {
namespace {

constexpr int kLattice = 16;                // texels between exact projections
constexpr double kInterpolation_px = 0.05;  // allowed error of the interpolation between them
constexpr int kMaxTaps = 6;

// Pixels of the four corners of a lattice block, and whether they bound the block's mapping well.
struct Block {
  std::array<Eigen::Vector2d, 4> corner;  // (0,0), (1,0), (0,1), (1,1)
  bool smooth = false;

  Eigen::Vector2d At(double s, double t) const {
    return (1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
           t * ((1 - s) * corner[2] + s * corner[3]);
  }
};

class Projector {
 public:
  Projector(const SurveyPhoto& photo, const TexelGrid& grid, const GridShift& shift)
      : photo_(photo), grid_(grid), shift_(shift), shifted_(!shift.IsZero()) {}

  double HeightAt(double x, double y) const { return grid_.HeightAt(x, y); }

  std::optional<Eigen::Vector2d> At(double x, double y, double height) const {
    Eigen::Vector2d place(x, y);
    if (shifted_) place += shift_.At(place);
    return ProjectIntoPhoto(photo_, grid_.AtHeight(place.x(), place.y(), height));
  }

  Block MakeBlock(double x, double y, double width, double height) const {
    Block block;
    if (grid_.relief &&
        !grid_.relief->IsLevel(grid_.texel * Eigen::Vector2d(x, y),
                               grid_.texel * Eigen::Vector2d(x + width, y + height)))
      return block;
    const double raised = HeightAt(x, y);
    for (int i = 0; i < 4; ++i) {
      const int column = i % 2;
      const int row = i / 2;
      const auto pixel = At(x + column * width, y + row * height, raised);
      if (!pixel) return block;
      block.corner[i] = *pixel;
    }
    const auto middle = At(x + width / 2, y + height / 2, raised);
    block.smooth = middle && (*middle - block.At(0.5, 0.5)).norm() < kInterpolation_px;
    return block;
  }

 private:
  const SurveyPhoto& photo_;
  const TexelGrid& grid_;
  const GridShift& shift_;
  bool shifted_;
};

// Catmull-Rom weights of the four neighbours around fraction t.
std::array<float, 4> CubicWeights(float t) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  return {0.5f * (-t3 + 2 * t2 - t), 0.5f * (3 * t3 - 5 * t2 + 2), 0.5f * (-3 * t3 + 4 * t2 + t),
          0.5f * (t3 - t2)};
}

// Adds the bicubic value at a pixel (centres at 0.5) to `sum`.
void AddBicubic(const Image& image, double x, double y, float* sum) {
  const double fx = x - 0.5;
  const double fy = y - 0.5;
  const int x0 = static_cast<int>(std::floor(fx));
  const int y0 = static_cast<int>(std::floor(fy));
  const auto wx = CubicWeights(static_cast<float>(fx - x0));
  const auto wy = CubicWeights(static_cast<float>(fy - y0));
  std::array<int, 4> columns;
  for (int i = 0; i < 4; ++i) columns[i] = std::clamp(x0 - 1 + i, 0, image.width_px - 1) * 3;
  for (int j = 0; j < 4; ++j) {
    const int row = std::clamp(y0 - 1 + j, 0, image.height_px - 1);
    const uint8_t* line = image.Pixel(0, row);
    float r = 0;
    float g = 0;
    float b = 0;
    for (int i = 0; i < 4; ++i) {
      const uint8_t* pixel = line + columns[i];
      r += wx[i] * pixel[0];
      g += wx[i] * pixel[1];
      b += wx[i] * pixel[2];
    }
    sum[0] += wy[j] * r;
    sum[1] += wy[j] * g;
    sum[2] += wy[j] * b;
  }
}

// How a texel's footprint is averaged: one level of the pyramid and nx x ny taps in it.
struct Footprint {
  const Image* level = nullptr;
  double scale_x = 1;  // level pixels per photo pixel
  double scale_y = 1;
  int taps_x = 1;
  int taps_y = 1;
  Eigen::Vector2d step_x;  // photo pixels per texel along the grid's axes
  Eigen::Vector2d step_y;
};

Footprint MakeFootprint(const PhotoPyramid& pyramid, const Eigen::Vector2d& step_x,
                        const Eigen::Vector2d& step_y) {
  Footprint out;
  out.step_x = step_x;
  out.step_y = step_y;
  const Image& finest = pyramid.levels.front();
  const double loaded = static_cast<double>(finest.width_px) / pyramid.full_width_px;
  const double length_x = step_x.norm() * loaded;
  const double length_y = step_y.norm() * loaded;
  const double shorter = std::max(1.0, std::min(length_x, length_y));
  const int last = static_cast<int>(pyramid.levels.size()) - 1;
  const int level = std::min(last, static_cast<int>(std::log2(shorter)));
  out.level = &pyramid.levels[level];
  const double reduction = std::ldexp(1.0, level);
  out.scale_x = loaded / reduction;
  out.scale_y = static_cast<double>(finest.height_px) / pyramid.full_height_px / reduction;
  const auto taps = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / reduction - 0.2)), 1, kMaxTaps);
  };
  out.taps_x = taps(length_x);
  out.taps_y = taps(length_y);
  return out;
}

void SampleTexel(const Footprint& footprint, const Eigen::Vector2d& pixel, float* rgb) {
  float sum[3] = {0, 0, 0};
  for (int j = 0; j < footprint.taps_y; ++j) {
    const double t = (j + 0.5) / footprint.taps_y - 0.5;
    for (int i = 0; i < footprint.taps_x; ++i) {
      const double s = (i + 0.5) / footprint.taps_x - 0.5;
      const Eigen::Vector2d at = pixel + s * footprint.step_x + t * footprint.step_y;
      AddBicubic(*footprint.level, at.x() * footprint.scale_x, at.y() * footprint.scale_y, sum);
    }
  }
  const float share = 1.0f / static_cast<float>(footprint.taps_x * footprint.taps_y);
  for (int k = 0; k < 3; ++k) rgb[k] = std::clamp(sum[k] * share, 0.0f, 255.0f);
}

// Exact projection of every texel: where the block leaves the picture or bends.
void SampleExactly(const Projector& projector, const PhotoPyramid& pyramid, const Tile& tile,
                   const Tile& block, SampledTile& out) {
  for (int row = 0; row < block.height; ++row) {
    for (int column = 0; column < block.width; ++column) {
      const double x = tile.x + block.x + column + 0.5;
      const double y = tile.y + block.y + row + 0.5;
      const double height = projector.HeightAt(x, y);
      const auto pixel = projector.At(x, y, height);
      const auto right = projector.At(x + 0.5, y, height);
      const auto left = projector.At(x - 0.5, y, height);
      const auto below = projector.At(x, y + 0.5, height);
      const auto above = projector.At(x, y - 0.5, height);
      if (!pixel || !right || !left || !below || !above) continue;
      const size_t index = static_cast<size_t>(block.y + row) * tile.width + block.x + column;
      SampleTexel(MakeFootprint(pyramid, *right - *left, *below - *above), *pixel,
                  &out.rgb[3 * index]);
      out.valid[index] = 1;
    }
  }
}

void SampleSmoothly(const Block& mapping, const PhotoPyramid& pyramid, const Tile& tile,
                    const Tile& block, SampledTile& out) {
  const Eigen::Vector2d step_x =
      (mapping.At(1, 0.5) - mapping.At(0, 0.5)) / static_cast<double>(block.width);
  const Eigen::Vector2d step_y =
      (mapping.At(0.5, 1) - mapping.At(0.5, 0)) / static_cast<double>(block.height);
  const Footprint footprint = MakeFootprint(pyramid, step_x, step_y);
  for (int row = 0; row < block.height; ++row) {
    const double t = (row + 0.5) / block.height;
    for (int column = 0; column < block.width; ++column) {
      const size_t index = static_cast<size_t>(block.y + row) * tile.width + block.x + column;
      SampleTexel(footprint, mapping.At((column + 0.5) / block.width, t), &out.rgb[3 * index]);
      out.valid[index] = 1;
    }
  }
}

}  // namespace

Eigen::Vector2d GridShift::At(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d q = (x - center) / radius;
  const double bend = terms[6] * q.x() + terms[7] * q.y();
  return {terms[0] + terms[2] * q.x() + terms[3] * q.y() + q.x() * bend,
          terms[1] + terms[4] * q.x() + terms[5] * q.y() + q.y() * bend};
}

SampledTile SamplePhoto(const SurveyPhoto& photo, const PhotoPyramid& pyramid,
                        const TexelGrid& grid, const Tile& tile, const GridShift& shift) {
  SampledTile out;
  out.rgb.assign(3 * tile.size(), 0);
  out.valid.assign(tile.size(), 0);
  const Projector projector(photo, grid, shift);
  for (int y = 0; y < tile.height; y += kLattice) {
    for (int x = 0; x < tile.width; x += kLattice) {
      const Tile block{x, y, std::min(kLattice, tile.width - x),
                       std::min(kLattice, tile.height - y)};
      const Block mapping = projector.MakeBlock(tile.x + x, tile.y + y, block.width, block.height);
      if (mapping.smooth) {
        SampleSmoothly(mapping, pyramid, tile, block, out);
      } else {
        SampleExactly(projector, pyramid, tile, block, out);
      }
    }
  }
  return out;
}

}  // namespace stucco
