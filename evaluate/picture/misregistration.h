// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

// How far the result's content lies from the truth's, in pixels: the median length of the optical
// flow (pyramidal Lucas-Kanade: Bouguet, "Pyramidal Implementation of the Lucas Kanade Feature
// Tracker", 2001) over a grid of places every 4 pixels that have texture in two directions and from
// which the flow back from the result leads home. Both pictures are first brought to the same local
// mean and contrast, so that light does not matter. Flow that begins at the shift of the whole
// picture, by phase correlation, takes its place where it leads home clearly more often; so large
// shifts are found, too, but of content that repeats itself only up to half its period.
// kNotMeasured where fewer than 10 places or a tenth of them lead home.
double Misregistration(const PicturePair& pair);

}  // namespace stucco::evaluate
