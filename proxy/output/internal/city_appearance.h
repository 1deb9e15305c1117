// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// What CityJSON calls the appearance of a file: its pictures, and where on them the corners of its
// rings are. It grows with the surfaces that ask for it. `textures` has to outlive it.
class CityAppearance {
 public:
  // `folder`: where the pictures will lie, relative to the file.
  CityAppearance(const TextureSet& textures, std::string folder);

  // A surface's entry in "values" of a geometry's texture. `rings`: corners in the world, as many
  // in each ring as the file has there. For each ring the picture's number and a number into
  // "vertices-texture" for each corner; null alone where the facet has no picture, or one of an
  // earlier model.
  nlohmann::ordered_json ValuesOf(const Facet& facet,
                                  const std::vector<std::vector<Eigen::Vector3d>>& rings);

  // The file's "appearance", whose one theme is called `theme`.
  nlohmann::ordered_json Text(const std::string& theme) const;

  // Those that a surface is painted with, in the order of the file.
  const std::vector<const TexturedFacet*>& pictures() const { return pictures_; }
  // Where the file looks for a picture, relative to itself.
  std::string NameOf(const TexturedFacet& picture) const;
  // Facets whose picture was left out because it does not fit them.
  int outdated() const { return outdated_; }

 private:
  std::map<std::string, const TexturedFacet*> by_id_;
  std::string folder_;
  std::vector<const TexturedFacet*> pictures_;
  std::vector<Eigen::Vector2d> corners_;  // on their picture, v upwards
  int outdated_ = 0;
};

}  // namespace stucco
