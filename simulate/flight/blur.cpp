// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/blur.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "survey/parallel.h"

namespace stucco::simulate {
namespace {

constexpr int kBandRows = 16;

// Calls fn(first row, end row) for bands of rows.
template <typename Fn>
void ForBands(int rows, int threads, const Fn& fn) {
  const int bands = (rows + kBandRows - 1) / kBandRows;
  ParallelFor(static_cast<size_t>(bands), threads, [&](size_t band) {
    const int first = static_cast<int>(band) * kBandRows;
    fn(first, std::min(rows, first + kBandRows));
  });
}

size_t IndexOf(const Radiance& picture, int x, int y) {
  return 3 * (static_cast<size_t>(y) * picture.width_px + x);
}

// A symmetric kernel, weights[0] in the middle.
std::vector<float> KernelOf(double sigma_px) {
  const double variance = sigma_px * sigma_px;
  constexpr double kSampled_px = 0.7;
  if (sigma_px < kSampled_px) {
    return {static_cast<float>(1 - variance), static_cast<float>(variance / 2)};
  }
  const int radius = static_cast<int>(std::ceil(3.5 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / variance));
    sum += (i == 0 ? 1 : 2) * weights.back();
  }
  std::vector<float> kernel;
  kernel.reserve(weights.size());
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

void ConvolveAlongRow(const Radiance& in, const std::vector<float>& kernel, int x, int y,
                      float* target) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const float* middle = &in.rgb[IndexOf(in, x, y)];
  for (int c = 0; c < 3; ++c) target[c] = kernel[0] * middle[c];
  for (int k = 1; k <= radius; ++k) {
    const float* left = &in.rgb[IndexOf(in, std::max(0, x - k), y)];
    const float* right = &in.rgb[IndexOf(in, std::min(in.width_px - 1, x + k), y)];
    for (int c = 0; c < 3; ++c) target[c] += kernel[k] * (left[c] + right[c]);
  }
}

// out(i) = sum of kernel[|k|] * in(i + k * stride), for the 3 * count numbers of a row; the
// picture's edge pixels are repeated beyond it.
void ConvolveRows(const Radiance& in, const std::vector<float>& kernel, int threads,
                  Radiance& out) {
  ForBands(in.height_px, threads, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < in.width_px; ++x) {
        ConvolveAlongRow(in, kernel, x, y, &out.rgb[IndexOf(out, x, y)]);
      }
    }
  });
}

void ConvolveColumns(const Radiance& in, const std::vector<float>& kernel, int threads,
                     Radiance& out) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const size_t row = 3 * static_cast<size_t>(in.width_px);
  ForBands(in.height_px, threads, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      float* target = &out.rgb[row * y];
      const float* middle = &in.rgb[row * y];
      for (size_t i = 0; i < row; ++i) target[i] = kernel[0] * middle[i];
      for (int k = 1; k <= radius; ++k) {
        const float* above = &in.rgb[row * std::max(0, y - k)];
        const float* below = &in.rgb[row * std::min(in.height_px - 1, y + k)];
        for (size_t i = 0; i < row; ++i) target[i] += kernel[k] * (above[i] + below[i]);
      }
    }
  });
}

const float* PixelAt(const Radiance& picture, int x, int y) {
  return &picture.rgb[IndexOf(picture, std::clamp(x, 0, picture.width_px - 1),
                              std::clamp(y, 0, picture.height_px - 1))];
}

// The mean along a short way, by the 3 x 3 weights that have its variances and covariance. (Samples
// between pixels would blur more than so short a way does.)
Eigen::Array3f ShortMean(const Radiance& in, int x, int y, const Eigen::Vector2d& way) {
  const auto xx = static_cast<float>(way.x() * way.x() / 12);
  const auto yy = static_cast<float>(way.y() * way.y() / 12);
  const auto xy = static_cast<float>(std::abs(way.x() * way.y()) / 12);
  const int slope = way.x() * way.y() < 0 ? -1 : 1;
  const auto at = [&](int dx, int dy) {
    return Eigen::Map<const Eigen::Array3f>(PixelAt(in, x + dx, y + dy));
  };
  const Eigen::Array3f mean =
      (1 - xx - yy + xy) * at(0, 0) + (xx - xy) / 2 * (at(-1, 0) + at(1, 0)) +
      (yy - xy) / 2 * (at(0, -1) + at(0, 1)) + xy / 2 * (at(-1, -slope) + at(1, slope));
  return mean.max(0.0f);
}

// Weights of the four pixels around a place `f` behind the second (Keys, "Cubic convolution
// interpolation", 1981). Unlike linear weights they add no variance of their own.
std::array<float, 4> CubicWeights(float f) {
  return {((-0.5f * f + 1) * f - 0.5f) * f, (1.5f * f - 2.5f) * f * f + 1,
          ((-1.5f * f + 2) * f + 0.5f) * f, (0.5f * f - 0.5f) * f * f};
}

Eigen::Array3f Interpolated(const Radiance& in, double x, double y) {
  const double left = std::floor(x);
  const double top = std::floor(y);
  const auto across = CubicWeights(static_cast<float>(x - left));
  const auto down = CubicWeights(static_cast<float>(y - top));
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const float* pixel =
          PixelAt(in, static_cast<int>(left) + i - 1, static_cast<int>(top) + j - 1);
      sum += across[i] * down[j] * Eigen::Map<const Eigen::Array3f>(pixel);
    }
  }
  return sum;
}

// The mean along a way of two pixels and more.
Eigen::Array3f LongMean(const Radiance& in, int x, int y, const Eigen::Vector2d& way) {
  const int samples = static_cast<int>(std::ceil(3 * way.norm())) + 1;
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d offset = way * ((i + 0.5) / samples - 0.5);
    sum += Interpolated(in, x + offset.x(), y + offset.y());
  }
  return (sum / static_cast<float>(samples)).max(0.0f);
}

// The pixels from the block's least corner up to, not with, its largest, as `way` smears them.
void BlurBlock(const Radiance& in, const Eigen::AlignedBox2i& block, const Eigen::Vector2d& way,
               Radiance& picture) {
  constexpr double kShort_px = 2;
  const bool is_short = way.norm() < kShort_px;
  for (int y = block.min().y(); y < block.max().y(); ++y) {
    for (int x = block.min().x(); x < block.max().x(); ++x) {
      const Eigen::Array3f mean = is_short ? ShortMean(in, x, y, way) : LongMean(in, x, y, way);
      Eigen::Map<Eigen::Array3f>(&picture.rgb[IndexOf(picture, x, y)]) = mean;
    }
  }
}

}  // namespace

void BlurByFocus(double sigma_px, int threads, Radiance& picture) {
  if (!(sigma_px > 0)) return;
  const std::vector<float> kernel = KernelOf(sigma_px);
  Radiance other{picture.width_px, picture.height_px, std::vector<float>(picture.rgb.size())};
  ConvolveRows(picture, kernel, threads, other);
  ConvolveColumns(other, kernel, threads, picture);
}

Eigen::Vector2d ImageMotion(const Camera& camera, const Eigen::Vector3d& turn_rad,
                            const Eigen::Vector2d& pixel) {
  const auto ray = camera.Unproject(pixel);
  if (!ray) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d direction(ray->x(), ray->y(), 1);
  // Half a turn before and half a turn after; to first order in the angles.
  const Eigen::Vector3d half = 0.5 * turn_rad.cross(direction);
  const auto before = camera.Project(direction + half);
  const auto after = camera.Project(direction - half);
  if (!before || !after) return Eigen::Vector2d::Zero();
  return *after - *before;
}

void BlurByTurning(const Camera& camera, const Eigen::Vector3d& turn_rad, int threads,
                   Radiance& picture) {
  if (!(turn_rad.squaredNorm() > 0)) return;
  const Radiance in = picture;
  ForBands(in.height_px, threads, [&](int first, int end) {
    for (int left = 0; left < in.width_px; left += kBandRows) {
      const Eigen::AlignedBox2i block(
          Eigen::Vector2i(left, first),
          Eigen::Vector2i(std::min(in.width_px, left + kBandRows), end));
      // The motion changes slowly: it is that of the block's middle.
      const Eigen::Vector2d middle = 0.5 * (block.min() + block.max()).cast<double>();
      BlurBlock(in, block, ImageMotion(camera, turn_rad, middle), picture);
    }
  });
}

}  // namespace stucco::simulate
