// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "survey/image.h"

namespace stucco::simulate {

struct Material {
  std::string name;
  Eigen::Vector3f colour = Eigen::Vector3f::Ones();  // linear albedo, times the texture's
  int texture = -1;                                  // index into Scene::textures; -1: colour alone
  bool cut_out = false;  // where the texture's alpha is below one half there is nothing: leaves
  float gloss = 0;       // 0 matt; 1 a clean pane, which mirrors the sky by Fresnel's law
};

// Triangles with textures, in metres, x east, y north, z up. Front faces are counter-clockwise;
// both sides are drawn. Small enough for floats: the origin is near.
struct Scene {
  std::vector<Eigen::Vector3f> positions;  // of vertices
  std::vector<Eigen::Vector2f> uv;  // of vertices: (0, 0) the top-left corner of the texture's
                                    // top-left texel, (1, 1) its bottom-right corner; repeats
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> materials_of;  // of triangles, indices into `materials`
  std::vector<int> elements_of;   // of triangles, indices into `elements`
  std::vector<Material> materials;
  std::vector<Image> textures;        // 3 or 4 (alpha) channels, sRGB
  std::vector<std::string> elements;  // names of parts: "B0001/F03", "B0001/R0", "G0", "tree 3"
};

}  // namespace stucco::simulate
