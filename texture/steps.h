// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "survey/stage.h"
#include "survey/texture_set.h"
#include "texture/light/solve_light.h"
#include "texture/options/texture_options.h"
#include "texture/painting/facet_unit.h"
#include "texture/views/input.h"
#include "texture/views/look.h"
#include "texture/views/visibility.h"

namespace stucco {

// Steps that painting a survey and repainting it with other photos share.

// Facets with an area, in the order of the proxy.
std::vector<const Facet*> FacetsToPaint(const Proxy& proxy, bool ground);

// By photo; empty without a cloud.
std::vector<NearestPoints> SplatAll(const TextureInput& input, const StageContext& context);

// By facet; checkpointed.
std::vector<FacetLook> LookAtAll(const std::vector<const Facet*>& facets, const TextureInput& input,
                                 const PaintScene& scene, const TextureOptions& options,
                                 const StageContext& context);

// What makes the photos agree with each other; says where lenses darken their corners.
PhotosLight LightFrom(const std::vector<FacetLook>& looks, std::span<const SurveyPhoto> photos,
                      Progress& progress);

// The photos as painting takes them, in the light of their middle.
PhotoCache EvenPhotos(std::span<const SurveyPhoto> photos, const PhotosLight& light,
                      const StageContext& context);

// Calls work(i) for every facet, once each, on all threads: of those that fit beside each other
// (`bytes`, by facet, of the memory beside the photo cache) the one with most first, since it takes
// longest. One that needs more than there is goes alone.
void ForEachFacet(std::span<const uint64_t> bytes, const StageContext& context,
                  const std::function<void(size_t)>& work);

// Writes a facet's files, called `name`, below `out` and fills in their paths.
TexturedFacet StoreFacet(FacetFiles files, const Facet& facet, const std::string& name,
                         const TextureInput& input, const std::filesystem::path& out);

// model.obj and model.glb below `context.out` from the pictures there; their names and offset go
// into `textures`.
void WriteModels(const Proxy& proxy, const TextureOptions& options, const StageContext& context,
                 TextureSet& textures);

}  // namespace stucco
