// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/scene/scene.h"
#include "calib/two_view/initial_pair.h"
#include "survey/captures.h"

namespace stucco {

// A sentence for each group of photos that were taken from one point (RotationGroups), naming them,
// and the photos that match no other but were recorded at that point within the accuracy of their
// positions. The scene's photos have the given captures.
std::vector<std::string> DescribePanoramas(const Scene& scene,
                                           const std::vector<VerifiedPair>& pairs,
                                           const std::vector<const CapturedPhoto*>& captures);

}  // namespace stucco
