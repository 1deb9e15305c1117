// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/image.h"
#include "survey/proxy.h"
#include "texture/candidates.h"
#include "texture/colour.h"
#include "texture/grid.h"
#include "texture/photo.h"
#include "texture/photo_cache.h"
#include "texture/quality.h"
#include "texture/texture.h"

namespace stucco {

// What painting one facet needs to know of the survey.
struct PaintScene {
  std::span<const TexturePhoto> photos;
  Obstacles obstacles;
  PhotoCache* cache = nullptr;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

// A first look at a facet over a raster of at most 32 texels a side: who sees it, how fine its
// picture can be, and how bright the photos show it.
struct FacetLook {
  std::vector<Candidate> candidates;  // best first; empty: no photo sees it
  double texel = 0;                   // world units; 0 without candidates
  std::vector<ColourRatio> ratios;    // between candidates; indices are photos
};

FacetLook LookAtFacet(const Facet& facet, const PaintScene& scene, const TextureOptions& options);

// How near things in front of a facet belong to it; distances in proportion to how far the photos
// are from it (0.3 % and 2 %) and to how far its own points are from the plane.
ViewLimits LimitsFor(const Facet& facet, std::span<const TexturePhoto> photos,
                     double max_angle_deg);

struct PaintedFacet {
  TexelGrid grid;
  std::vector<uint8_t> mask;    // 1 inside the facet
  Image picture;                // colours go on smoothly outside the facet
  std::vector<uint8_t> labels;  // 1 + index into `photos`, 255 inpainted, 0 outside or empty
  std::vector<int> photos;      // indices of the survey's photos, most painted first
  double painted = 0;           // shares of the facet's texels
  double inpainted = 0;
  double misregistration_px = -1;  // after alignment, texels; -1: only one photo
  double misregistration_before_px = -1;
  double sharpness = 0;
  AchievedQuality quality;
};

// Paints one facet with its candidates: selection, alignment, composition, filling, measures.
// `gains` are per photo of the survey. No picture where no texel could be painted.
PaintedFacet PaintFacet(const Facet& facet, const FacetLook& look,
                        std::span<const Eigen::Vector3d> gains, const PaintScene& scene,
                        const TextureOptions& options);

}  // namespace stucco
