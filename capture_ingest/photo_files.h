// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stucco {

struct PhotoFile {
  std::string path;     // relative to the folder, '/' between folders; valid UTF-8
  std::string problem;  // why it cannot be a photo, seen from its name alone; empty: none
};

// Every file below `folder` that is a picture by extension or a JPEG by content, sorted by path.
// Hidden files and folders, masks (photo_mask.png, photo.mask.png, photo.jpg.png), raw files beside
// a JPEG of the same name and files that are no pictures are left out. Links are followed, loops
// are not. Throws Error (kBadInput) when the folder is missing or cannot be read.
std::vector<PhotoFile> FindPhotoFiles(const std::filesystem::path& folder);

// Whether the bytes are well-formed UTF-8 without control characters.
bool IsPrintableUtf8(std::string_view text);

}  // namespace stucco
