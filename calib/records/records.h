// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/records/read_records.h"
#include "calib/scene/scene.h"

namespace stucco {

// How the records of one flight err.
struct FlightErrors {
  int num_photos = 0;  // with a pose and a record of either kind
  // Recorded minus true, beyond what is common to all flights, which nothing can tell.
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  double sigma_horizontal_m = 5;  // per axis, about the shift, of the middle photo
  double sigma_vertical_m = 10;
  // Standard deviations over those that the photos state: some photos of a flight may have been
  // taken without the corrections that the others had.
  double horizontal_over_stated = 1;
  double vertical_over_stated = 1;
  double yaw_rad = 0;  // of the compass, clockwise from above: true minus recorded
};

// Recorded positions are p + shift + noise, recorded attitudes G with
//   R = exp(noise) exp(mount) G Rz(yaw of the flight)
// for a camera at p with rotation R (cam_from_world).
struct RecordErrors {
  std::vector<FlightErrors> flights;
  Eigen::Vector3d mount_rad = Eigen::Vector3d::Zero();  // rotation vector in the camera's frame
  double sigma_attitude_rad = 0.02;                     // about each axis
  // Of single photos about the place of their hover, per axis; 0: too few tell.
  double sigma_hover_m = 0;
  // The scene's frame against gravity, as the gimbals show it: rotation vector, up component 0.
  Eigen::Vector3d tilt_rad = Eigen::Vector3d::Zero();
  // Of that tilt about its worse axis, whatever the mount may be; negative: too few gimbals tell.
  double sigma_tilt_rad = -1;
};

// How far the up of a frame that the records hold may be off, one standard deviation: how surely
// the gimbals know it, and how far the frame is tilted against them. Nothing where they do not
// tell.
std::optional<double> UpSigma_rad(const RecordErrors& errors);

// Variance components of the records from the photos that have poses, by medians, so that wrong
// poses and wrong records do not count; the scene must be in the frame of the records but for a
// small turn about up, which positions tell (HeadingByPositions) where no control points do, and
// which is nobody's error. A shift, a mount or a yaw that is no more than three of its own standard
// deviations is taken to be zero; those of a flight's shift and yaw include how surely matches hold
// the flight against the others (TiesOfFlights), else records would be bent to a flight that hangs
// on a single photo. Flights with fewer than eight posed photos share the deviations of all.
RecordErrors MeasureRecordErrors(const std::vector<PoseRecord>& records, const Scene& scene);

// The recorded position without what is common to its flight, with its measured deviations; nothing
// where none is recorded.
std::optional<PositionPrior> CorrectedPosition(const PoseRecord& record,
                                               const RecordErrors& errors);

// Makes the records, corrected and with their measured deviations, the priors of the scene's
// photos, and tells the scene which photos stand in one place.
void ApplyRecords(const std::vector<PoseRecord>& records, const RecordErrors& errors, Scene& scene);

}  // namespace stucco
