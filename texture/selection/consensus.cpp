// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/consensus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stucco {
namespace {

// Colour differences (0 to 255) that count half as disagreement.
constexpr float kHalfDisagreement = 30;
constexpr int kFewestVoices = 3;
// Less is not worth the search for a point off the plane.
constexpr float kWorthAsking = 0.1f;
constexpr double kMostHeights = 6;  // tried before the plane, and as many behind it
constexpr float kSameColour = 10;   // no better one is looked for
constexpr double kFewestCompared = 50;
constexpr float kOther = 0.5f;           // a disagreement that shows something else, not haze
constexpr double kComparedContrast = 5;  // standard deviation in grey levels

float MedianInPlace(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// Median colour of what sees texel i freely (of all that see it when fewer than three do);
// number of colours it is from.
int MedianColour(std::span<const RasterPicture> pictures, size_t i, float* rgb) {
  const auto count = [&](Sight least) {
    return std::count_if(pictures.begin(), pictures.end(),
                         [&](const RasterPicture& p) { return p.sight[i] >= least; });
  };
  const Sight least = count(Sight::kFree) >= 3 ? Sight::kFree : Sight::kBeyond;
  std::vector<float> values;
  for (int k = 0; k < 3; ++k) {
    values.clear();
    for (const RasterPicture& picture : pictures) {
      if (picture.sight[i] >= least) values.push_back(picture.rgb[3 * i + k]);
    }
    if (values.empty()) return 0;
    rgb[k] = MedianInPlace(values);
  }
  return static_cast<int>(values.size());
}

// Largest difference of a colour field to its right and lower neighbours.
float Contrast(const std::vector<float>& rgb, const TexelGrid& raster, int x, int y) {
  float contrast = 0;
  const size_t i = static_cast<size_t>(y) * raster.width + x;
  if (x + 1 < raster.width) contrast = ColourDifference(&rgb[3 * i], &rgb[3 * (i + 1)]);
  if (x > 0) contrast = std::max(contrast, ColourDifference(&rgb[3 * i], &rgb[3 * (i - 1)]));
  const size_t stride = raster.width;
  if (y + 1 < raster.height) {
    contrast = std::max(contrast, ColourDifference(&rgb[3 * i], &rgb[3 * (i + stride)]));
  }
  if (y > 0) contrast = std::max(contrast, ColourDifference(&rgb[3 * i], &rgb[3 * (i - stride)]));
  return contrast;
}

float DisagreementAt(float distance) {
  return distance > 0 ? 1 / (1 + std::pow(kHalfDisagreement / distance, 4.0f)) : 0;
}

// Where a photo shows a point `height` texels before what it shows at (x, y) of the plane itself,
// as seen from another one's place: texels to the right and down.
Eigen::Vector2d WayOnPlane(const Eigen::Vector3d& camera, const Eigen::Vector2d& place,
                           double height) {
  return height / camera.z() * (camera.head<2>() - place);
}

// How far the colour that one picture has in a texel is from those of the others where they show
// the same point, if it lies `height` texels before the plane: the median over the others that show
// it freely. Infinity with fewer than two.
float DistanceAtHeight(std::span<const RasterPicture> pictures, size_t asked,
                       const TexelGrid& raster, const Eigen::Vector2d& place, double height) {
  const RasterPicture& picture = pictures[asked];
  const float* rgb = &picture.rgb[3 * (static_cast<size_t>(place.y()) * raster.width +
                                       static_cast<size_t>(place.x()))];
  const Eigen::Vector2d foot = place + WayOnPlane(picture.camera, place, height);
  std::array<float, 64> distances;
  size_t count = 0;
  for (size_t q = 0; q < pictures.size() && count < distances.size(); ++q) {
    if (q == asked || !(pictures[q].camera.z() > height)) continue;
    const Eigen::Vector2d there = foot - WayOnPlane(pictures[q].camera, foot, height);
    const auto x = static_cast<int>(std::floor(there.x()));
    const auto y = static_cast<int>(std::floor(there.y()));
    if (x < 0 || y < 0 || x >= raster.width || y >= raster.height) continue;
    const size_t i = static_cast<size_t>(y) * raster.width + x;
    if (pictures[q].sight[i] != Sight::kFree) continue;
    distances[count++] = ColourDifference(&pictures[q].rgb[3 * i], rgb);
  }
  if (count + 1 < kFewestVoices) return std::numeric_limits<float>::infinity();
  const auto middle = distances.begin() + count / 2;
  std::nth_element(distances.begin(), middle, distances.begin() + count);
  return *middle;
}

// The least of these distances over points up to `relief` texels before or behind the plane.
float LeastDistance(std::span<const RasterPicture> pictures, size_t asked, const TexelGrid& raster,
                    const Eigen::Vector2d& place, double relief) {
  const double step = std::max(1.0, relief / kMostHeights);
  float least = std::numeric_limits<float>::infinity();
  for (double height = step; height <= relief && least > kSameColour; height += step) {
    for (const double at : {-height, height}) {
      least = std::min(least, DistanceAtHeight(pictures, asked, raster, place, at));
    }
  }
  return least;
}

}  // namespace

float Brightness(const float* rgb) {
  return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

float ColourDifference(const float* a, const float* b) {
  const float r = a[0] - b[0];
  const float g = a[1] - b[1];
  const float bl = a[2] - b[2];
  return std::sqrt((r * r + g * g + bl * bl) / 3);
}

Consensus FindConsensus(std::span<const RasterPicture> pictures, const TexelGrid& raster) {
  Consensus consensus;
  consensus.rgb.assign(3 * raster.size(), 0);
  consensus.count.assign(raster.size(), 0);
  for (size_t i = 0; i < raster.size(); ++i) {
    consensus.count[i] = MedianColour(pictures, i, &consensus.rgb[3 * i]);
  }
  return consensus;
}

std::vector<std::vector<float>> Disagreement(std::span<const RasterPicture> pictures,
                                             const Consensus& consensus, const TexelGrid& raster) {
  std::vector<std::vector<float>> out(pictures.size(), std::vector<float>(raster.size(), 0));
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const size_t i = static_cast<size_t>(y) * raster.width + x;
      if (consensus.count[i] < kFewestVoices) continue;
      const float forgiven = 0.5f * Contrast(consensus.rgb, raster, x, y);
      for (size_t p = 0; p < pictures.size(); ++p) {
        if (pictures[p].sight[i] == Sight::kNot) continue;
        const float distance = std::max(
            0.0f, ColourDifference(&pictures[p].rgb[3 * i], &consensus.rgb[3 * i]) - forgiven);
        out[p][i] = DisagreementAt(distance);
      }
    }
  }
  return out;
}

void ForgiveRelief(std::span<const RasterPicture> pictures, const Consensus& consensus,
                   const TexelGrid& raster, double relief,
                   std::vector<std::vector<float>>& disagreement) {
  for (size_t p = 0; p < pictures.size(); ++p) {
    if (!(pictures[p].camera.z() > relief)) continue;
    for (int y = 0; y < raster.height; ++y) {
      for (int x = 0; x < raster.width; ++x) {
        float& own = disagreement[p][static_cast<size_t>(y) * raster.width + x];
        if (own < kWorthAsking) continue;
        const float forgiven = 0.5f * Contrast(consensus.rgb, raster, x, y);
        const float distance = LeastDistance(pictures, p, raster, {x + 0.5, y + 0.5}, relief);
        own = std::min(own, DisagreementAt(distance - forgiven));
      }
    }
  }
}

float Haze(const RasterPicture& picture, const Consensus& consensus,
           const std::vector<float>& disagreement) {
  double n = 0;
  double sum_a = 0;
  double sum_b = 0;
  double sum_ab = 0;
  double sum_bb = 0;
  for (size_t i = 0; i < consensus.count.size(); ++i) {
    if (consensus.count[i] < kFewestVoices || picture.sight[i] != Sight::kFree) continue;
    if (disagreement[i] > kOther) continue;
    const double a = Brightness(&picture.rgb[3 * i]);
    const double b = Brightness(&consensus.rgb[3 * i]);
    n += 1;
    sum_a += a;
    sum_b += b;
    sum_ab += a * b;
    sum_bb += b * b;
  }
  const double variance = n * sum_bb - sum_b * sum_b;
  if (n < kFewestCompared || !(variance > kComparedContrast * kComparedContrast * n * n)) return 0;
  const double slope = (n * sum_ab - sum_a * sum_b) / variance;
  return static_cast<float>(std::clamp(1 - slope, 0.0, 1.0));
}

}  // namespace stucco
