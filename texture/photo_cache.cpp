// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/photo_cache.h"

#include <algorithm>

namespace stucco {
namespace {

// Coarser levels than this carry nothing that a texel could show.
constexpr int kSmallestSide = 16;

Image Halved(const Image& image) {
  Image out;
  out.width_px = (image.width_px + 1) / 2;
  out.height_px = (image.height_px + 1) / 2;
  out.channels = image.channels;
  out.data.resize(static_cast<size_t>(out.width_px) * out.height_px * out.channels);
  for (int y = 0; y < out.height_px; ++y) {
    const int y1 = std::min(2 * y + 1, image.height_px - 1);
    for (int x = 0; x < out.width_px; ++x) {
      const int x1 = std::min(2 * x + 1, image.width_px - 1);
      const uint8_t* a = image.Pixel(2 * x, 2 * y);
      const uint8_t* b = image.Pixel(x1, 2 * y);
      const uint8_t* c = image.Pixel(2 * x, y1);
      const uint8_t* d = image.Pixel(x1, y1);
      uint8_t* to = out.Pixel(x, y);
      for (int k = 0; k < out.channels; ++k) {
        to[k] = static_cast<uint8_t>((a[k] + b[k] + c[k] + d[k] + 2) / 4);
      }
    }
  }
  return out;
}

uint64_t SizeOf(const PhotoPyramid& pyramid) {
  uint64_t bytes = 0;
  for (const Image& level : pyramid.levels) bytes += level.data.size();
  return bytes;
}

}  // namespace

PhotoPyramid BuildPyramid(Image picture, int full_width_px, int full_height_px) {
  PhotoPyramid pyramid;
  pyramid.full_width_px = full_width_px;
  pyramid.full_height_px = full_height_px;
  pyramid.levels.push_back(std::move(picture));
  while (std::min(pyramid.levels.back().width_px, pyramid.levels.back().height_px) >=
         2 * kSmallestSide) {
    pyramid.levels.push_back(Halved(pyramid.levels.back()));
  }
  return pyramid;
}

std::shared_ptr<const PhotoPyramid> PhotoCache::Get(const std::string& name, int max_side_px) {
  const Key key(name, max_side_px);
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    auto [entry, added] = entries_.try_emplace(key);
    if (added) {
      entry->second.slot = std::make_shared<Slot>();
      recent_.push_front(key);
      entry->second.position = recent_.begin();
    } else {
      recent_.splice(recent_.begin(), recent_, entry->second.position);
    }
    slot = entry->second.slot;
  }
  const std::lock_guard lock(slot->loading);
  if (!slot->pyramid) {
    const std::filesystem::path path = folder_ / name;
    const ImageSize full = ReadJpegSize(path);
    slot->pyramid = std::make_shared<const PhotoPyramid>(
        BuildPyramid(ReadJpeg(path, 3, max_side_px), full.width_px, full.height_px));
    Account(key, SizeOf(*slot->pyramid));
  }
  return slot->pyramid;
}

void PhotoCache::Account(const Key& key, uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key);
  if (found == entries_.end()) return;  // dropped while it was being decoded
  found->second.bytes = bytes;
  bytes_ += bytes;
  while (bytes_ > limit_bytes_ && entries_.size() > 1 && recent_.back() != key) {
    const auto oldest = entries_.find(recent_.back());
    bytes_ -= oldest->second.bytes;
    entries_.erase(oldest);
    recent_.pop_back();
  }
}

uint64_t PhotoCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace stucco
