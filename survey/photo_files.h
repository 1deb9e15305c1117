// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stucco {

struct PhotoFile {
  std::string path;            // relative to the folder, '/' between folders; valid UTF-8
  std::filesystem::path file;  // the same as the file system has it, in whatever bytes
  std::string problem;         // why it cannot be a photo, seen from outside; empty: none
};

struct PhotoListing {
  std::vector<PhotoFile> files;  // sorted by path
  size_t other_files = 0;        // seen and no photos
};

// Every file below `folder` that is a picture by extension, or a JPEG by content when it has no
// extension. Left out are hidden files and folders, those that systems keep for themselves
// ($RECYCLE.BIN, lost+found, @eaDir ...), masks (photo_mask.png, photo.mask.png, photo.jpg.png),
// raw files beside a JPEG of the same name and files that are no pictures. A folder below that
// cannot be read is listed with its problem. Links are followed, loops are not. Throws Error
// (kBadInput) when the folder itself is missing or cannot be read.
PhotoListing ListPhotoFiles(const std::filesystem::path& folder);

// Only the files.
std::vector<PhotoFile> FindPhotoFiles(const std::filesystem::path& folder);

}  // namespace stucco
