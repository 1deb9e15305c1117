// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/mapping/mapper.h"
#include "calib/scene/scene.h"
#include "survey/stage.h"

namespace stucco {

enum class RecordVerdict {
  kAgrees,       // or there is nothing to compare with
  kPositionOff,  // the pose is well determined by itself: the recorded position is wrong
  kContradicts,  // the pose is not where and as the photo was taken
};

// Holds a photo's pose against its priors (ScenePhoto::prior and attitude, with their measured
// deviations): the squares of the differences in standard deviations are those of three normal
// variables each and of six together, at a level of 1e-4. A position alone, with angles that agree
// at a level of 1e-2, is not believed against a pose that four photos share points with which agree
// with their own records, nor against one whose points lie on several planes, since what repeats
// along one wall does not fit the others; but a photo that may be whole bays off is judged by its
// position, within 15 m, as its neighbours match it, windows, balconies and all, a bay off too; and
// so is one whose hover stands where it was recorded, by another photo that agrees with its record.
// Requires a pose in the frame of the priors.
RecordVerdict JudgePose(const Scene& scene, int photo);

// Whether a good part of the points that a photo sees lies off the plane that fits most of them.
bool SeesSeveralPlanes(const Scene& scene, int photo);

// Photos whose poses contradict their records, ascending; none where more than half of the
// poses do: then it is the records that are wrong.
std::vector<int> ContradictingPoses(const Scene& scene);

// Photos whose poses each agree with their records, but not together (contradicting_groups.h).
std::vector<int> OffTogether(const Scene& scene);

struct WrongPoses {
  std::vector<int> corrected;  // posed anew from their records
  std::vector<int> taken;      // without a pose now
};

// Poses that contradict their records, alone (ContradictingPoses) or together (OffTogether), begin
// again where the record
// says: matches that cannot be, as far as the record is good, are taken out for good, the others
// correct the record. What then still contradicts stays without a pose.
WrongPoses MendWrongPoses(const MapperOptions& options, const StageContext& context, Scene& scene);

}  // namespace stucco
