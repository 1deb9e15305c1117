// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// Both read the pictures named in `textures` from `folder` and write the whole proxy, one mesh per
// facet with the facet's id as its name; facets without a picture are plain grey. Texture
// coordinates follow from a facet's polygon and grid alone. Throws Error (kOutOfResource) where
// the model cannot be written.

// model.obj and model.mtl in `folder`, in world coordinates, referring to the pictures.
void WriteObj(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder);

// model.glb in `folder`, self-contained: pictures no larger than `max_px` inside as JPEG, materials
// unlit (KHR_materials_unlit), y up as glTF demands: world (x, y, z) with z up becomes (x, z, -y).
// Where up is not z the model is turned so that up becomes y.
void WriteGlb(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder,
              int max_px, int jpeg_quality);

}  // namespace stucco
