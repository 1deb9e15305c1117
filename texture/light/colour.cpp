// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/colour.h"

#include <algorithm>
#include <cmath>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr float kDarkest = 12;     // below, noise and black clipping change ratios
constexpr float kBrightest = 245;  // above, clipped
constexpr size_t kFewestTexels = 24;
constexpr size_t kMostGroups = 4;
constexpr double kLargestGain = 4;
constexpr size_t kFewestFacets = 3;  // of which one may have another colour
// Hues of facets that lie farther apart than this, in the middle, have no white balance in common:
// logarithms of encoded colours, about what eyes see beside each other.
constexpr double kAgreeingHues = 0.05;

// The median ratio over some texels.
ColourRatio RatioOver(const PhotoColours& a, const PhotoColours& b,
                      std::span<const size_t> texels) {
  ColourRatio ratio{.a = a.photo, .b = b.photo, .weight = static_cast<double>(texels.size())};
  for (int k = 0; k < 3; ++k) {
    std::vector<double> logs;
    logs.reserve(texels.size());
    for (const size_t i : texels) {
      logs.push_back(std::log(static_cast<double>(a.rgb[3 * i + k]) / b.rgb[3 * i + k]));
    }
    ratio.log_ratio[k] = *Median(std::move(logs));
  }
  const auto mean = [&](const PhotoColours& photo) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    if (photo.corner_share.empty()) return sum;
    for (const size_t i : texels) {
      const double share = photo.corner_share[i];
      sum += Eigen::Vector2d(share, share * share);
    }
    return Eigen::Vector2d(sum / static_cast<double>(texels.size()));
  };
  ratio.corner_a = mean(a);
  ratio.corner_b = mean(b);
  return ratio;
}

}  // namespace

Eigen::Vector3d HueOf(const Eigen::Vector3d& logs) {
  return logs.array() - logs.mean();
}

Eigen::Vector3d GainOf(const Eigen::Vector3d& logs) {
  return logs.array().exp().max(1 / kLargestGain).min(kLargestGain);
}

std::vector<ColourRatio> MeasureRatios(const PhotoColours& a, const PhotoColours& b,
                                       std::span<const uint8_t> both_show) {
  const auto usable = [](const float* rgb) {
    return std::min({rgb[0], rgb[1], rgb[2]}) > kDarkest &&
           std::max({rgb[0], rgb[1], rgb[2]}) < kBrightest;
  };
  std::vector<size_t> texels;
  for (size_t i = 0; i < both_show.size(); ++i) {
    if (both_show[i] && usable(&a.rgb[3 * i]) && usable(&b.rgb[3 * i])) texels.push_back(i);
  }
  if (texels.size() < kFewestTexels) return {};
  size_t groups = 1;
  if (!a.corner_share.empty() && !b.corner_share.empty()) {
    groups = std::min(kMostGroups, texels.size() / kFewestTexels);
    std::ranges::stable_sort(texels, {},
                             [&](size_t i) { return a.corner_share[i] - b.corner_share[i]; });
  }
  std::vector<ColourRatio> ratios;
  for (size_t group = 0; group < groups; ++group) {
    const size_t begin = group * texels.size() / groups;
    const size_t end = (group + 1) * texels.size() / groups;
    ratios.push_back(RatioOver(a, b, std::span(texels).subspan(begin, end - begin)));
  }
  return ratios;
}

Eigen::Vector3d CommonGain(std::span<const ColourRatio> ratios) {
  Eigen::Vector3d log_ratio = Eigen::Vector3d::Zero();
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double> values;
    for (const ColourRatio& ratio : ratios) values.push_back(ratio.log_ratio[channel]);
    log_ratio[channel] = Median(std::move(values)).value_or(0);
  }
  std::vector<double> apart;
  for (const ColourRatio& ratio : ratios) {
    apart.push_back((HueOf(ratio.log_ratio) - HueOf(log_ratio)).norm());
  }
  if (ratios.size() < kFewestFacets || *Median(std::move(apart)) > kAgreeingHues) {
    log_ratio.setConstant(log_ratio.mean());
  }
  return GainOf(-log_ratio);
}

}  // namespace stucco
