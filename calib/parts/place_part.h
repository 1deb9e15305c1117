// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/records/records.h"
#include "calib/scene/scene.h"

namespace stucco {

// How surely records alone place a part of a survey against another.
struct PartPlace {
  double position_sigma_m = -1;    // one standard deviation, root of the sum over the axes
  double rotation_sigma_rad = -1;  // likewise
  // By both, where its points are: in metres, and in pixels of the part's photos.
  double surface_sigma_m = -1;
  double surface_sigma_px = -1;
  // Share of the part's points that lie, to within that and the distance between points, where the
  // other sees points too: what would come out double.
  double shared_surface = 0;
};

// From the number of the part's records, how they lie and how they scatter; the records' common
// shift is one of all photos of a flight, so that a part without any flight of the other is as
// uncertain as a single position was stated to be. `errors` may be null where angles and positions
// took no part in an adjustment: then the part's own distances from its positions say how these
// scatter. Requires scenes with the same photos, in the frame of the records.
PartPlace PlaceOfPart(const std::vector<PoseRecord>& records, const RecordErrors* errors,
                      const Scene& part, const Scene& other);

}  // namespace stucco
