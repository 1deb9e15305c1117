// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "survey/camera.h"
#include "survey/captures.h"
#include "survey/ids.h"
#include "survey/plan.h"
#include "survey/pose.h"
#include "survey/reconstruction.h"

namespace stucco {

// A photo whose pose is known, with all that ingest, calibration and the plan say about it: the one
// record that the stages after calibration work with.
struct SurveyPhoto {
  PhotoId id;              // of its registered image
  CapturedPhoto captured;  // as ingest found it; only its path where ingest does not know it
  Camera camera;           // calibrated, for the photo in full size
  Pose cam_from_world;
  // captured.sharpness against the median of the survey's usable photos; 1: typical or not known.
  double relative_sharpness = 1;
  // Rays up to this squared radius (x/z, y/z) are known to be where the lens model is one-to-one,
  // which is costly to find out for each; see SafeRadiusSquared. 0: not known.
  double safe_radius_squared = 0;
  // Of the facades that the plan means it for; none without a plan. See JoinPlan.
  std::vector<std::string> planned_facades;

  // Relative to the photo folder, '/' between folders.
  const std::string& path() const { return captured.path; }
};

// The registered images in the order of their ids, with what ingest knows about the photos of their
// paths. Empty captures: nothing.
std::vector<SurveyPhoto> JoinPhotos(const Reconstruction& reconstruction, const Captures& captures);

// JoinPhotos of calib/sparse/0 and, where it is, ingest/captures.json. Throws Error (kBadInput).
std::vector<SurveyPhoto> ReadSurveyPhotos(const std::filesystem::path& survey);

// Writes the facades that each photo's view of the plan is meant for.
void JoinPlan(const Plan& plan, std::span<SurveyPhoto> photos);

// Squared radius of the ray to the farthest corner of the picture where the lens model allows all
// rays up to it, else 0.
double SafeRadiusSquared(const Camera& camera);

// Pixel of a world point, or nothing where it is behind the camera, outside the picture or where
// the lens model folds back (a point far outside the field of view can land inside the picture).
std::optional<Eigen::Vector2d> ProjectIntoPhoto(const SurveyPhoto& photo,
                                                const Eigen::Vector3d& point_in_world);

}  // namespace stucco
