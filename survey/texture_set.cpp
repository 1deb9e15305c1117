// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/texture_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "survey/error.h"
#include "survey/internal/json.h"

namespace stucco {

template <typename Archive, internal::Is<TexturedFacet> T>
static void Fields(Archive& archive, T& facet) {
  archive.Required("id", facet.id);
  archive.Required("image", facet.image);
  archive.Optional("label_image", facet.label_image);
  archive.Optional("orthophoto", facet.orthophoto);
  archive.Required("width_px", facet.width_px);
  archive.Required("height_px", facet.height_px);
  archive.Required("metres_per_texel", facet.metres_per_texel);
  archive.Optional("wanted_metres_per_texel", facet.wanted_metres_per_texel);
  archive.Required("origin", facet.origin);
  archive.Required("u_axis", facet.u_axis);
  archive.Required("v_axis", facet.v_axis);
  archive.Required("photos", facet.photos);
  archive.Optional("planned_photos", facet.planned_photos);
  archive.Required("painted", facet.painted);
  archive.Required("inpainted", facet.inpainted);
  archive.Required("misregistration_px", facet.misregistration_px);
  archive.Optional("gsd_m", facet.gsd_m);
  archive.Optional("sharpness", facet.sharpness);
  archive.Optional("q_s", facet.q_s);
  archive.Optional("q_d", facet.q_d);
  archive.Optional("q_u", facet.q_u);
  archive.Optional("q_c", facet.q_c);
  archive.Optional("gains", facet.gains);
}

template <typename Archive, internal::Is<TextureSet> T>
static void Fields(Archive& archive, T& textures) {
  archive.Required("facets", textures.facets);
  archive.Optional("model_glb", textures.model_glb);
  archive.Optional("model_obj", textures.model_obj);
  archive.Optional("model_offset", textures.model_offset);
}

TextureSet ReadTextureSet(const std::filesystem::path& path) {
  TextureSet textures = internal::ReadJsonFile<TextureSet>(path);
  for (const TexturedFacet& facet : textures.facets) {
    if (facet.width_px >= 0 && facet.height_px >= 0 && facet.metres_per_texel >= 0) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: facet {} has a negative size", path.string(), facet.id));
  }
  return textures;
}

void WriteTextureSet(const TextureSet& textures, const std::filesystem::path& path) {
  assert(std::ranges::all_of(textures.facets, [](const TexturedFacet& facet) {
    return !facet.id.empty() && facet.metres_per_texel >= 0;
  }));
  internal::WriteJsonFile(textures, path);
}

}  // namespace stucco
