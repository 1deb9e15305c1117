// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "evaluate/figures/evaluation.h"
#include "simulate/flight/flight_folder.h"
#include "simulate/render/renderer.h"
#include "survey/pose.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco::evaluate {

// A result and the truth that it is compared with. `truth_from_world` takes the survey's world into
// the scene's frame (from the camera positions); scale 1 up to calibration's error.
struct TextureComparison {
  std::filesystem::path texture_folder;  // of the images that `textures` names
  const Proxy& proxy;
  const TextureSet& textures;
  const Proxy& truth;
  const simulate::Renderer& scene;  // the truth is drawn on the texel grid of the result
  simulate::Light light;            // of the middle of the flight
  const simulate::Flight& flight;   // whose camera takes the ideal photos
  std::vector<bool> occluders;      // elements of the scene that are no part of a facade
  Similarity truth_from_world;
  double truth_texel_m = 0.01;        // of the truth's pictures: nothing is compared finer
  std::filesystem::path output;       // pictures/ is made in it
  std::filesystem::path lpips_model;  // empty: none
  int threads = 1;
};

// Figures of every wall of the truth, matched to the result's facets on the same plane: the truth
// is drawn at right angles on their texel grids and both are compared where they overlap and the
// result was painted from photos. One gain per channel for the whole survey brings the truth's
// light to the result's, for exposure and white balance cannot be known; what differs from facade
// to facade is error. Where a picture of the result is missing or damaged, its facade's `problem`
// says so, and the picture counts as not painted. Beside the result's figures are those of ideal
// photos of the same texels (ideal_photo.h); without a photo that sees the wall there are none.
std::vector<FacadeFigures> CompareFacades(const TextureComparison& comparison);

// Renders texture/model.glb where the held-out photos of the flight were taken, with their lens,
// and compares where the model is and no occluder stands before it. Empty where no photo was held
// out. Photos that cannot be read have a `problem` and no figures. Throws Error (kBadInput) where
// the model cannot be read.
std::vector<HeldOutFigures> CompareViews(const TextureComparison& comparison,
                                         const std::filesystem::path& flight_folder);

}  // namespace stucco::evaluate
