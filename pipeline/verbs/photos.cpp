// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/photos.h"

#include <fmt/format.h>

#include <optional>

#include "survey/error.h"
#include "survey/image.h"
#include "survey/parallel.h"
#include "survey/photo_files.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

struct Inspected {
  std::optional<ImageSize> size;
  std::string problem;
  double bytes = 0;
};

Inspected Inspect(const fs::path& path) {
  Inspected result;
  try {
    result.size = ReadJpegSize(path);
    result.bytes = static_cast<double>(fs::file_size(path));
  } catch (const std::exception& e) {
    result.problem = e.what();
  }
  return result;
}

void RequireFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the photo folder is not there", folder.string()),
                "check its path (photos in survey.toml, or --photos of init), or connect the disk "
                "that holds it");
  }
  if (!fs::is_directory(folder, error)) {
    throw Error(
        ErrorKind::kBadInput, fmt::format("{}: is a file, not a folder", folder.string()),
        "name the folder that holds the photos (photos in survey.toml, or --photos of init)");
  }
  fs::directory_iterator readable(folder, error);
  if (error) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: the photo folder cannot be read ({})", folder.string(), error.message()),
        "check the permissions of the folder");
  }
}

}  // namespace

PhotoFolder InspectPhotos(const fs::path& folder, int threads) {
  RequireFolder(folder);
  const PhotoListing listing = ListPhotoFiles(folder);
  std::vector<Inspected> inspected(listing.files.size());
  ParallelFor(inspected.size(), threads, [&](size_t i) {
    const PhotoFile& file = listing.files[i];
    if (file.problem.empty()) {
      inspected[i] = Inspect(folder / file.file);
    } else {
      inspected[i].problem = fmt::format("{}: {}", (folder / file.path).string(), file.problem);
    }
  });
  PhotoFolder result;
  result.other_files = listing.other_files;
  for (size_t i = 0; i < inspected.size(); ++i) {
    if (!inspected[i].size) {
      result.problems.push_back({listing.files[i].path, inspected[i].problem});
      continue;
    }
    const ImageSize& size = *inspected[i].size;
    ++result.photos;
    result.megapixels += 1e-6 * size.width_px * static_cast<double>(size.height_px);
    result.sizes.push_back(size);
    result.bytes += inspected[i].bytes;
  }
  return result;
}

}  // namespace stucco
