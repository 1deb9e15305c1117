// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/facet_light.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "survey/median.h"
#include "texture/light/robust_sums.h"

namespace stucco {
namespace {

// Deviation, of logarithms of colours, of a photo's light on one facet from its light on all while
// the sun is where it is. What else makes it another, as gloss does on slates, changes within the
// facet and is left to seams.
constexpr double kLevelSigma = 0.003;

// When most of them were taken; nothing where no time is known.
std::optional<double> MiddleTime_h(std::span<const TakenPhoto> photos,
                                   const std::map<int, int>& unknown_of) {
  std::vector<double> times_h;
  for (const auto& [photo, unknown] : unknown_of) {
    if (photos[photo].time_h) times_h.push_back(*photos[photo].time_h);
  }
  return Median(std::move(times_h));
}

}  // namespace

PhotosLight LightOnFacet(const PhotosLight& light, std::span<const ColourRatio> of_facet) {
  PhotosLight on_facet = light;
  std::map<int, int> unknown_of;  // by photo
  for (const ColourRatio& ratio : of_facet) {
    for (const int photo : {ratio.a, ratio.b}) {
      unknown_of.try_emplace(photo, static_cast<int>(unknown_of.size()));
    }
  }
  if (unknown_of.empty()) return on_facet;
  const std::optional<double> middle_h = MiddleTime_h(light.photos, unknown_of);
  Eigen::VectorXd sigmas(static_cast<Eigen::Index>(unknown_of.size()));
  for (const auto& [photo, unknown] : unknown_of) {
    sigmas[unknown] = std::hypot(kLevelSigma, SunSigma(middle_h, light.photos[photo].time_h));
  }
  std::vector<Eigen::Vector3d> levels(unknown_of.size());
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<SumEquation> equations;
    equations.reserve(of_facet.size());
    for (const ColourRatio& ratio : of_facet) {
      const double lost = LostToCorners(ratio, light.falloffs);
      const double gain = std::log(light.gains[ratio.a][channel] / light.gains[ratio.b][channel]);
      equations.push_back(OfRatio(ratio, unknown_of.at(ratio.a), unknown_of.at(ratio.b),
                                  ratio.log_ratio[channel] - lost + gain, kRatioSigma));
    }
    NormalFactors factors;
    const Eigen::VectorXd values = SolveSums(equations, sigmas, factors);
    for (size_t i = 0; i < levels.size(); ++i) {
      levels[i][channel] = values[static_cast<Eigen::Index>(i)];
    }
  }
  for (const auto& [photo, unknown] : unknown_of) {
    const Eigen::Vector3d logs = on_facet.gains[photo].array().log();
    on_facet.gains[photo] = GainOf(logs - levels[unknown]);
  }
  return on_facet;
}

}  // namespace stucco
