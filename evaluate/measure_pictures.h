// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "evaluate/figures/evaluation.h"
#include "evaluate/request.h"
#include "evaluate/truth.h"
#include "simulate/scene/scene.h"
#include "survey/pose.h"

namespace stucco::evaluate {

// The textures of a survey and the views of its textured model, with their means, into
// `evaluation`. The survey has proxy/facets.json and texture/textures.json.
void MeasurePictures(const EvaluateRequest& request, const Truth& truth, simulate::Scene scene,
                     const Similarity& truth_from_world, Evaluation& evaluation);

// Share of the facades' area that is painted; not measured where there is no area.
double PaintedShare(std::span<const FacadeFigures> facades);

// Mean by painted area.
PictureFigures MeanOfFacades(std::span<const FacadeFigures> facades);

// Median of what `shift_of` says of each facade, by painted area, without those not measured.
double MedianShift(std::span<const FacadeFigures> facades,
                   double (*shift_of)(const FacadeFigures&));

}  // namespace stucco::evaluate
