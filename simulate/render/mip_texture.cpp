// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/mip_texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "simulate/floor.h"
#include "survey/srgb.h"

namespace stucco::simulate::internal {
namespace {

// A footprint longer than this many widths is widened: at such angles nothing can be seen anyway.
constexpr float kMostProbes = 16;

struct ToneTables {
  std::array<float, 256> linear;
  std::array<uint16_t, 256> linear16;
  std::array<uint8_t, 65536> srgb;  // of 16-bit linear values
};

ToneTables MakeTables() {
  ToneTables tables;
  for (size_t i = 0; i < 256; ++i) {
    tables.linear[i] = LinearFromSrgb(static_cast<uint8_t>(i));
    tables.linear16[i] = static_cast<uint16_t>(std::lround(tables.linear[i] * 65535));
  }
  for (size_t i = 0; i < 65536; ++i) {
    tables.srgb[i] = SrgbCode(static_cast<double>(i) / 65535);
  }
  return tables;
}

const ToneTables kTables = MakeTables();

uint8_t Channel(uint32_t texel, int channel) {
  return static_cast<uint8_t>(texel >> (8 * channel));
}

uint32_t Pack(uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
  return r | (g << 8) | (b << 16) | (a << 24);
}

// How many columns (rows) of the picture texel `at` of a level covers.
int Covered(int size, int at, int level) {
  return static_cast<int>(
      std::min<int64_t>(int64_t{1} << level, size - (static_cast<int64_t>(at) << level)));
}

int Wrapped(int at, int size) {
  const int rest = at % size;
  return rest < 0 ? rest + size : rest;
}

// log2 to 0.01, exact at powers of two: a table-free cubic on the mantissa.
float Log2(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  const auto exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
  const float m = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
  return exponent + m * (1.4243f + m * (-0.5850f + m * 0.1607f));
}

// Half axes of the ellipse that a pixel's circle becomes are the singular values of [a b]; here the
// larger eigenvalue of [p q; q r] = [a b] [a b]^T.
float LongerSquared(float p, float q, float r) {
  return (p + r) / 2 + std::sqrt((p - r) * (p - r) / 4 + q * q);
}

}  // namespace

float LongerAxis(const Footprint& footprint, float width, float height) {
  const float ax = footprint.right.x() * width, ay = footprint.right.y() * height;
  const float bx = footprint.down.x() * width, by = footprint.down.y() * height;
  return std::sqrt(LongerSquared(ax * ax + bx * bx, ax * ay + bx * by, ay * ay + by * by));
}

MipTexture::MipTexture(const Image& image, bool repeats) : repeats_(repeats) {
  size_t texels = 0;
  int width = image.width_px;
  int height = image.height_px;
  while (true) {
    AppendLevel(width, height);
    texels = levels_.back().first +
             size_t{16} * levels_.back().tiles_across * ((levels_.back().height + 3) / 4);
    if (width == 1 && height == 1) break;
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
  texels_.resize(texels);
  FillBase(image);
  for (size_t level = 1; level < levels_.size(); ++level) FillFromFiner(level);
}

void MipTexture::AppendLevel(int width, int height) {
  size_t first = 0;
  if (!levels_.empty()) {
    const Level& finer = levels_.back();
    first = finer.first + size_t{16} * finer.tiles_across * ((finer.height + 3) / 4);
  }
  levels_.push_back({width, height, (width + 3) / 4, first});
}

uint32_t& MipTexture::Texel(const Level& level, int x, int y) {
  const size_t tile = static_cast<size_t>(y >> 2) * level.tiles_across + (x >> 2);
  return texels_[level.first + tile * 16 + (y & 3) * 4 + (x & 3)];
}

uint32_t MipTexture::Texel(const Level& level, int x, int y) const {
  const size_t tile = static_cast<size_t>(y >> 2) * level.tiles_across + (x >> 2);
  return texels_[level.first + tile * 16 + (y & 3) * 4 + (x & 3)];
}

void MipTexture::FillBase(const Image& image) {
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const uint8_t* p = image.Pixel(x, y);
      const bool grey = image.channels < 3;
      const uint32_t alpha = image.channels == 4 ? p[3] : 255u;
      Texel(levels_[0], x, y) = Pack(p[0], grey ? p[0] : p[1], grey ? p[0] : p[2], alpha);
    }
  }
}

// Of the 2 x 2 finer texels at (x, y), weighed by the parts of the base that they stand for.
uint32_t MipTexture::MeanOfFiner(const Level& finer, int finer_number, int x, int y) const {
  const ToneTables& tables = kTables;
  // Colours count by their alpha, so that what is cut out does not bleed into what is left.
  std::array<uint64_t, 3> by_alpha = {0, 0, 0};
  std::array<uint64_t, 3> plain = {0, 0, 0};
  uint64_t area = 0;
  uint64_t alphas = 0;
  for (int k = 0; k < 4; ++k) {
    const int fx = 2 * x + (k & 1);
    const int fy = 2 * y + (k >> 1);
    if (fx >= finer.width || fy >= finer.height) continue;
    const uint32_t texel = Texel(finer, fx, fy);
    const uint64_t weight = static_cast<uint64_t>(Covered(levels_[0].width, fx, finer_number)) *
                            static_cast<uint64_t>(Covered(levels_[0].height, fy, finer_number));
    const uint64_t alpha = Channel(texel, 3);
    area += weight;
    alphas += weight * alpha;
    for (int c = 0; c < 3; ++c) {
      const uint64_t linear = tables.linear16[Channel(texel, c)];
      by_alpha[c] += weight * alpha * linear;
      plain[c] += weight * linear;
    }
  }
  std::array<uint32_t, 3> out;
  for (int c = 0; c < 3; ++c) {
    const uint64_t linear =
        alphas > 0 ? (by_alpha[c] + alphas / 2) / alphas : (plain[c] + area / 2) / area;
    out[c] = tables.srgb[linear];
  }
  return Pack(out[0], out[1], out[2], static_cast<uint32_t>((alphas + area / 2) / area));
}

void MipTexture::FillFromFiner(size_t level) {
  const Level& finer = levels_[level - 1];
  const Level& coarser = levels_[level];
  for (int y = 0; y < coarser.height; ++y) {
    for (int x = 0; x < coarser.width; ++x) {
      Texel(coarser, x, y) = MeanOfFiner(finer, static_cast<int>(level) - 1, x, y);
    }
  }
}

// x, y in texels of the level, its first texel's centre at 0.5.
Eigen::Array4f MipTexture::Bilinear(const Level& level, float x, float y) const {
  int x0 = Floor(x - 0.5f);
  int y0 = Floor(y - 0.5f);
  const float tx = x - 0.5f - static_cast<float>(x0);
  const float ty = y - 0.5f - static_cast<float>(y0);
  int x1 = x0 + 1;
  int y1 = y0 + 1;
  if (x0 < 0 || x1 >= level.width) {
    x0 = repeats_ ? Wrapped(x0, level.width) : std::clamp(x0, 0, level.width - 1);
    x1 = repeats_ ? Wrapped(x1, level.width) : std::clamp(x1, 0, level.width - 1);
  }
  if (y0 < 0 || y1 >= level.height) {
    y0 = repeats_ ? Wrapped(y0, level.height) : std::clamp(y0, 0, level.height - 1);
    y1 = repeats_ ? Wrapped(y1, level.height) : std::clamp(y1, 0, level.height - 1);
  }
  const std::array<uint32_t, 4> texels = {Texel(level, x0, y0), Texel(level, x1, y0),
                                          Texel(level, x0, y1), Texel(level, x1, y1)};
  const std::array<float, 4> weights = {(1 - tx) * (1 - ty), tx * (1 - ty), (1 - tx) * ty, tx * ty};
  const std::array<float, 256>& linear = kTables.linear;
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int k = 0; k < 4; ++k) {
    const uint32_t t = texels[k];
    sum += weights[k] * Eigen::Array4f(linear[t & 255], linear[(t >> 8) & 255],
                                       linear[(t >> 16) & 255],
                                       static_cast<float>(t >> 24) * (1 / 255.0f));
  }
  return sum;
}

// x, y in texels of the picture.
Eigen::Array4f MipTexture::Trilinear(float x, float y, float lod) const {
  const auto last = static_cast<float>(levels_.size() - 1);
  const float at = std::clamp(lod, 0.0f, last);
  const auto finer = static_cast<size_t>(at);
  const float share = at - static_cast<float>(finer);
  const float scale = std::bit_cast<float>(static_cast<uint32_t>(127 - finer) << 23);  // 2^-finer
  Eigen::Array4f sharp = Bilinear(levels_[finer], x * scale, y * scale);
  if (share < 1 / 64.0f) return sharp;
  const Eigen::Array4f soft = Bilinear(levels_[finer + 1], x * scale / 2, y * scale / 2);
  return sharp + share * (soft - sharp);
}

Eigen::Array4f MipTexture::Sample(const Footprint& footprint) const {
  const auto width = static_cast<float>(levels_[0].width);
  const auto height = static_cast<float>(levels_[0].height);
  Eigen::Vector2f uv = footprint.centre;
  if (!uv.allFinite()) return Eigen::Array4f::Zero();
  if (repeats_) uv -= uv.array().floor().matrix();
  // Beyond the border everything is the border; far beyond it integers overflow.
  if (!repeats_) uv = uv.cwiseMax(-1.0f).cwiseMin(2.0f);
  const float x = uv.x() * width;
  const float y = uv.y() * height;
  const float ax = footprint.right.x() * width, ay = footprint.right.y() * height;
  const float bx = footprint.down.x() * width, by = footprint.down.y() * height;
  const float p = ax * ax + bx * bx;
  const float q = ax * ay + bx * by;
  const float r = ay * ay + by * by;
  const float longer_squared = LongerSquared(p, q, r);
  if (!std::isfinite(longer_squared)) return Trilinear(x, y, std::numeric_limits<float>::max());
  if (longer_squared <= 1) return Trilinear(x, y, 0);  // magnified
  const float longer = std::sqrt(longer_squared);
  const float shorter =
      std::max({std::abs(ax * by - ay * bx) / longer, longer / kMostProbes, 1.0f});
  const float lod = Log2(shorter);
  const int probes = static_cast<int>(std::ceil(longer / shorter - 0.1f));
  if (probes <= 1 || lod >= static_cast<float>(levels_.size() - 1)) return Trilinear(x, y, lod);
  Eigen::Vector2f axis =
      p > r ? Eigen::Vector2f(longer_squared - r, q) : Eigen::Vector2f(q, longer_squared - p);
  axis *= longer / std::max(axis.norm(), 1e-20f);
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int i = 0; i < probes; ++i) {
    const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(probes) - 0.5f;
    sum += Trilinear(x + along * axis.x(), y + along * axis.y(), lod);
  }
  return sum / static_cast<float>(probes);
}

Eigen::Array3f MipTexture::Mean() const {
  const uint32_t texel = Texel(levels_.back(), 0, 0);
  return {LinearFromSrgb(Channel(texel, 0)), LinearFromSrgb(Channel(texel, 1)),
          LinearFromSrgb(Channel(texel, 2))};
}

}  // namespace stucco::simulate::internal
