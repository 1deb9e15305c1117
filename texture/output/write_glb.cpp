// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/write_glb.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "survey/encode_image.h"
#include "survey/glb.h"
#include "survey/image.h"
#include "survey/parallel.h"
#include "survey/pixels.h"
#include "texture/grid/grid.h"
#include "texture/grid/relief_file.h"
#include "texture/output/atlas.h"
#include "texture/output/glb_parts.h"
#include "texture/output/picture_part.h"

namespace stucco {
namespace {

// What a facet, or a tile of a large one, looks like in one of the looks.
struct LookPicture {
  int look = 0;
  const TexturedFacet* facet = nullptr;
  PicturePart part = kWholePicture;
  ImageSize size;  // in the model
  // Where it is: the sheet, and the place in it.
  size_t sheet = 0;
  Eigen::Vector2i place = Eigen::Vector2i::Zero();
};

// A picture of the model: of one facet, or of several side by side.
struct Sheet {
  std::string name;
  std::vector<size_t> pictures;
  AtlasLayout layout;
};

// A picture of that size, or tiles of it of which no side is longer than `most_px`.
void AddTiles(const PicturePart& part, const ImageSize& picture, int most_px,
              std::vector<PicturePart>& tiles) {
  const ImageSize size = SizeOf(part, picture);
  if (std::max(size.width_px, size.height_px) <= most_px) {
    tiles.push_back(part);
    return;
  }
  const auto [first, second] = Halved(part, picture);
  AddTiles(first, picture, most_px, tiles);
  AddTiles(second, picture, most_px, tiles);
}

// By facet, the largest of its pictures: two epochs may each have given it its first one.
std::map<std::string, ImageSize> LargestSizes(std::span<const ModelLook> looks) {
  std::map<std::string, ImageSize> sizes;
  for (const ModelLook& look : looks) {
    for (const TexturedFacet& facet : look.textures.facets) {
      ImageSize& size = sizes[facet.id];
      if (facet.width_px > size.width_px) size = {facet.width_px, facet.height_px};
    }
  }
  return sizes;
}

// Those of the first look first; of one facet the same tiles in each.
std::vector<LookPicture> PicturesOf(std::span<const ModelLook> looks, int most_px) {
  const std::map<std::string, ImageSize> largest = LargestSizes(looks);
  std::vector<LookPicture> pictures;
  for (size_t look = 0; look < looks.size(); ++look) {
    for (const TexturedFacet& facet : looks[look].textures.facets) {
      if (facet.image.empty()) continue;
      const ImageSize size{facet.width_px, facet.height_px};
      std::vector<PicturePart> tiles;
      AddTiles(kWholePicture, largest.at(facet.id), most_px, tiles);
      for (const PicturePart& part : tiles) {
        pictures.push_back({static_cast<int>(look), &facet, part, SizeOf(part, size)});
      }
    }
  }
  return pictures;
}

void LimitSizes(const GlbOptions& options, std::vector<LookPicture>& pictures) {
  double texels = 0;
  for (const LookPicture& picture : pictures) {
    texels += static_cast<double>(picture.size.width_px) * picture.size.height_px;
  }
  if (texels <= options.most_texels) return;
  const double scale = std::sqrt(options.most_texels / texels);
  for (LookPicture& picture : pictures) {
    const int longest = std::max(picture.size.width_px, picture.size.height_px);
    picture.size = ScaledSize(picture.size, std::max(1, static_cast<int>(scale * longest)));
  }
}

// Says in each picture where it is.
std::vector<Sheet> LayOut(std::span<const ModelLook> looks, int atlas_px,
                          std::vector<LookPicture>& pictures) {
  std::map<std::string, std::set<int>> looks_of;
  for (const LookPicture& picture : pictures) looks_of[picture.facet->id].insert(picture.look);
  std::vector<Sheet> sheets;
  std::vector<size_t> sharing;
  std::vector<ImageSize> sizes;
  for (size_t i = 0; i < pictures.size(); ++i) {
    const auto& [look, facet, part, size, sheet, place] = pictures[i];
    const int side = std::max(size.width_px, size.height_px) + 2 * kAtlasGutter_px;
    if (looks_of[facet->id].size() == 1 && side <= atlas_px) {
      sharing.push_back(i);
      sizes.push_back(size);
      continue;
    }
    pictures[i].sheet = sheets.size();
    sheets.push_back({look == 0 ? facet->id : fmt::format("{} {}", facet->id, looks[look].name),
                      {i},
                      {size, {Eigen::Vector2i::Zero()}}});
  }
  int number = 0;
  for (PackedAtlas& atlas : PackAtlases(sizes, atlas_px)) {
    Sheet sheet{fmt::format("atlas {}", ++number), {}, std::move(atlas.layout)};
    for (size_t k = 0; k < atlas.pictures.size(); ++k) {
      const size_t i = sharing[atlas.pictures[k]];
      pictures[i].sheet = sheets.size();
      pictures[i].place = sheet.layout.places[k];
      sheet.pictures.push_back(i);
    }
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

Image ReadPicture(const LookPicture& picture, std::span<const ModelLook> looks) {
  return ReadPart(*picture.facet, looks[picture.look].folder, picture.part, picture.size);
}

std::string JpegOf(const Sheet& sheet, std::span<const LookPicture> pictures,
                   std::span<const ModelLook> looks, int quality) {
  const auto read = [&](size_t k) { return ReadPicture(pictures[sheet.pictures[k]], looks); };
  const ImageSize& size = pictures[sheet.pictures[0]].size;
  const bool is_alone = sheet.layout.size.width_px == size.width_px;
  return EncodeImage(is_alone ? read(0) : PaintAtlas(sheet.layout, read), "picture.jpg", quality);
}

Eigen::Isometry3d TurnToYUp(const Eigen::Vector3d& up) {
  return YUpFromZUp() * Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
}

// The material of a sheet: after the grey one.
int MaterialOf(const LookPicture& picture) {
  return static_cast<int>(picture.sheet) + 1;
}

// The relief of a facet as its first look has it; none where it is flat.
std::shared_ptr<const Relief> ReliefOf(const LookPicture& picture,
                                       std::span<const ModelLook> looks) {
  const std::filesystem::path image = picture.facet->image;
  return ReadRelief(looks[picture.look].folder, image.stem().string());
}

// What of a facet's mesh, with coordinates of its whole picture, one of its pictures is on.
// `looks`: those of this place, in the order of looks, all alike in size and place.
GlbPrimitive PrimitiveOf(const GlbPrimitive& whole, std::span<const LookPicture* const> looks,
                         std::span<const Sheet> sheets) {
  const LookPicture& first = *looks.front();
  GlbPrimitive primitive = IsWhole(first.part) ? whole : ClippedTo(first.part, whole);
  primitive.material = first.look == 0 ? MaterialOf(first) : 0;
  for (Eigen::Vector2f& uv : primitive.uv) {
    uv = InAtlas(uv, first.size, first.place, sheets[first.sheet].layout.size);
  }
  for (const LookPicture* picture : looks) {
    if (picture->look > 0) primitive.mappings.push_back({picture->look, MaterialOf(*picture)});
  }
  return primitive;
}

// `pictures`: of the facet, in the order of looks, the same tiles in each. Flat where there is no
// relief.
GlbMesh MeshOf(const Facet& facet, const std::vector<const LookPicture*>& pictures,
               std::shared_ptr<const Relief> relief, std::span<const Sheet> sheets,
               const Eigen::Isometry3d& model_from_world) {
  if (pictures.empty()) return GlbMeshOf(facet, nullptr, model_from_world, 0);
  const TexturedFacet& texture = *pictures.front()->facet;
  TexelGrid grid = GridOf(texture, facet);
  grid.relief = std::move(relief);
  GlbMesh mesh = grid.relief ? GlbMeshWithRelief(facet, grid, model_from_world, 0)
                             : GlbMeshOf(facet, &texture, model_from_world, 0);
  if (mesh.primitives.empty()) return mesh;
  const GlbPrimitive whole = std::move(mesh.primitives.front());
  mesh.primitives.clear();
  for (const LookPicture* tile : pictures) {
    if (tile->look != pictures.front()->look) break;
    std::vector<const LookPicture*> looks;
    std::ranges::copy_if(pictures, std::back_inserter(looks), [&](const LookPicture* picture) {
      return picture->part.isApprox(tile->part, 0);
    });
    GlbPrimitive primitive = PrimitiveOf(whole, looks, sheets);
    if (!primitive.indices.empty()) mesh.primitives.push_back(std::move(primitive));
  }
  return mesh;
}

}  // namespace

int EncodingThreads(std::span<const ModelLook> looks, int atlas_px, uint64_t bytes, int threads) {
  constexpr uint64_t kBytesPerTexel = 9;  // decoded and turned round
  const auto side = static_cast<uint64_t>(atlas_px);
  uint64_t largest = std::max<uint64_t>(1, side * side);
  for (const ModelLook& look : looks) {
    for (const TexturedFacet& facet : look.textures.facets) {
      largest = std::max(
          largest, static_cast<uint64_t>(facet.width_px) * static_cast<uint64_t>(facet.height_px));
    }
  }
  const uint64_t fit = std::max<uint64_t>(1, bytes / (kBytesPerTexel * largest));
  return static_cast<int>(std::min<uint64_t>(fit, std::max(1, threads)));
}

std::string GlbOfLooks(const Proxy& proxy, std::span<const ModelLook> looks,
                       const GlbOptions& options) {
  assert(!looks.empty());
  std::vector<LookPicture> pictures = PicturesOf(looks, options.max_px);
  LimitSizes(options, pictures);
  const std::vector<Sheet> sheets = LayOut(looks, options.atlas_px, pictures);
  GlbModel model;
  model.textures.resize(sheets.size());
  ParallelFor(sheets.size(), options.threads, [&](size_t i) {
    model.textures[i] = {JpegOf(sheets[i], pictures, looks, options.jpeg_quality), "image/jpeg"};
  });
  model.repeat_textures = false;
  model.offset = looks.front().textures.model_offset;
  model.materials.push_back(GlbMaterialOf("untextured", -1));
  for (size_t i = 0; i < sheets.size(); ++i) {
    model.materials.push_back(GlbMaterialOf(sheets[i].name, static_cast<int>(i)));
  }
  std::map<std::string, std::vector<const LookPicture*>> by_id;
  for (const LookPicture& picture : pictures) by_id[picture.facet->id].push_back(&picture);
  if (looks.size() > 1) {
    for (const ModelLook& look : looks) model.variants.push_back(look.name);
  }
  const Eigen::Isometry3d model_from_world =
      TurnToYUp(proxy.up) * Eigen::Translation3d(-model.offset);
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      const auto& of_facet = by_id[facet.id];
      const bool has_relief = options.relief && !of_facet.empty();
      auto relief = has_relief ? ReliefOf(*of_facet.front(), looks) : nullptr;
      GlbMesh mesh = MeshOf(facet, of_facet, std::move(relief), sheets, model_from_world);
      if (!mesh.primitives.empty()) model.meshes.push_back(std::move(mesh));
    }
  }
  return GlbBytes(model);
}

}  // namespace stucco
