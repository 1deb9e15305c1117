// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "survey/image.h"

namespace stucco {

// What full decoding tells about a photo's picture.
struct PhotoHealth {
  ImageSize size;
  double sharpness = 0;   // variance of the Laplacian of the grey picture at one megapixel
  std::string thumbnail;  // a JPEG of at most kThumbnailWidth_px x kThumbnailHeight_px
};

inline constexpr int kThumbnailWidth_px = 160;
inline constexpr int kThumbnailHeight_px = 120;

// Decodes the whole file strictly. Throws Error (kBadInput) on anything but a sound JPEG.
PhotoHealth CheckHealth(const std::filesystem::path& path);

// For the unit store. ParseHealth throws Error (kBadInput) on bytes of another make.
std::string Serialized(const PhotoHealth& health);
PhotoHealth ParseHealth(std::string_view bytes);

// Changes when the results of CheckHealth do: part of the key under which they are kept.
inline constexpr char kHealthVersion[] = "1";

}  // namespace stucco
