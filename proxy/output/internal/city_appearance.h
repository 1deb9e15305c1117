// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "proxy/output/city_picture.h"
#include "survey/model_look.h"
#include "survey/proxy.h"

namespace stucco {

// What CityJSON calls the appearance of a file: its pictures, and where on them the corners of its
// rings are. It grows with the surfaces that ask for it. Each look is a theme; a facet without a
// picture in a further look has that of the first. `looks` have to outlive it.
class CityAppearance {
 public:
  // `folder`: where the pictures will lie, relative to the file.
  CityAppearance(std::span<const ModelLook> looks, std::string folder);

  // A surface's entries in "values" of a geometry's texture, one a look. `rings`: corners in the
  // world, as many in each ring as the file has there. For each ring the picture's number and a
  // number into "vertices-texture" for each corner; null alone where the facet has no picture, or
  // one of an earlier model.
  std::vector<nlohmann::ordered_json> ValuesOf(
      const Facet& facet, const std::vector<std::vector<Eigen::Vector3d>>& rings);

  // The file's "appearance".
  nlohmann::ordered_json Text() const;

  size_t num_looks() const { return looks_.size(); }
  const std::string& Theme(size_t look) const { return looks_[look].name; }

  // Those that a surface is painted with, in the order of the file: where it is now, and where the
  // file looks for it.
  std::vector<CityPicture> Pictures() const;
  bool is_empty() const { return pictures_.empty(); }
  // Pictures that were left out because they do not fit their facets.
  int outdated() const { return outdated_; }

 private:
  struct Picture {
    size_t look = 0;
    const TexturedFacet* facet = nullptr;
  };

  nlohmann::ordered_json Values(const Picture& picture,
                                const std::vector<std::vector<Eigen::Vector3d>>& rings);
  std::string NameOf(const Picture& picture) const;

  std::span<const ModelLook> looks_;
  std::string folder_;
  std::map<std::string, std::vector<Picture>> by_id_;  // in the order of looks
  std::vector<Picture> pictures_;
  std::vector<Eigen::Vector2d> corners_;  // on their picture, v upwards
  int outdated_ = 0;
};

}  // namespace stucco
