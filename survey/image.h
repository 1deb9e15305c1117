// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stucco {

// 8-bit pixels, rows without padding, channels interleaved (1 = grey, 3 = R G B).
struct Image {
  int width_px = 0;
  int height_px = 0;
  int channels = 3;
  std::vector<uint8_t> data;

  const uint8_t* Pixel(int x, int y) const {
    return data.data() + (static_cast<size_t>(y) * width_px + x) * channels;
  }
  uint8_t* Pixel(int x, int y) {
    return data.data() + (static_cast<size_t>(y) * width_px + x) * channels;
  }
};

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

// Size from the JPEG header alone. Throws Error (kBadInput): missing, empty, not a JPEG (and what
// it is instead: PNG, TIFF, HEIC, text ...).
ImageSize ReadJpegSize(const std::filesystem::path& path);

// Decodes a JPEG strictly: a truncated or damaged file is an Error (kBadInput), never grey blocks.
// The picture is stored as the sensor has it: the EXIF orientation is not applied.
// `max_side_px` > 0 area-averages the picture so that its longer side is at most that; the result
// of ScaledSize is its size.
Image ReadJpeg(const std::filesystem::path& path, int channels = 3, int max_side_px = 0);

// The size of a picture limited to `max_side_px` (0: no limit), at least 1 x 1.
ImageSize ScaledSize(ImageSize full, int max_side_px);

// JPEG or PNG by the extension of `path`; `quality` (1 to 100) is for JPEG. Bytes depend on the
// pixels alone. Throws Error (kOutOfResource) when the disk is full.
void WriteImage(const Image& image, const std::filesystem::path& path, int quality = 92);

// PNG or JPEG written by WriteImage. Throws Error (kBadInput).
Image ReadImage(const std::filesystem::path& path);

}  // namespace stucco
