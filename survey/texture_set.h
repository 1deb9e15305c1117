// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace stucco {

// One facet's rectified picture and what is known about it. Texel (column c, row r) has its centre
// at world point origin + (c + 0.5) * metres_per_texel * u_axis + (r + 0.5) * metres_per_texel *
// v_axis.
struct TexturedFacet {
  std::string id;
  std::string image;  // relative to texture/: "textures/C0001_W03.png"; empty: nothing painted
  std::string label_image;  // which photo painted a texel: 1-based index into `photos`, 255 =
                            // inpainted, 0 = outside
  std::string orthophoto;   // "orthophotos/C0001_W03.png"; empty for none
  int width_px = 0;
  int height_px = 0;
  double metres_per_texel = 0;         // in world units when the frame is not metric
  double wanted_metres_per_texel = 0;  // what the photos are worth; smaller where the picture had
                                       // to be limited; 0: not known
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d u_axis = Eigen::Vector3d::UnitX();  // unit, to the right
  Eigen::Vector3d v_axis = Eigen::Vector3d::UnitY();  // unit, downwards in the picture
  std::vector<std::string> photos;                    // paths, most painted first
  std::vector<std::string> planned_photos;            // those of them meant for its facade
  double painted = 0;              // share of the facet's area painted from photos
  double inpainted = 0;            // share filled by inpainting
  double misregistration_px = -1;  // median between overlapping photos, texels; -1: only one photo
  double gsd_m = 0;                // median size of a photo pixel on the facet, world units
  double sharpness = 0;            // variance of the Laplacian of the painted texels
  // Achieved quality, design terms in [0, 1]: frontality and consistency, closeness, few photos,
  // coverage.
  double q_s = 0, q_d = 0, q_u = 0, q_c = 0;
  std::map<std::string, double> gains;  // photo path -> applied colour gain (mean of channels)
};

struct TextureSet {
  std::vector<TexturedFacet> facets;
  std::string model_glb;  // "model.glb"
  std::string model_obj;  // "model.obj"
  // What was taken off the world's coordinates in the models, whose numbers have seven digits.
  Eigen::Vector3d model_offset = Eigen::Vector3d::Zero();
};

// texture/textures.json; the names in it are fixed (docs/formats.md). Throws Error (kBadInput).
// Writing requires facets with ids, and texels of no negative size.
TextureSet ReadTextureSet(const std::filesystem::path& path);
void WriteTextureSet(const TextureSet& textures, const std::filesystem::path& path);

}  // namespace stucco
