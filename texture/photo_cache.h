// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "survey/image.h"

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
// `limit_bytes`. Thread-safe: a photo that several threads ask for is decoded once. What callers
// hold stays alive.
class PhotoCache {
 public:
  PhotoCache(std::filesystem::path folder, uint64_t limit_bytes)
      : folder_(std::move(folder)), limit_bytes_(limit_bytes) {}

  // `max_side_px` 0: full size. Throws Error (kBadInput) where the file cannot be decoded.
  std::shared_ptr<const PhotoPyramid> Get(const std::string& name, int max_side_px);

  uint64_t bytes() const;

 private:
  struct Slot {
    std::mutex loading;
    std::shared_ptr<const PhotoPyramid> pyramid;
  };
  using Key = std::pair<std::string, int>;
  struct Entry {
    std::shared_ptr<Slot> slot;
    uint64_t bytes = 0;
    std::list<Key>::iterator position;
  };

  void Account(const Key& key, uint64_t bytes);

  std::filesystem::path folder_;
  uint64_t limit_bytes_;
  mutable std::mutex mutex_;
  uint64_t bytes_ = 0;
  std::list<Key> recent_;  // most recent first
  std::map<Key, Entry> entries_;
};

}  // namespace stucco
