// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/captures.h"
#include "survey/plan.h"

namespace stucco {

// Finds the photo of every planned view by the view's id in the name of the file, where our DJI
// missions put it (DJI_20260301120000_0007_D_h0003v1.JPG): the last word of the name, words being
// parted by anything but letters and digits. Writes the id into `view` of that photo. Where several
// photos carry an id, the first usable one by capture time, then path, is the view and the others
// are extra. Returns what became of each view, in the plan's order.
std::vector<CapturedView> MatchToPlan(const Plan& plan, std::vector<CapturedPhoto>& photos);

}  // namespace stucco
