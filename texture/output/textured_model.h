// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// A proxy with the pictures of its facets, which lie in `folder`.
struct TexturedModel {
  const Proxy& proxy;
  const TextureSet& textures;
  std::filesystem::path folder;
};

}  // namespace stucco
