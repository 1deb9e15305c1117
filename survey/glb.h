// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace stucco {

// An encoded picture.
struct GlbTexture {
  std::string bytes;
  std::string mime_type;  // "image/jpeg", "image/png"
};

struct GlbMaterial {
  std::string name;
  Eigen::Vector3f colour = Eigen::Vector3f::Ones();  // linear, times the texture's
  float roughness = 1;
  int texture = -1;      // index into GlbModel::textures; -1: colour alone
  bool cut_out = false;  // where the texture's alpha is below one half there is nothing
  bool unlit = false;    // colours as they are (KHR_materials_unlit)
  bool two_sided = true;
};

// The material that a primitive has in some variant of the model.
struct GlbMapping {
  int variant = 0;   // index into GlbModel::variants
  int material = 0;  // index into GlbModel::materials
};

// Triangles of one material.
struct GlbPrimitive {
  int material = 0;                        // index into GlbModel::materials
  std::vector<GlbMapping> mappings = {};   // where it is another; each variant once
  std::vector<Eigen::Vector3f> positions;  // y up
  std::vector<Eigen::Vector3f> normals;    // by position; none: faces are flat
  std::vector<Eigen::Vector2f> uv;         // by position, (0, 0) top left; may be none
  std::vector<uint32_t> indices;           // counter-clockwise, three a triangle
};

// A node of its own with the same name.
struct GlbMesh {
  std::string name;
  std::vector<GlbPrimitive> primitives;
};

struct GlbModel {
  std::vector<GlbMaterial> materials;
  std::vector<GlbMesh> meshes;
  std::vector<GlbTexture> textures;
  std::vector<std::string> variants = {};  // names that viewers offer (KHR_materials_variants)
  bool repeat_textures = true;             // beyond their edges; false: their last texels go on
  // What was taken off the world's coordinates: `asset.extras.offset`, left out where zero.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

// The model as binary glTF 2.0 (Khronos), self-contained. Requires indices that lead somewhere and
// primitives with positions, and with `uv` where any of their materials has a texture. Throws Error
// (kStageFailed) where it is larger than 4 GiB.
std::string GlbBytes(const GlbModel& model);

}  // namespace stucco
