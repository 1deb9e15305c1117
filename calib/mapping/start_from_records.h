// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/mapping/mapper.h"
#include "calib/records/records.h"
#include "calib/scene/scene.h"
#include "calib/two_view/initial_pair.h"
#include "survey/stage.h"

namespace stucco {

struct RecordsStart {
  bool usable = false;
  std::string why_not;  // for people; empty when usable
  int num_registered = 0;
};

// Places all photos that have a recorded position and gimbal angles at once, instead of one after
// the other: their matches correct the records, as global structure from motion corrects a first
// guess.
//
//   1. Relative rotations of the pairs with most matches (essential matrix) are held against those
//      of the gimbals; where most disagree the records are not used.
//   2. The compass's error of each flight, from the directions of baselines (robust vote).
//   3. Rotation averaging with the gimbals as priors (Chatterjee and Govindu, "Efficient and robust
//      large-scale rotation averaging", 2013; here with Cauchy loss).
//   4. Points, seen with the tolerance that the epipolar errors of all matches ask for, and bundle
//      adjustment with the records as priors, again and again with a smaller tolerance.
//
// Needs records of most photos; photos without any, and those whose records are wrong, stay without
// a pose. Leaves the scene in the frame of the positions. Where it is not usable the scene is as it
// was.
RecordsStart StartFromRecords(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                              const std::vector<PoseRecord>& records, const StageContext& context,
                              Scene& scene);

}  // namespace stucco
