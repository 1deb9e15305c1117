// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/image.h"

namespace stucco {

// A facet's picture and who painted each texel (labels as in textures.json: 0 outside or nobody,
// 255 inpainted, else a photo).
struct FacetPicture {
  Image picture;
  std::vector<uint8_t> labels;
};

// Whether a label means a photo.
inline bool IsPainted(uint8_t label) {
  return label != 0 && label != 255;
}

// By texel, whether a photo painted it.
std::vector<uint8_t> PaintedTexels(const FacetPicture& facet);

// Side of the blocks that are compared, texels.
inline constexpr int kChangeBlock = 16;

// A place on a facet where it changed, texels of its picture.
struct ChangedBox {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
  double share = 0;      // of the judged area that changed in it
  bool pattern = false;  // most of it is of another pattern, else of another colour
};

// What differs between two pictures of a facet, as shares of the area that is judged.
struct FacetChanges {
  double compared = 0;            // painted from photos in both
  double repainted = 0;           // of another colour, with the same pattern or none
  double other = 0;               // of another pattern and hue: something new, or gone
  double shaded = 0;              // of another pattern in light and dark alone, as shadows draw it
  std::vector<ChangedBox> boxes;  // what is repainted or other, the largest first
  // By block of kChangeBlock texels, rows of `block_columns`: the colour that it had, where it
  // changed or the nearest one did that both show; black where not.
  std::vector<Eigen::Vector3f> outdated;
  int block_columns = 0;

  // Whether a texel that one of the pictures does not show has the colour of what changed.
  bool IsOutdated(int x, int y, const uint8_t* before) const;
};

// Compares two pictures on the same grid block by block (16 texels a side, where both are painted),
// so that small shifts do not count. What light can do does not count either: blocks that are
// brighter or darker with the same pattern and about the same hue are in the sun or in the shade;
// so a plain wall that is painted darker in the same hue does not count. A block is of another
// colour where its hue differs by more than sun and sky do; of another pattern where blocks of 4
// texels inside do not go together (correlation) although they have contrast, and what is there now
// was not there before a little beside either: relief, and planes that are not quite right, look
// shifted when they are seen from elsewhere. Where the hue stays, the new pattern may be a shadow:
// the sun has moved, so that edges of shadows come and go, above all on relief. This is told apart
// and is no change. Single blocks do not count: windows mirror something else every day. `mask` is
// not zero where pictures are judged, and shares are of its area, `comparable` where both pictures
// look at it from much the same direction; elsewhere colours alone count, and only where more of
// them are others than relief can hide and show. Requires pictures of one size.
FacetChanges FindChanges(const FacetPicture& before, const FacetPicture& after,
                         std::span<const uint8_t> mask, std::span<const uint8_t> comparable);

}  // namespace stucco
