// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// What is taken off world coordinates in the models, whose numbers are floats of seven digits:
// whole kilometres where the proxy lies more than 10 km from the origin (map coordinates), else
// zero.
Eigen::Vector3d ModelOffset(const Proxy& proxy);

// Both read the pictures named in `textures` from `folder` and write the whole proxy, one mesh per
// facet with the facet's id as its name; facets without a picture are plain grey. Texture
// coordinates follow from a facet's polygon and grid alone. Throws Error (kOutOfResource) where
// the model cannot be written.

// model.obj and model.mtl in `folder`, in world coordinates less `textures.model_offset` (which a
// comment at the top repeats), referring to the pictures.
void WriteObj(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder);

struct GlbOptions {
  int max_px = 4096;  // longest side of a picture
  int jpeg_quality = 90;
  int threads = 1;
  double most_texels = 128e6;  // of all pictures: more than graphics cards hold uncompressed
};

// model.glb in `folder`, self-contained: pictures inside as JPEG, all made smaller by the same
// factor where together they have too many texels, materials unlit (KHR_materials_unlit), y up as
// glTF demands: world (x, y, z) with z up becomes (x, z, -y), after `textures.model_offset` was
// taken off (`asset.extras.offset` repeats it). Where up is not z the model is turned so that up
// becomes y.
void WriteGlb(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder,
              const GlbOptions& options);

}  // namespace stucco
