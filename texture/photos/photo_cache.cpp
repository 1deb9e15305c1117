// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/photos/photo_cache.h"

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

size_t SizeOf(const PhotoPyramid& pyramid) {
  size_t bytes = 0;
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

PhotoCache::PhotoCache(const std::filesystem::path& folder, uint64_t limit_bytes, Prepare prepare)
    : photos_(
          limit_bytes,
          [folder, prepare = std::move(prepare)](const std::pair<std::string, int>& key) {
            const std::filesystem::path path = folder / key.first;
            const ImageSize full = ReadJpegSize(path);
            Image photo = ReadJpeg(path, 3, key.second);
            if (prepare) prepare(key.first, photo);
            return std::make_shared<const PhotoPyramid>(
                BuildPyramid(std::move(photo), full.width_px, full.height_px));
          },
          SizeOf) {}

}  // namespace stucco
