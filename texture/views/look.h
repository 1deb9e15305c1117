// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "survey/proxy.h"
#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/light/colour.h"
#include "texture/options/texture_options.h"
#include "texture/photos/photo_cache.h"
#include "texture/views/candidates.h"

namespace stucco {

// What painting facets needs to know of the survey.
struct PaintScene {
  SightScene sights;
  PhotoCache* cache = nullptr;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  bool metric = false;  // world units are metres
};

// A first look at a facet over a coarse raster: who sees it, how fine its picture can be, and how
// bright the photos show it.
struct FacetLook {
  std::vector<Candidate> candidates;  // best first; empty: no photo sees it
  double texel = 0;                   // world units; 0 without candidates
  std::vector<ColourRatio> ratios;    // between candidates; indices are photos
  ViewLimits limits;                  // follow from where all photos of the survey are
  // The grid to paint on, with its relief, where one is given; else it follows from `texel`.
  std::optional<TexelGrid> grid;
};

FacetLook LookAtFacet(const Facet& facet, const PaintScene& scene, const TextureOptions& options);

// How near things in front of a facet belong to it; distances in proportion to how far the photos
// are from it (0.3 % and 2 %) and to how far its own points are from the plane.
ViewLimits LimitsFor(const Facet& facet, std::span<const SurveyPhoto> photos, double max_angle_deg);

// The photos that may see part of a facet, by their places alone: in front of its plane, not too
// oblique for all of it, and the facet's bounding sphere reaches into their view cone.
std::vector<int> PhotosThatMaySee(const Facet& facet, std::span<const SurveyPhoto> photos,
                                  double max_angle_deg);

// The raster of the first look, for the photos of PhotosThatMaySee: about a thousand texels however
// thin the facet is, more where photos show only small parts of it.
TexelGrid LookRaster(const Facet& facet, const PaintScene& scene, std::span<const int> photos);

// The colours that a photo shows on a raster, 3 per texel, from a reduced copy.
std::vector<float> SampleRaster(const SurveyPhoto& photo, const TexelGrid& raster,
                                PhotoCache& cache);

}  // namespace stucco
