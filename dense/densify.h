// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dense/options.h"
#include "survey/stage.h"

namespace stucco {

// PatchMatch multi-view stereo and fusion. Reads calib/sparse/0 and the photos in it; writes below
// context.out:
//   cloud.ply             fused points with normals, colours and the photos that see them
//   depth/<photo>.dmap    on request (docs/formats.md)
// Throws Error (kStageFailed) when no photo has a neighbour to match with or no depth survives.
void RunDense(const DenseOptions& options, StageContext& context);

}  // namespace stucco
