// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/options/calib_options.h"
#include "survey/camera.h"
#include "survey/captures.h"
#include "survey/pose.h"
#include "survey/reconstruction.h"
#include "survey/stage.h"

namespace stucco {

// A finished reconstruction that other photos are placed in; nothing of it changes.
struct FinishedModel {
  Reconstruction reconstruction;
  Captures captures;             // of its photos
  std::filesystem::path photos;  // their folder, which may be gone: see LocalisePhotos
};

// A usable photo that was to be placed.
struct LocalisedPhoto {
  int capture = 0;  // index into Captures::photos
  Camera camera;
  std::optional<Pose> cam_from_world;  // nothing: refused
  std::string why;                     // refused, for people
  int matched_photos = 0;              // of the model
  int points = 0;                      // of the model that it seems to show
  int inliers = 0;                     // of these, in agreement with the pose
  // One standard deviation of the pose, the model taken as it is: unit of the world, root of the
  // sum over the axes; in its picture, full-size pixels. -1: not known.
  double position_sigma = -1;
  double picture_sigma_px = -1;
};

// Places the usable photos of `captures`, which lie below `context.photos`, in a finished model:
// features against those of the model's photos that show its points, the nearest by recorded
// position and the most alike in appearance first; verified pairs (VerifyPair); then PlaceInModel.
// A camera that the model knows, by its metadata, keeps the intrinsics it has there. Features of
// the model's photos come from the checkpoints of calibration (`context.units`), or are found again
// in the photos. In the order of the captures. Throws Error (kBadInput) where neither is there.
std::vector<LocalisedPhoto> LocalisePhotos(const CalibOptions& options, const FinishedModel& model,
                                           const Captures& captures, const StageContext& context);

}  // namespace stucco
