// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "evaluate/evaluate.h"
#include "evaluate/truth.h"
#include "simulate/scene/scene.h"
#include "survey/pose.h"

namespace stucco::evaluate {

// The textures of a survey and the views of its textured model, with their means, into
// `evaluation`. The survey has proxy/facets.json and texture/textures.json.
void MeasurePictures(const EvaluateRequest& request, const Truth& truth, simulate::Scene scene,
                     const Similarity& truth_from_world, Evaluation& evaluation);

// Means by painted area, and the median misregistration by the same.
PictureFigures MeanOfFacades(std::span<const FacadeFigures> facades);
double MedianMisregistration(std::span<const FacadeFigures> facades);

}  // namespace stucco::evaluate
