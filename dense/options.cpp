// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/options.h"

namespace stucco {

void Describe(OptionTable& table, DenseOptions& options) {
  table.Add("max_image_px", options.max_image_px, 200, 20000,
            "Photos are reduced to this many pixels on the longer side before depths are matched.");
  table.Add("max_sources", options.max_sources, 1, 16, "Photos that each photo is matched with.");
  table.Add("min_consistent", options.min_consistent, 1, 10,
            "Other photos that must confirm a depth; one in a survey of two photos.");
  table.Add("max_cost", options.max_cost, 0.05, 2,
            "Depths with a worse matching cost (1 - correlation) are dropped.");
  table.Add(
      "max_reprojection_px", options.max_reprojection_px, 0.1, 20,
      "Depths of two photos agree when they are at most this far apart in the picture, pixels.");
  table.Add("max_depth_difference", options.max_depth_difference, 0.0001, 0.5,
            "Depths of two photos agree when they differ by at most this share.");
  table.Add("iterations", options.iterations, 1, 10, "Rounds of matching at full size.");
  table.Add("outlier_sigmas", options.outlier_sigmas, 0, 100,
            "Points farther from their neighbours than this many standard deviations are dropped; "
            "0 keeps all.");
  table.Add("write_depth_maps", options.write_depth_maps,
            "Also write dense/depth/*.dmap, eight bytes a pixel.");
}

}  // namespace stucco
