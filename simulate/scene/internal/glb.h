// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "simulate/scene/scene.h"
#include "survey/glb.h"
#include "survey/image.h"

namespace stucco::simulate::internal {

// JPEG where the picture has three channels, PNG with alpha.
GlbTexture EncodeForGlb(const Image& image);

// Writes a scene whose textures are given encoded; `scene.textures` is not looked at. An element is
// a node and a mesh of its name with a primitive per material; gloss is 1 - roughness.
void WriteGlbFile(const Scene& scene, std::vector<GlbTexture> textures,
                  const std::filesystem::path& path);

}  // namespace stucco::simulate::internal
