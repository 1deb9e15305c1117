// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/epoch.h"
#include "survey/stage.h"

namespace stucco {

// report.html of an epoch whose files are finished below `context.out`: what changed since the
// survey's textures, every picture that is another now beside the one before, why each was kept,
// replaced, filled or painted, and which new photos were placed. One page that opens from disk and
// loads nothing. Throws Error (kBadInput) where the model or the textures of either cannot be read;
// a picture that is damaged is left out, and the page says so.
void WriteEpochReport(const Epoch& epoch, StageContext& context);

}  // namespace stucco
