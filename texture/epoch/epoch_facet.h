// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "survey/epoch.h"
#include "survey/proxy.h"
#include "survey/survey_photo.h"
#include "survey/texture_set.h"
#include "texture/epoch/changed_places.h"
#include "texture/epoch/changes.h"
#include "texture/light/colour.h"
#include "texture/options/texture_options.h"
#include "texture/painting/facet_unit.h"

namespace stucco {

// The picture that a texture stage left of a facet, whose files lie below `folder`; nothing where
// it has none. Throws Error (kBadInput) where they are not what textures.json says.
std::optional<FacetPicture> ReadPicture(const TexturedFacet& facet,
                                        const std::filesystem::path& folder);

// The picture in the files of a facet that was just painted; nothing where nothing was.
std::optional<FacetPicture> PictureOf(const FacetFiles& files);

// How much brighter the picture is now than before, over texels that photos painted in both.
std::optional<ColourRatio> BrightnessRatio(const FacetPicture& before, const FacetPicture& after);

// A facet then and now.
struct EpochFacetInput {
  const Facet& facet;
  const TexturedFacet& old;  // as the texture stage left it
  std::optional<FacetPicture> before;
  const FacetFiles& painted;                        // from new photos alone, on the same grid
  Eigen::Vector3d level = Eigen::Vector3d::Ones();  // brings new colours to the old ones
  std::shared_ptr<const Relief> relief;             // that both pictures were painted on
};

// What the facet's picture is chosen by and made of, the same for all facets.
struct EpochStyle {
  std::string epoch;
  ReplaceMode replace = ReplaceMode::kAuto;
  std::span<const SurveyPhoto> photos;              // new ones
  std::map<std::string, Eigen::Vector3d> taken_at;  // the survey's photos, by path
  const TextureOptions& options;
};

struct EpochPicture {
  EpochFacet found;
  std::optional<FacetFiles> files;    // nothing: the facet keeps its picture
  std::vector<PlacePictures> places;  // by place of `found`, whose names are left open
};

// Compares, decides and puts together.
EpochPicture MakeEpochPicture(EpochFacetInput input, const EpochStyle& style);

}  // namespace stucco
