// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "simulate/render/renderer.h"
#include "survey/pose.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco::evaluate {

// What a result says of a facade: light on the texels of a plane in the scene's frame.
struct FacadePicture {
  simulate::PicturePlane plane;
  std::vector<float> rgb;      // 3 per texel, by the camera's curve
  std::vector<uint8_t> known;  // painted from photos
};

// Reads a facet's picture and labels from the texture folder; inpainted texels are not known.
// Without labels every texel is. Throws Error (kBadInput): missing, damaged, of another size than
// textures.json says.
FacadePicture ReadFacadePicture(const TexturedFacet& facet,
                                const std::filesystem::path& texture_folder,
                                const Similarity& truth_from_world);

// Texels `factor` >= 1 times as large, not only by whole numbers: means of light. A texel is known
// where everything in it is. What is left over at the right and lower end goes.
FacadePicture Coarsened(const FacadePicture& picture, double factor);

// Only texels inside the facet's outline, seen at right angles to the picture's plane, stay known.
void KeepInside(const Facet& facet_in_scene, FacadePicture& picture);

// The smallest rectangle that holds every known texel; no texels where none is known.
FacadePicture Cropped(const FacadePicture& picture);

// The middle of a picture, at most so many texels wide and high.
FacadePicture Middle(const FacadePicture& picture, int side_px);

size_t CountKnown(const FacadePicture& picture);

}  // namespace stucco::evaluate
