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

CityAppearance::CityAppearance(const TextureSet& textures, std::string folder)
    : folder_(std::move(folder)) {
  for (const TexturedFacet& picture : textures.facets) {
    if (!picture.image.empty()) by_id_[picture.id] = &picture;
  }
}

Json CityAppearance::ValuesOf(const Facet& facet,
                              const std::vector<std::vector<Eigen::Vector3d>>& rings) {
  const auto own = by_id_.find(facet.id);
  const bool fits = own != by_id_.end() && FitsFacet(*own->second, facet);
  if (own != by_id_.end() && !fits) ++outdated_;
  if (!fits) return Json(rings.size(), Json::array({nullptr}));
  const TexturedFacet& picture = *own->second;
  const size_t number = pictures_.size();
  pictures_.push_back(&picture);
  Json values = Json::array();
  for (const std::vector<Eigen::Vector3d>& ring : rings) {
    Json entry = Json::array({number});
    for (const Eigen::Vector3d& corner : ring) {
      const Eigen::Vector2d at = OnPicture(picture, corner);
      entry.push_back(corners_.size());
      corners_.emplace_back(Written(at.x()), Written(1 - at.y()));
    }
    values.push_back(std::move(entry));
  }
  return values;
}

std::string CityAppearance::NameOf(const TexturedFacet& picture) const {
  return folder_ + "/" + std::filesystem::path(picture.image).filename().string();
}

Json CityAppearance::Text(const std::string& theme) const {
  Json textures = Json::array(), corners = Json::array();
  for (const TexturedFacet* picture : pictures_) {
    textures.push_back({{"type", "PNG"},
                        {"image", NameOf(*picture)},
                        {"wrapMode", "clamp"},
                        {"textureType", "specific"}});
  }
  for (const Eigen::Vector2d& corner : corners_) corners.push_back({corner.x(), corner.y()});
  Json appearance = {{"default-theme-texture", theme}};
  appearance["textures"] = std::move(textures);
  appearance["vertices-texture"] = std::move(corners);
  return appearance;
}

}  // namespace stucco
