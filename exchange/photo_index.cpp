// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/photo_index.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "survey/error.h"
#include "survey/image.h"
#include "survey/photo_files.h"

namespace stucco {
namespace {

std::string FileOf(std::string_view path) {
  const size_t slash = path.rfind('/');
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}

std::string WithoutExtension(std::string_view path) {
  const size_t dot = path.rfind('.');
  const size_t slash = path.rfind('/');
  const bool has_extension =
      dot != std::string_view::npos && (slash == std::string_view::npos || dot > slash + 1);
  return std::string(has_extension ? path.substr(0, dot) : path);
}

std::string WithSlashes(std::string_view name) {
  std::string result(name);
  std::replace(result.begin(), result.end(), '\\', '/');
  return result;
}

}  // namespace

void PhotoIndex::Names::Add(const std::string& path, const std::string& photo) {
  photo_of_path[path] = photo;
  photos_of_file[FileOf(path)].push_back(photo);
}

std::optional<std::string> PhotoIndex::Names::Find(std::string_view name) const {
  for (std::string_view end = name;;) {
    const auto found = photo_of_path.find(end);
    if (found != photo_of_path.end()) return found->second;
    const size_t slash = end.find('/');
    if (slash == std::string_view::npos) break;
    end.remove_prefix(slash + 1);
  }
  const auto same_file = photos_of_file.find(FileOf(name));
  if (same_file == photos_of_file.end() || same_file->second.size() != 1) return std::nullopt;
  return same_file->second.front();
}

PhotoIndex::PhotoIndex(std::filesystem::path folder) : folder_(std::move(folder)) {
  for (const PhotoFile& file : FindPhotoFiles(folder_)) {
    if (!file.problem.empty()) continue;
    whole_.Add(file.path, file.path);
    stems_.Add(WithoutExtension(file.path), file.path);
  }
}

std::optional<std::string> PhotoIndex::Find(std::string_view name) const {
  return whole_.Find(WithSlashes(name));
}

std::optional<std::string> PhotoIndex::FindBySidecar(std::string_view name) const {
  return stems_.Find(WithoutExtension(WithSlashes(name)));
}

std::vector<std::string> PhotoIndex::Require(const std::vector<std::string>& names) const {
  std::vector<std::string> photos;
  std::vector<std::string> unknown;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    const auto photo = Find(name);
    if (!photo) {
      unknown.push_back(name);
      continue;
    }
    if (!taken.insert(*photo).second) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("the model has photo {} more than once", *photo),
                  "import a model in which every photo is one image");
    }
    photos.push_back(*photo);
  }
  if (unknown.empty()) return photos;
  const size_t shown = std::min<size_t>(unknown.size(), 3);
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{} of {} photos of the model are not in {}: {}{}", unknown.size(), names.size(),
                  folder_.string(), fmt::join(unknown.begin(), unknown.begin() + shown, ", "),
                  unknown.size() > shown ? " ..." : ""),
      "import a model of the photos that survey.toml names");
}

ImageSize PhotoIndex::SizeOf(const std::string& photo) const {
  return ReadJpegSize(folder_ / photo);
}

}  // namespace stucco
