// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/write_glb.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "survey/encode_image.h"
#include "survey/glb.h"
#include "survey/parallel.h"
#include "survey/pixels.h"
#include "texture/output/glb_parts.h"

namespace stucco {
namespace {

// What a facet looks like in one of the looks.
struct LookPicture {
  int look = 0;
  const TexturedFacet* facet = nullptr;
  ImageSize size;  // in the model
  int material = 0;
};

// Those of the first look first.
std::vector<LookPicture> PicturesOf(std::span<const ModelLook> looks) {
  std::vector<LookPicture> pictures;
  for (size_t look = 0; look < looks.size(); ++look) {
    for (const TexturedFacet& facet : looks[look].textures.facets) {
      if (facet.image.empty()) continue;
      pictures.push_back({static_cast<int>(look), &facet, {facet.width_px, facet.height_px}, 0});
    }
  }
  return pictures;
}

void LimitSizes(const GlbOptions& options, std::vector<LookPicture>& pictures) {
  double texels = 0;
  for (LookPicture& picture : pictures) {
    picture.size = ScaledSize(picture.size, options.max_px);
    texels += static_cast<double>(picture.size.width_px) * picture.size.height_px;
  }
  if (texels <= options.most_texels) return;
  const double scale = std::sqrt(options.most_texels / texels);
  for (LookPicture& picture : pictures) {
    const int longest = std::max(picture.size.width_px, picture.size.height_px);
    picture.size = ScaledSize(picture.size, std::max(1, static_cast<int>(scale * longest)));
  }
}

Eigen::Isometry3d TurnToYUp(const Eigen::Vector3d& up) {
  return YUpFromZUp() * Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
}

// `pictures`: of the facet, in the order of looks.
GlbMesh MeshOf(const Facet& facet, const std::vector<const LookPicture*>& pictures,
               const Eigen::Isometry3d& model_from_world) {
  const bool in_first = !pictures.empty() && pictures.front()->look == 0;
  GlbMesh mesh = GlbMeshOf(facet, pictures.empty() ? nullptr : pictures.front()->facet,
                           model_from_world, in_first ? pictures.front()->material : 0);
  if (mesh.primitives.empty()) return mesh;
  for (const LookPicture* picture : pictures) {
    if (picture->look == 0) continue;
    mesh.primitives.front().mappings.push_back({picture->look, picture->material});
  }
  return mesh;
}

}  // namespace

std::string GlbOfLooks(const Proxy& proxy, std::span<const ModelLook> looks,
                       const GlbOptions& options) {
  assert(!looks.empty());
  std::vector<LookPicture> pictures = PicturesOf(looks);
  LimitSizes(options, pictures);
  std::vector<std::string> jpegs(pictures.size());
  ParallelFor(pictures.size(), options.threads, [&](size_t i) {
    const LookPicture& picture = pictures[i];
    const Image scaled =
        ReadScaled(looks[picture.look].folder / picture.facet->image, picture.size);
    jpegs[i] = EncodeImage(scaled, "picture.jpg", options.jpeg_quality);
  });
  GlbModel model;
  model.repeat_textures = false;
  model.offset = looks.front().textures.model_offset;
  model.materials.push_back(GlbMaterialOf("untextured", -1));
  std::map<std::string, std::vector<const LookPicture*>> by_id;
  for (size_t i = 0; i < pictures.size(); ++i) {
    LookPicture& picture = pictures[i];
    picture.material = static_cast<int>(model.materials.size());
    by_id[picture.facet->id].push_back(&picture);
    const std::string name =
        picture.look == 0 ? picture.facet->id
                          : fmt::format("{} {}", picture.facet->id, looks[picture.look].name);
    model.materials.push_back(GlbMaterialOf(name, static_cast<int>(model.textures.size())));
    model.textures.push_back({std::move(jpegs[i]), "image/jpeg"});
  }
  if (looks.size() > 1) {
    for (const ModelLook& look : looks) model.variants.push_back(look.name);
  }
  const Eigen::Isometry3d model_from_world =
      TurnToYUp(proxy.up) * Eigen::Translation3d(-model.offset);
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      GlbMesh mesh = MeshOf(facet, by_id[facet.id], model_from_world);
      if (!mesh.primitives.empty()) model.meshes.push_back(std::move(mesh));
    }
  }
  return GlbBytes(model);
}

}  // namespace stucco
