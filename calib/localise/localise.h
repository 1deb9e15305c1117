// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "calib/options/calib_options.h"
#include "survey/captures.h"
#include "survey/epoch.h"
#include "survey/reconstruction.h"
#include "survey/stage.h"

namespace stucco {

// A finished reconstruction that other photos are placed in; nothing of it changes.
struct FinishedModel {
  Reconstruction reconstruction;
  Captures captures;             // of its photos
  std::filesystem::path photos;  // their folder, which may be gone: see LocalisePhotos
};

// Places the usable photos of `captures`, which lie below `context.photos`, in a finished model:
// features against those of the model's photos that show its points, the nearest by recorded
// position and the most alike in appearance first; verified pairs (VerifyPair); then PlaceInModel.
// A camera that the model knows, by its metadata, keeps the intrinsics it has there. Features of
// the model's photos come from the checkpoints of calibration (`context.units`), or are found again
// in the photos. Every photo of the captures in their order, those not placed with the reason.
// Throws Error (kBadInput) where neither is there.
std::vector<EpochPhoto> LocalisePhotos(const CalibOptions& options, const FinishedModel& model,
                                       const Captures& captures, const StageContext& context);

}  // namespace stucco
