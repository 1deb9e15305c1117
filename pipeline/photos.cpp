// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "survey/error.h"
#include "survey/image.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

bool IsNamedLikePicture(const fs::path& path) {
  static const std::set<std::string> extensions = {".jpg",  ".jpeg", ".jpe",  ".png",  ".tif",
                                                   ".tiff", ".dng",  ".heic", ".heif", ".webp"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extensions.contains(extension);
}

void Walk(const fs::path& root, const fs::path& folder, std::set<fs::path>& visited,
          std::vector<std::string>& files) {
  std::error_code error;
  if (!visited.insert(fs::canonical(folder, error)).second) {
    return;
  }
  std::set<fs::path> entries;  // which way into a linked folder comes first
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().filename().string().starts_with('.')) {
      entries.insert(entry->path());
    }
  }
  for (const fs::path& entry : entries) {
    std::error_code dangling;
    if (fs::is_directory(entry, dangling)) {
      Walk(root, entry, visited, files);
    } else if (fs::is_regular_file(entry, dangling)) {
      files.push_back(entry.lexically_relative(root).generic_string());
    }
  }
}

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
    if (IsNamedLikePicture(path)) {
      result.problem = e.what();
    }
  }
  return result;
}

void RequireFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the photo folder is not there", folder.string()),
                "correct photos = ... in survey.toml, or connect the disk that holds it");
  }
  if (!fs::is_directory(folder, error)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is a file, not a folder", folder.string()),
                "name the folder that holds the photos in survey.toml");
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

std::vector<std::string> PhotoFiles(const fs::path& folder) {
  std::vector<std::string> files;
  std::set<fs::path> visited;
  Walk(folder, folder, visited, files);
  std::sort(files.begin(), files.end());
  return files;
}

PhotoFolder InspectPhotos(const fs::path& folder, int threads) {
  RequireFolder(folder);
  const std::vector<std::string> files = PhotoFiles(folder);
  std::vector<Inspected> inspected(files.size());
  ParallelFor(files.size(), threads, [&](size_t i) { inspected[i] = Inspect(folder / files[i]); });
  PhotoFolder result;
  for (size_t i = 0; i < files.size(); ++i) {
    if (inspected[i].size) {
      const double megapixels =
          1e-6 * inspected[i].size->width_px * static_cast<double>(inspected[i].size->height_px);
      ++result.photos;
      result.megapixels += megapixels;
      result.sizes.push_back(*inspected[i].size);
      result.bytes += inspected[i].bytes;
    } else if (!inspected[i].problem.empty()) {
      result.problems.push_back({files[i], inspected[i].problem});
    } else {
      ++result.other_files;
    }
  }
  return result;
}

}  // namespace stucco
