// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/internal/city_appearance.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "survey/facet_picture.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

// CityJSON wants [0, 1], and corners may lie a rounding beyond the picture's edge. A seventh digit
// is less than a hundredth of a texel of the largest picture.
double Written(double share) {
  constexpr double kDigits = 1e7;
  return std::round(std::clamp(share, 0.0, 1.0) * kDigits) / kDigits;
}

}  // namespace

CityAppearance::CityAppearance(std::span<const ModelLook> looks, std::string folder)
    : looks_(looks), folder_(std::move(folder)) {
  for (size_t look = 0; look < looks.size(); ++look) {
    for (const TexturedFacet& facet : looks[look].textures.facets) {
      if (!facet.image.empty()) by_id_[facet.id].push_back({look, &facet});
    }
  }
}

std::vector<Json> CityAppearance::ValuesOf(const Facet& facet,
                                           const std::vector<std::vector<Eigen::Vector3d>>& rings) {
  std::vector<Json> values(looks_.size(), Json(rings.size(), Json::array({nullptr})));
  const auto own = by_id_.find(facet.id);
  if (own == by_id_.end()) return values;
  for (const Picture& picture : own->second) {
    if (!FitsFacet(*picture.facet, facet)) {
      ++outdated_;
      continue;
    }
    values[picture.look] = Values(picture, rings);
    if (picture.look == 0) std::fill(values.begin() + 1, values.end(), values.front());
  }
  return values;
}

Json CityAppearance::Values(const Picture& picture,
                            const std::vector<std::vector<Eigen::Vector3d>>& rings) {
  const size_t number = pictures_.size();
  pictures_.push_back(picture);
  Json values = Json::array();
  for (const std::vector<Eigen::Vector3d>& ring : rings) {
    Json entry = Json::array({number});
    for (const Eigen::Vector3d& corner : ring) {
      const Eigen::Vector2d at = OnPicture(*picture.facet, corner);
      entry.push_back(corners_.size());
      corners_.emplace_back(Written(at.x()), Written(1 - at.y()));
    }
    values.push_back(std::move(entry));
  }
  return values;
}

std::string CityAppearance::NameOf(const Picture& picture) const {
  const std::string file = std::filesystem::path(picture.facet->image).filename().string();
  const std::string& look = looks_[picture.look].name;
  return picture.look == 0 ? folder_ + "/" + file : folder_ + "/" + look + "/" + file;
}

std::vector<CityPicture> CityAppearance::Pictures() const {
  std::vector<CityPicture> all;
  all.reserve(pictures_.size());
  for (const Picture& picture : pictures_) {
    all.push_back({looks_[picture.look].folder / picture.facet->image, NameOf(picture)});
  }
  return all;
}

Json CityAppearance::Text() const {
  Json textures = Json::array(), corners = Json::array();
  for (const Picture& picture : pictures_) {
    textures.push_back({{"type", "PNG"},
                        {"image", NameOf(picture)},
                        {"wrapMode", "clamp"},
                        {"textureType", "specific"}});
  }
  for (const Eigen::Vector2d& corner : corners_) corners.push_back({corner.x(), corner.y()});
  Json appearance = {{"default-theme-texture", Theme(0)}};
  appearance["textures"] = std::move(textures);
  appearance["vertices-texture"] = std::move(corners);
  return appearance;
}

}  // namespace stucco
