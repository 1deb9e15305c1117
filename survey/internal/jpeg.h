// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "survey/pixels.h"

namespace stucco::internal {

bool LooksLikeJpeg(std::string_view bytes);

// What a file is by its first bytes, for messages: "a PNG picture", "text", "empty".
std::string Describe(std::string_view bytes);

// As ReadJpegSize (image.h).
ImageSize JpegSizeOf(const std::filesystem::path& path);

// `channels` 0: as stored. `name` is for messages. Throws Error (kBadInput).
Image DecodeJpeg(std::string_view bytes, const std::string& name, int channels, int max_side_px);

}  // namespace stucco::internal
