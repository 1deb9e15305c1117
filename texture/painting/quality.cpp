// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/quality.h"

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

struct Sums {
  double weight = 0;
  double frontal = 0;
  double close = 0;
  double footprint = 0;
  double footprint_squared = 0;
};

double WeightedMedian(std::vector<std::pair<float, double>>& values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  double total = 0;
  for (const auto& value : values) total += value.second;
  double reached = 0;
  for (const auto& value : values) {
    reached += value.second;
    if (reached >= total / 2) return value.first;
  }
  return values.back().first;
}

}  // namespace

AchievedQuality MeasureQuality(std::span<const RasterView> views,
                               std::span<const SurveyPhoto> photos, const FacetRaster& raster,
                               std::span<const int> owner, double texel) {
  const TexelGrid& grid = raster.grid;
  AchievedQuality out;
  Sums sums;
  double area = 0;
  double seen = 0;
  std::vector<Eigen::Vector3d> direction(views.size(), Eigen::Vector3d::Zero());
  std::vector<double> share(views.size(), 0);
  std::vector<std::pair<float, double>> footprints;
  for (size_t i = 0; i < raster.inside.size(); ++i) {
    const double weight = raster.inside[i];
    if (!(weight > 0)) continue;
    area += weight;
    for (const RasterView& view : views) {
      if (view.texels[i].sight != Sight::kNot) seen += weight;
    }
    if (owner[i] < 0) continue;
    const TexelView& texel_view = views[owner[i]].texels[i];
    const Eigen::Vector3d point =
        grid.Center(static_cast<int>(i % grid.width), static_cast<int>(i / grid.width));
    const Eigen::Vector3d camera = photos[views[owner[i]].photo].cam_from_world.Center();
    direction[owner[i]] += weight * (point - camera).normalized();
    share[owner[i]] += weight;
    const double g = texel_view.footprint;
    sums.weight += weight;
    sums.frontal += weight * std::max(0.0f, texel_view.cos_angle);
    sums.close += weight * std::min(1.0, texel / g);
    sums.footprint += weight * g;
    sums.footprint_squared += weight * g * g;
    footprints.emplace_back(texel_view.footprint, weight);
  }
  if (!(sums.weight > 0)) return out;
  Eigen::Vector3d together = Eigen::Vector3d::Zero();
  for (size_t j = 0; j < views.size(); ++j) {
    if (share[j] > 0) together += share[j] / sums.weight * direction[j].normalized();
  }
  const double mean = sums.footprint / sums.weight;
  const double variance = std::max(0.0, sums.footprint_squared / sums.weight - mean * mean);
  out.q_s = (sums.frontal / sums.weight + together.norm()) / 2;
  out.q_d = (sums.close / sums.weight + 1 - std::min(1.0, std::sqrt(variance) / mean)) / 2;
  out.q_u = std::min(1.0, sums.weight / seen);
  out.q_c = sums.weight / area;
  out.footprint = WeightedMedian(footprints);
  return out;
}

double MeasureSharpness(const Image& picture, const std::vector<uint8_t>& painted) {
  const auto grey = [&](int x, int y) {
    const uint8_t* p = picture.Pixel(x, y);
    return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
  };
  const auto is_painted = [&](int x, int y) {
    return painted[static_cast<size_t>(y) * picture.width_px + x] != 0;
  };
  double sum = 0;
  double sum_squared = 0;
  double count = 0;
  for (int y = 1; y + 1 < picture.height_px; ++y) {
    for (int x = 1; x + 1 < picture.width_px; ++x) {
      if (!is_painted(x, y) || !is_painted(x - 1, y) || !is_painted(x + 1, y) ||
          !is_painted(x, y - 1) || !is_painted(x, y + 1)) {
        continue;
      }
      const double laplacian =
          grey(x - 1, y) + grey(x + 1, y) + grey(x, y - 1) + grey(x, y + 1) - 4 * grey(x, y);
      sum += laplacian;
      sum_squared += laplacian * laplacian;
      ++count;
    }
  }
  if (!(count > 0)) return 0;
  return sum_squared / count - (sum / count) * (sum / count);
}

}  // namespace stucco
