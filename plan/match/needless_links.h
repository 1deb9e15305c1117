// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/match/linked_photos.h"

namespace stucco::plan {

// Link photos that can go together without any photo lacking more than it does
// (plan/match/ties.h), ascending: what was added later may do what they were added for. Those of
// stops with the fewest photos come first, so that stops go with them.
std::vector<uint32_t> NeedlessLinks(const LinkedPhotos& photos);

// Takes these photos, ascending, out of the hovers, and hovers that nothing is left of.
void DropLinks(std::span<const uint32_t> links, const LinkedPhotos& photos,
               std::vector<Hover>& hovers);

}  // namespace stucco::plan
