// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

#include "survey/glb.h"
#include "survey/pixels.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"
#include "texture/grid/grid.h"
#include "texture/output/picture_part.h"

namespace stucco {

// What nothing was painted on.
inline constexpr float kUnpaintedGrey = 0.6f;

// World (x, y, z) with z up becomes (x, z, -y), as glTF demands.
Eigen::Isometry3d YUpFromZUp();

// A facet as a mesh of that material, named by its id; without triangles where it has none. With a
// texture its coordinates are those of the facet's own picture.
GlbMesh GlbMeshOf(const Facet& facet, const TexturedFacet* texture,
                  const Eigen::Isometry3d& glb_from_world, int material);

// The same with the relief of its grid as geometry. Requires a grid with relief.
GlbMesh GlbMeshWithRelief(const Facet& facet, const TexelGrid& grid,
                          const Eigen::Isometry3d& glb_from_world, int material);

// Unlit; grey where `texture` is -1.
GlbMaterial GlbMaterialOf(const std::string& name, int texture);

// A part of a facet's picture, which lies in `folder`, area-averaged to a size that is not larger.
// Throws Error (kBadInput).
Image ReadPart(const TexturedFacet& texture, const std::filesystem::path& folder,
               const PicturePart& part, const ImageSize& size);

}  // namespace stucco
