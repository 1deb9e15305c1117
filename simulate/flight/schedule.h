// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "simulate/flight/options.h"
#include "survey/captures.h"
#include "survey/plan.h"

namespace stucco::simulate {

// When and from where a photo is really taken, in the frame of the plan.
struct Shot {
  int view = -1;   // index into Plan::views; -1: held out
  int flight = 0;  // in which it was taken
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  GimbalAngles angles;
  int day = 0;            // 1 is January 1 of 2026
  double hour = 0;        // local solar time
  double time_s = 0;      // since the first photo
  int number = 0;         // the camera's count of files, from 1
  int duplicate_of = -1;  // index of the shot that this one repeats
  bool lost = false;
};

// The planned views in their order, with what chance does to them: noise of position (one for all
// views of a stop, and a tenth of it for each) and gimbal, lost photos, photos taken twice (right
// after one another). Times follow from the path at the speed of the planner's model; a flight that
// would go on below the lowest sun is continued the next day. Throws Error
// (kBadInput: no views; kUsage: a start in the dark, also on one of the days after the first).
std::vector<Shot> ScheduleShots(const Plan& plan, const FlightOptions& options);

// Poses near planned ones and different from all of them: moved by 1 to 3 m and turned by up to 10
// degrees. `attempt` gives others at the same number: for places where no camera can be.
Shot HeldOutShot(const Plan& plan, const std::vector<Shot>& shots, const FlightOptions& options,
                 int number, int attempt);

// "20260430100012", as it stands in file names, and "2026:04:30 10:00:12", as in EXIF.
std::string FileTime(const Shot& shot);
std::string ExifTime(const Shot& shot);
int Milliseconds(const Shot& shot);

// "DJI_20260430100012_0007_D_h0003v1.JPG": where the drone puts the name that the mission gives.
std::string PhotoName(const Shot& shot, const std::string& view);

}  // namespace stucco::simulate
