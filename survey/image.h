// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/pixels.h"

namespace stucco {

// Size from the JPEG header alone. Throws Error (kBadInput): missing, empty, not a JPEG (and what
// it is instead: PNG, TIFF, HEIC, text ...).
ImageSize ReadJpegSize(const std::filesystem::path& path);

// Decodes a JPEG strictly: a truncated or damaged file is an Error (kBadInput), never grey blocks.
// The picture is stored as the sensor has it: the EXIF orientation is not applied.
// `max_side_px` > 0 area-averages the picture so that its longer side is at most that; the result
// of ScaledSize is its size.
Image ReadJpeg(const std::filesystem::path& path, int channels = 3, int max_side_px = 0);

// JPEG or PNG by the extension of `path`; `quality` (1 to 100) is for JPEG. Bytes depend on the
// pixels alone. Throws Error (kOutOfResource) when the disk is full.
void WriteImage(const Image& image, const std::filesystem::path& path, int quality = 92);

// PNG or JPEG written by WriteImage. Throws Error (kBadInput).
Image ReadImage(const std::filesystem::path& path);

}  // namespace stucco
