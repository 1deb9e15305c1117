// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/new_plants.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "texture/selection/foliage.h"

namespace stucco {
bool LeaveOutNewPlants(const FacetPicture& before, FacetPicture& after) {
  assert(before.labels.size() == after.labels.size());
  const std::vector<uint8_t> now = LeafTexels(after.picture, PaintedTexels(after));
  const std::vector<uint8_t> then = LeafTexels(before.picture, PaintedTexels(before));
  size_t shown = 0, plants = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    shown += IsPainted(after.labels[i]);
    plants += now[i] && !then[i];
  }
  const bool is_hidden = 2 * plants > shown;
  for (size_t i = 0; i < now.size(); ++i) {
    const bool is_plant = is_hidden || (now[i] && !then[i]);
    if (is_plant && IsPainted(after.labels[i])) after.labels[i] = 255;
  }
  return is_hidden;
}

}  // namespace stucco
