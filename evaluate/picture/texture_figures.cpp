// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/texture_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluate/means.h"
#include "simulate/scene/scene_folder.h"

namespace stucco::evaluate {

double WeightedMedian(std::vector<Weighted> values) {
  std::erase_if(values, [](const Weighted& v) { return !std::isfinite(v.value) || v.weight <= 0; });
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double all = 0;
  for (const Weighted& v : values) all += v.weight;
  double below = 0;
  for (const Weighted& v : values) {
    below += v.weight;
    if (2 * below >= all) return v.value;
  }
  return kNotMeasured;
}

simulate::Light MiddleLight(const simulate::Flight& flight) {
  std::vector<const simulate::FlownPhoto*> taken;
  for (const simulate::FlownPhoto& photo : flight.photos) {
    if (!photo.held_out && !photo.lost) taken.push_back(&photo);
  }
  return taken.empty() ? simulate::Light{} : taken[taken.size() / 2]->light;
}

std::vector<bool> FindOccluders(const simulate::Scene& scene) {
  std::vector<bool> occluders;
  for (const std::string& element : scene.elements) {
    occluders.push_back(element.starts_with(simulate::kOccluderPrefix));
  }
  return occluders;
}

double TruthTexel_m(const std::filesystem::path& scene_folder) {
  double finest = std::numeric_limits<double>::infinity();
  const std::filesystem::path file = scene_folder / simulate::kTruthTextures;
  if (std::filesystem::exists(file)) {
    for (const TexturedFacet& facet : ReadTextureSet(file).facets) {
      if (facet.metres_per_texel > 0) finest = std::min(finest, facet.metres_per_texel);
    }
  }
  constexpr double kUsual_m = 0.01;
  return std::isfinite(finest) ? finest : kUsual_m;
}

void MeasureTextures(const TextureComparison& comparison, const simulate::Flight& flight,
                     const std::filesystem::path& flight_folder, Evaluation& evaluation) {
  evaluation.facades = CompareFacades(comparison);
  std::vector<WeightedPicture> facades;
  std::vector<Weighted> shifts;
  for (const FacadeFigures& facade : evaluation.facades) {
    const double painted_m2 = facade.painted * facade.area_m2;
    facades.push_back({facade.picture, painted_m2});
    shifts.push_back({facade.misregistration_px, painted_m2});
  }
  evaluation.texture_mean = MeanFigures(facades);
  evaluation.misregistration_px = WeightedMedian(std::move(shifts));
  evaluation.views = CompareViews(comparison, flight, flight_folder);
  std::vector<WeightedPicture> views;
  for (const HeldOutFigures& view : evaluation.views) views.push_back({view.picture, 1});
  evaluation.views_mean = MeanFigures(views);
}

}  // namespace stucco::evaluate
