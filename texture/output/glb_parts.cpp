// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/glb_parts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "survey/facet_picture.h"
#include "survey/image.h"
#include "survey/triangulate.h"
#include "texture/output/relief_mesh.h"

namespace stucco {
namespace {

// A picture, area-averaged to a size that is not larger.
Image ReadScaled(const std::filesystem::path& path, const ImageSize& size) {
  Image full = ReadImage(path);
  if (full.width_px == size.width_px && full.height_px == size.height_px) return full;
  Image scaled{size.width_px, size.height_px, full.channels, {}};
  scaled.data.resize(static_cast<size_t>(size.width_px) * size.height_px * full.channels);
  const int type = CV_8UC(full.channels);
  cv::Mat to(size.height_px, size.width_px, type, scaled.data.data());
  cv::resize(cv::Mat(full.height_px, full.width_px, type, full.data.data()), to, to.size(), 0, 0,
             cv::INTER_AREA);
  return scaled;
}

}  // namespace

Eigen::Isometry3d YUpFromZUp() {
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return turn;
}

GlbMesh GlbMeshOf(const Facet& facet, const TexturedFacet* texture,
                  const Eigen::Isometry3d& glb_from_world, int material) {
  GlbMesh mesh{facet.id, {}};
  const FacetTriangles shape = TriangulateFacet(facet);
  if (shape.triangles.empty()) return mesh;
  GlbPrimitive& primitive = mesh.primitives.emplace_back();
  primitive.material = material;
  const Eigen::Vector3f normal = (glb_from_world.linear() * facet.normal).cast<float>();
  for (const Eigen::Vector3d& vertex : shape.vertices) {
    primitive.positions.emplace_back((glb_from_world * vertex).cast<float>());
    primitive.normals.push_back(normal);
    if (texture) primitive.uv.emplace_back(OnPicture(*texture, vertex).cast<float>());
  }
  for (const auto& triangle : shape.triangles) {
    primitive.indices.insert(primitive.indices.end(), triangle.begin(), triangle.end());
  }
  return mesh;
}

GlbMesh GlbMeshWithRelief(const Facet& facet, const TexelGrid& grid,
                          const Eigen::Isometry3d& glb_from_world, int material) {
  GlbMesh mesh{facet.id, {}};
  const ReliefMesh shape = MeshWithRelief(facet, grid);
  if (shape.triangles.empty()) return mesh;
  GlbPrimitive& primitive = mesh.primitives.emplace_back();
  primitive.material = material;
  const Eigen::Array2d size(grid.width, grid.height);
  for (const ReliefMesh::Vertex& vertex : shape.vertices) {
    primitive.positions.emplace_back((glb_from_world * vertex.position).cast<float>());
    primitive.normals.emplace_back((glb_from_world.linear() * vertex.normal).cast<float>());
    primitive.uv.emplace_back((vertex.texel.array() / size).cast<float>());
  }
  for (const auto& triangle : shape.triangles) {
    primitive.indices.insert(primitive.indices.end(), triangle.begin(), triangle.end());
  }
  return mesh;
}

GlbMaterial GlbMaterialOf(const std::string& name, int texture) {
  return {.name = name,
          .colour = Eigen::Vector3f::Constant(texture < 0 ? kUnpaintedGrey : 1.0f),
          .texture = texture,
          .unlit = true,
          .two_sided = false};
}

Image ReadPart(const TexturedFacet& texture, const std::filesystem::path& folder,
               const PicturePart& part, const ImageSize& size) {
  const std::filesystem::path path = folder / texture.image;
  if (IsWhole(part)) return ReadScaled(path, size);
  const ImageSize full = SizeOf(part, {texture.width_px, texture.height_px});
  const double scale = static_cast<double>(size.width_px) / full.width_px;
  const Image whole = ReadScaled(
      path, {std::max(size.width_px, static_cast<int>(std::lround(scale * texture.width_px))),
             std::max(size.height_px, static_cast<int>(std::lround(scale * texture.height_px)))});
  return Cut(whole, part, size);
}

}  // namespace stucco
