// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "survey/texture_set.h"
#include "texture/grid/relief_file.h"
#include "texture/light/solve_light.h"
#include "texture/options/texture_options.h"
#include "texture/painting/paint.h"
#include "texture/views/input.h"

namespace stucco {

// The two kinds of checkpoints of this stage: the first look at a facet and its finished picture,
// as bytes, and the keys that name everything they depend on.

std::string PackLook(const FacetLook& look);
// Throws Error (kBadInput) when the bytes are not from PackLook.
FacetLook UnpackLook(const std::string& bytes);

// A finished facet: what textures.json says about it, and its files.
struct FacetFiles {
  TexturedFacet facet;  // without paths; gains and photos filled
  double misregistration_before_px = -1;
  std::string texture_png;  // empty: nothing painted
  std::string label_png;
  std::string orthophoto_png;  // with transparent surroundings
  ReliefFiles relief;
};

FacetFiles MakeFacetFiles(const Facet& facet, const PaintedFacet& painted,
                          std::span<const SurveyPhoto> photos,
                          std::span<const Eigen::Vector3d> gains, bool orthophoto);

std::string PackFiles(const FacetFiles& files);
FacetFiles UnpackFiles(const std::string& bytes);

std::string LookKey(const Facet& facet, const TextureInput& input, const TextureOptions& options);
std::string FilesKey(const Facet& facet, const FacetLook& look, const TextureInput& input,
                     const PhotosLight& light, const TextureOptions& options);

}  // namespace stucco
