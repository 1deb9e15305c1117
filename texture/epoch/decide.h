// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/epoch.h"

namespace stucco {

// What is known of a facet that both the survey's photos and new ones may have painted. Shares are
// of the facet's area.
struct FacetEvidence {
  double painted_before = 0;  // from photos
  double painted_after = 0;
  double both = 0;          // painted before and after
  double compared = 0;      // of these, from much the same direction
  double gsd_before_m = 0;  // median size of a photo pixel on it; 0: not known
  double gsd_after_m = 0;
  double changed_share = 0;  // of `both`
};

struct FacetDecision {
  FacetChoice choice = FacetChoice::kKept;
  std::string why;  // for people
};

// What becomes of a facet's picture.
// kAlways: wherever new photos show it. kNever: only what was not painted before.
// kAuto: a picture that new photos show well enough, four fifths of what any photo shows, is
// replaced where the wall changed (a tenth of what both show); of a wall that did not, what no
// photo had shown is filled where that is a twentieth of the facet or more; all else is kept, also
// where new photos are finer: what has not changed keeps its bytes, and the reason says so.
FacetDecision Decide(ReplaceMode mode, const FacetEvidence& evidence);

}  // namespace stucco
