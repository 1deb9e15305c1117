// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "survey/pixels.h"

namespace stucco {

// The photos of a survey, found by what other programs call them: absolute paths of other machines
// with either slash, paths below some folder, names without a folder, with or without extension.
class PhotoIndex {
 public:
  // Looks at the folder once. Throws Error (kBadInput) when it cannot be read.
  explicit PhotoIndex(std::filesystem::path folder);

  // The photo whose path ends as the name does; the longest end that is the path of a photo counts,
  // then a file name that occurs once. Nothing where no photo, or more than one, answers.
  std::optional<std::string> Find(std::string_view name) const;
  // The photo that a sidecar belongs to: the same, without the extensions of both.
  std::optional<std::string> FindBySidecar(std::string_view name) const;
  // The photos of names, by place. Throws Error (kBadInput) that lists the names without a photo,
  // or names the photo that is meant twice.
  std::vector<std::string> Require(const std::vector<std::string>& names) const;

  ImageSize SizeOf(const std::string& photo) const;

 private:
  struct Names {
    std::map<std::string, std::string, std::less<>> photo_of_path;
    std::map<std::string, std::vector<std::string>, std::less<>> photos_of_file;

    void Add(const std::string& path, const std::string& photo);
    std::optional<std::string> Find(std::string_view name) const;
  };

  std::filesystem::path folder_;
  Names whole_;
  Names stems_;  // without extension
};

}  // namespace stucco
