// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/hovers.h"

#include <cmath>
#include <map>

namespace stucco {
namespace {

std::map<int, std::vector<int>> ByHover(const Scene& scene) {
  std::map<int, std::vector<int>> by_hover;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    const ScenePhoto& photo = scene.photos[i];
    if (photo.pose && photo.hover >= 0) by_hover[photo.hover].push_back(i);
  }
  return by_hover;
}

}  // namespace

std::vector<SamePlace> SamePlaces(const Scene& scene) {
  std::vector<SamePlace> pairs;
  if (scene.hover_sigma_m <= 0) return pairs;
  for (const auto& [hover, photos] : ByHover(scene)) {
    const double sigma = std::sqrt(static_cast<double>(photos.size())) * scene.hover_sigma_m;
    for (size_t a = 0; a < photos.size(); ++a) {
      for (size_t b = a + 1; b < photos.size(); ++b) {
        pairs.push_back({photos[a], photos[b], sigma});
      }
    }
  }
  return pairs;
}

std::vector<std::vector<int>> HoverMates(const Scene& scene) {
  const auto by_hover = ByHover(scene);
  std::vector<std::vector<int>> mates(scene.photos.size());
  for (int i = 0; i < static_cast<int>(mates.size()); ++i) {
    const auto found = by_hover.find(scene.photos[i].hover);
    if (found == by_hover.end()) continue;
    mates[i] = found->second;
    std::erase(mates[i], i);
  }
  return mates;
}

}  // namespace stucco
