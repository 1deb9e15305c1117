// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "survey/epoch.h"
#include "texture/epoch/changes.h"

namespace stucco {

// What of a facet's picture comes from new photos. Not kept ones.
// Replaced and painted: what they show. Filled: of that, what had not been painted.
std::vector<uint8_t> TexelsToTake(FacetChoice choice, const FacetPicture& before,
                                  const FacetPicture& after);

// The new picture where `take` is set, the old one elsewhere, going over within a few texels on the
// taken side. Colours go on smoothly outside `mask`. Labels of the new picture stay, those of the
// old one come after `new_photos`; what neither photo shows is 255, and so is an old photo whose
// number would be too large. Requires pictures of one size.
FacetPicture MergePictures(const FacetPicture& before, const FacetPicture& after,
                           std::span<const uint8_t> take, std::span<const uint8_t> mask,
                           size_t new_photos);

// Fills `hole` with the texture of what the picture has where `source` is set; inpainted (255) from
// then on. For what is no longer as the old picture has it, and no new photo shows.
void FillOutdated(std::span<const uint8_t> hole, std::span<const uint8_t> source,
                  FacetPicture& picture);

// The photos that labels name, most texels first, as indices from 0; renumbers the labels in that
// order.
std::vector<int> Renumber(std::vector<uint8_t>& labels);

}  // namespace stucco
