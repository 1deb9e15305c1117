// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/options/texture_options.h"

namespace stucco {

void Describe(OptionTable& table, TextureOptions& options) {
  table.Add("texel_size", options.texel_size, 0, 100,
            "Size of a texel in metres (world units when the survey has no scale); 0 takes the "
            "photos' own resolution on each facet.");
  table.Add("max_texture_px", options.max_texture_px, 16, 32768,
            "Longest side of a facet's picture in pixels; larger facets get larger texels.");
  table.Add("max_angle_deg", options.max_angle_deg, 10, 89,
            "A photo is not used where it looks at the surface at more than this angle from its "
            "normal, degrees.");
  table.Add(
      "max_candidates", options.max_candidates, 1, 64,
      "Photos that compete for one facet: the best are kept, and beyond their number only those "
      "that show what no other does.");
  table.Add("guided", options.guided,
            "Where there is a plan, prefer the photos that it means for a facade among photos of "
            "about the same worth.");
  table.Add("cell_px", options.cell_px, 4, 256,
            "Side in texels of the cells between which seams may run.");
  table.Add("photo_cost", options.photo_cost, 0, 10,
            "What one more photo on a facet must improve, as a share of the facet; higher values "
            "give fewer photos.");
  table.Add("seam_cost", options.seam_cost, 0, 100,
            "Weight of visible seams against the quality of the single photo.");
  table.Add("min_region", options.min_region, 0, 0.5,
            "Regions smaller than this share of the facet go to the photo around them.");
  table.Add("occluders", options.occluders,
            "Avoid photos where points of the cloud (trees, vehicles) stand in front of the "
            "surface.");
  table.Add("relief", options.relief,
            "Find balconies, eaves and reveals on walls of a metric survey from its photos and "
            "paint them where they are, seen at right angles.");
  table.Add("align", options.align,
            "Align the photos of a facet to each other on its plane before blending.");
  table.Add("align_limit_px", options.align_limit_px, 0, 64,
            "Largest correction of a photo by the alignment, texels.");
  table.Add("colour", options.colour,
            "Even out exposure and white balance between photos, over the whole model.");
  table.Add("blend", options.blend, "Blend seams over several bands of detail.");
  table.Add("inpaint", options.inpaint,
            "Fill what no photo shows from the rest of the facet (marked 255 in the label map); "
            "otherwise it stays black.");
  table.Add("ground", options.ground, "Paint the ground too.");
  table.Add("orthophotos", options.orthophotos,
            "Write scaled facade pictures with world files and JSON beside the textures.");
  table.Add("debug", options.debug,
            "Leave pictures in debug/ that explain each facet: its candidates with what stands "
            "before it, who paints what, light before and after, relief. Paints every facet anew.");
  table.Add(
      "glb_max_px", options.glb_max_px, 64, 16384,
      "Longest side of the pictures inside model.glb, pixels; larger ones are cut into tiles.");
  table.Add(
      "glb_megapixels", options.glb_megapixels, 1, 4096,
      "Of all pictures inside model.glb together; where they have more all are made smaller.");
  table.Add("glb_atlas_px", options.glb_atlas_px, 0, 16384,
            "Side of the pictures in model.glb that small facets share; 0 gives each its own.");
  table.Add("glb_quality", options.glb_quality, 10, 100,
            "JPEG quality of the pictures inside model.glb.");
  table.Add("glb_relief", options.glb_relief,
            "Balconies, reveals and bays as geometry in model.glb; otherwise walls are flat.");
}

}  // namespace stucco
