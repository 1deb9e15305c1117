// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "evaluate/evaluation.h"
#include "evaluate/picture/compare_textures.h"

namespace stucco::evaluate {

// Facades, photos held out, and their means: facades by painted area, `misregistration_px` the
// median over facades by painted area.
void MeasureTextures(const TextureComparison& comparison, const simulate::Flight& flight,
                     const std::filesystem::path& flight_folder, Evaluation& evaluation);

// Light of the photo in the middle of the flight; the default where there is none.
simulate::Light MiddleLight(const simulate::Flight& flight);

// Elements whose name says that they only stand about.
std::vector<bool> FindOccluders(const simulate::Scene& scene);

// Of the truth's pictures, from truth/textures.json; 1 cm where there is none.
double TruthTexel_m(const std::filesystem::path& scene_folder);

// The value below which half of the weight lies; kNotMeasured without weight. Values that are not
// finite are left out.
struct Weighted {
  double value = 0;
  double weight = 0;
};
double WeightedMedian(std::vector<Weighted> values);

}  // namespace stucco::evaluate
