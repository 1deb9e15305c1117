// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// CityJSON 2.0 (https://www.cityjson.org/specs/2.0.1/): each building with one BuildingPart, whose
// geometry is a Solid when it is watertight and a MultiSurface otherwise, with semantic surfaces
// that carry facet id, facade id and figures; the ground as LandUse. The frame is turned so that up
// is z. No reference system is stated: coordinates are local.
std::string CityJsonText(const Proxy& proxy);

// The theme under which surfaces have the survey's own pictures.
inline constexpr char kCityTheme[] = "survey";

// A picture that a CityJSON file names.
struct CityPicture {
  std::string image;  // where it is now: TexturedFacet::image
  std::string name;   // where the file looks for it, relative to itself
};

struct TexturedCity {
  std::string text;
  std::vector<CityPicture> pictures;  // in the order of "textures"; none: nothing is painted
  int outdated = 0;  // facets without their picture because it is of an earlier model
};

// The same file with the pictures of its facets, in `folder` beside it ("castle_appearance"):
// "textures", "vertices-texture" (v upwards) and, in each geometry that shows a picture, "texture"
// with one theme. Where there is none the text is that of CityJsonText. Pictures are PNG.
TexturedCity TexturedCityJson(const Proxy& proxy, const TextureSet& textures,
                              const std::string& folder);

}  // namespace stucco
