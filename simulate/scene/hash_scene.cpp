// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <vector>

#include "simulate/scene/scene_folder.h"
#include "survey/files.h"

namespace stucco::simulate {
namespace {

template <typename T>
std::string HashOf(const std::vector<T>& values) {
  return HashBytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

std::string HashScene(const Scene& scene) {
  std::vector<std::string> parts = {HashOf(scene.positions), HashOf(scene.uv),
                                    HashOf(scene.triangles), HashOf(scene.materials_of),
                                    HashOf(scene.elements_of)};
  for (const Material& m : scene.materials) {
    parts.push_back(fmt::format("{} {} {} {} {} {}", m.colour.x(), m.colour.y(), m.colour.z(),
                                m.texture, m.cut_out, m.gloss));
  }
  for (const Image& image : scene.textures) {
    parts.push_back(fmt::format("{} {} {} {}", image.width_px, image.height_px, image.channels,
                                HashOf(image.data)));
  }
  // Names tell ground and occluders from buildings.
  parts.insert(parts.end(), scene.elements.begin(), scene.elements.end());
  return HashParts(parts);
}

}  // namespace stucco::simulate
