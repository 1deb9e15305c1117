// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Core>
#include <limits>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "simulate/scene/internal/glb.h"
#include "simulate/scene/scene_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/parallel.h"

namespace stucco::simulate {
namespace internal {
namespace {

constexpr int kJpegQuality = 93;

// The vertices of some triangles, and the triangles in terms of those.
GlbPrimitive PrimitiveOf(const Scene& scene, int material, const std::vector<int>& triangles) {
  GlbPrimitive primitive;
  primitive.material = material;
  std::map<int, uint32_t> index_of;
  for (const int triangle : triangles) {
    for (const int vertex : scene.triangles[triangle]) {
      const auto [known, is_new] =
          index_of.emplace(vertex, static_cast<uint32_t>(primitive.positions.size()));
      if (is_new) {
        const Eigen::Vector3f& p = scene.positions[vertex];
        primitive.positions.emplace_back(p.x(), p.z(), -p.y());
        primitive.uv.push_back(scene.uv[vertex]);
      }
      primitive.indices.push_back(known->second);
    }
  }
  return primitive;
}

std::vector<GlbMesh> MeshesOf(const Scene& scene) {
  std::vector<std::map<int, std::vector<int>>> parts(scene.elements.size());
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    parts[scene.elements_of[i]][scene.materials_of[i]].push_back(static_cast<int>(i));
  }
  std::vector<GlbMesh> meshes;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    GlbMesh& mesh = meshes.emplace_back();
    mesh.name = scene.elements[i];
    for (const auto& [material, triangles] : parts[i]) {
      mesh.primitives.push_back(PrimitiveOf(scene, material, triangles));
    }
  }
  return meshes;
}

}  // namespace

GlbTexture EncodeForGlb(const Image& image) {
  const bool alpha = image.channels == 4;
  const cv::Mat pixels(image.height_px, image.width_px, CV_8UC(image.channels),
                       const_cast<uint8_t*>(image.data.data()));
  cv::Mat swapped = pixels;
  if (image.channels > 1) {
    cv::cvtColor(pixels, swapped, alpha ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  }
  std::vector<uint8_t> bytes;
  const std::vector<int> quality = {cv::IMWRITE_JPEG_QUALITY, kJpegQuality};
  if (!cv::imencode(alpha ? ".png" : ".jpg", swapped, bytes,
                    alpha ? std::vector<int>{} : quality)) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("a picture of {} x {} pixels cannot be encoded", image.width_px,
                            image.height_px));
  }
  return {std::string(bytes.begin(), bytes.end()), alpha ? "image/png" : "image/jpeg"};
}

void WriteGlbFile(const Scene& scene, std::vector<GlbTexture> textures,
                  const std::filesystem::path& path) {
  GlbModel model;
  for (const Material& material : scene.materials) {
    model.materials.push_back({.name = material.name,
                               .colour = material.colour,
                               .roughness = 1 - material.gloss,
                               .texture = material.texture,
                               .cut_out = material.cut_out});
  }
  model.meshes = MeshesOf(scene);
  model.textures = std::move(textures);
  WriteFileAtomically(path, GlbBytes(model));
}

}  // namespace internal

void WriteGlb(const Scene& scene, const std::filesystem::path& path) {
  std::vector<GlbTexture> textures(scene.textures.size());
  ParallelFor(textures.size(), std::numeric_limits<int>::max(),
              [&](size_t i) { textures[i] = internal::EncodeForGlb(scene.textures[i]); });
  internal::WriteGlbFile(scene, std::move(textures), path);
}

}  // namespace stucco::simulate
