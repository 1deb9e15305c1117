// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/image.h"

namespace stucco {

struct PhotoProblem {
  std::string path;  // relative to the photo folder
  std::string why;   // begins with the file
};

// What a look at the headers of a photo folder's files tells. `ingest` looks closer.
struct PhotoFolder {
  size_t photos = 0;             // JPEG files with a readable header
  std::vector<ImageSize> sizes;  // of the photos
  size_t other_files = 0;
  double megapixels = 0;
  double bytes = 0;                    // of the photos
  std::vector<PhotoProblem> problems;  // what cannot be used: damaged files, unreadable folders
};

// Throws Error (kBadInput) when the folder is missing, is no folder or cannot be read.
PhotoFolder InspectPhotos(const std::filesystem::path& folder, int threads);

}  // namespace stucco
