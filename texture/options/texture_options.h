// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/options.h"

namespace stucco {

// How facets are painted. Lengths in texels ("_px") are texels of the finished picture.
struct TextureOptions {
  double texel_size = 0;  // world units; 0: from the photos, facet by facet
  int max_texture_px = 8192;
  double max_angle_deg = 78;
  int max_candidates = 16;
  bool guided = true;
  int cell_px = 16;
  double photo_cost = 0.03;
  double seam_cost = 1.0;
  double min_region = 0.01;
  bool occluders = true;
  bool relief = true;
  bool align = true;
  double align_limit_px = 8;
  bool colour = true;
  bool blend = true;
  bool inpaint = true;
  bool ground = true;
  bool orthophotos = true;
  bool debug = false;
  int glb_max_px = 4096;
  int glb_megapixels = 128;  // more than graphics cards hold uncompressed
  int glb_atlas_px = 4096;
  int glb_quality = 90;
  bool glb_relief = false;
};

void Describe(OptionTable& table, TextureOptions& options);

}  // namespace stucco
