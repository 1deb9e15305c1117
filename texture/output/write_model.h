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

// Writes the whole proxy as model.obj and model.mtl into `folder`, where the pictures are that
// `textures` names: one mesh per facet with the facet's id as its name, in world coordinates less
// `textures.model_offset`, which a comment at the top repeats. Facets without a picture are plain
// grey; texture coordinates follow from a facet's polygon and grid alone. Throws Error
// (kOutOfResource) where the model cannot be written.
void WriteObj(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder);

}  // namespace stucco
