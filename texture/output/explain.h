// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>

#include "survey/image.h"
#include "survey/survey_photo.h"
#include "texture/painting/paint.h"

namespace stucco {

// How a facet came to its picture, as pictures that a person looks at. All show the facet seen at
// right angles, upright.

// Every candidate in the order of merit: what it shows, reddish where something stands before the
// facet, bluish where it looks past it, paper where it shows nothing; below it the share that it
// paints, in a frame of its colour in OwnerMap, and its name.
Image CandidateSheet(const PaintRecord& record, std::span<const SurveyPhoto> photos);

// Which candidate paints what, each in a colour of its own over the picture's brightness; seams are
// black, what nobody paints is paper.
Image OwnerMap(const PaintRecord& record);

// The picture as the photos show it, and beside it as painted: light evened out, seams blended,
// holes filled. At most `kLightSide_px` high and wide each.
Image BeforeAndAfterLight(const PaintRecord& record, const PaintedFacet& painted);
inline constexpr int kLightSide_px = 1200;

// Heights before the facet's plane in red, behind it in blue, the fuller the farther, up to the
// highest; its scale is written below. Empty where the facet has no relief.
Image ReliefMap(const PaintedFacet& painted);

// Writes these as candidates.jpg, owners.png, light.jpg and relief.png into `folder`, which is
// made. Throws Error (kOutOfResource) when the disk is full.
void WriteExplanation(const PaintRecord& record, const PaintedFacet& painted,
                      std::span<const SurveyPhoto> photos, const std::filesystem::path& folder);

}  // namespace stucco
