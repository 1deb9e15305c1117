// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "proxy/output/city_picture.h"
#include "survey/model_look.h"
#include "survey/proxy.h"

namespace stucco {

// CityJSON 2.0 (https://www.cityjson.org/specs/2.0.1/): each building with one BuildingPart, whose
// geometry is a Solid when it is watertight and a MultiSurface otherwise, with semantic surfaces
// that carry facet id, facade id and figures; the ground as LandUse. The frame is turned so that up
// is z. No reference system is stated: coordinates are local.
std::string CityJsonText(const Proxy& proxy);

struct TexturedCity {
  std::string text;
  std::vector<CityPicture> pictures;  // in the order of "textures"; none: nothing is painted
  int outdated = 0;                   // pictures left out because they are of an earlier model
};

// The same file with the pictures of its facets, in `folder` beside it ("castle_appearance"; those
// of further looks in folders of their names in it): "textures", "vertices-texture" (v upwards)
// and, in each geometry that shows a picture, "texture" with a theme for each of `looks`, of which
// there must be one; the first is the default. In a further look a facet without a picture has that
// of the first. Where nothing is painted the text is that of CityJsonText. Pictures are PNG.
TexturedCity TexturedCityJson(const Proxy& proxy, std::span<const ModelLook> looks,
                              const std::string& folder);

}  // namespace stucco
