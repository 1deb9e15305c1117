// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "survey/image.h"
#include "survey/lru_cache.h"

namespace stucco {

// A photo and its halvings: level k is half as large as level k - 1 (2 x 2 means; an odd last
// column or row is averaged with itself).
struct PhotoPyramid {
  std::vector<Image> levels;
  int full_width_px = 0;  // of the photo on disk; level 0 may be smaller
  int full_height_px = 0;
};

PhotoPyramid BuildPyramid(Image picture, int full_width_px, int full_height_px);

// Decoded photos, the least recently used dropped first so that together they stay near
// `limit_bytes`. Thread-safe.
class PhotoCache {
 public:
  // `prepare` has its way with each photo, by its name, before it is halved.
  using Prepare = std::function<void(const std::string& name, Image& photo)>;
  PhotoCache(const std::filesystem::path& folder, uint64_t limit_bytes, Prepare prepare = {});

  // `max_side_px` 0: full size. Throws Error (kBadInput) where the file cannot be decoded.
  std::shared_ptr<const PhotoPyramid> Get(const std::string& name, int max_side_px) {
    return photos_.Get({name, max_side_px});
  }

  uint64_t bytes() const { return photos_.bytes(); }

 private:
  LruCache<std::pair<std::string, int>, PhotoPyramid> photos_;
};

}  // namespace stucco
