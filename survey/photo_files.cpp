// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/photo_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>

#include "survey/error.h"
#include "survey/text.h"
#include "survey/utf8.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kJpegExtensions = {".jpg", ".jpeg", ".jpe", ".jfif"};
constexpr std::array<std::string_view, 19> kOtherPictures = {
    ".png", ".tif", ".tiff", ".heic", ".heif", ".avif", ".webp", ".bmp", ".gif", ".dng",
    ".arw", ".nef", ".cr2",  ".cr3",  ".raf",  ".orf",  ".rw2",  ".pef", ".iiq"};

// What Windows, Linux and network storage keep beside the files of their users, in lower case.
constexpr std::array<std::string_view, 5> kSystemFolders = {
    "$recycle.bin", "system volume information", "lost+found", "@eadir", "#recycle"};

std::string LowerExtension(const fs::path& path) {
  return LowerCase(path.extension().string());
}

template <size_t N>
bool IsOneOf(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// photo_mask.png, photo.mask.png, and photo.jpg.png as OpenSfM names them.
bool IsMask(const fs::path& path) {
  const std::string stem = path.stem().string();
  return stem.ends_with("_mask") || stem.ends_with(".mask") ||
         IsOneOf(LowerExtension(path.stem()), kJpegExtensions);
}

bool StartsLikeJpeg(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 3> head = {};
  return file.read(head.data(), head.size()) && head == std::array<char, 3>{'\xFF', '\xD8', '\xFF'};
}

// What lies in a folder, sorted: that decides which way into a linked folder comes first.
std::vector<fs::path> Entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with('.')) entries.push_back(entry.path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

// Names without extension of the JPEG files.
std::set<fs::path> JpegStems(const std::vector<fs::path>& entries) {
  std::set<fs::path> stems;
  for (const fs::path& entry : entries) {
    if (IsOneOf(LowerExtension(entry), kJpegExtensions)) stems.insert(entry.stem());
  }
  return stems;
}

class FolderWalk {
 public:
  // Throws fs::filesystem_error when the root cannot be read.
  explicit FolderWalk(const fs::path& root) : root_(root) {
    Visit(root);
    std::sort(listing_.files.begin(), listing_.files.end(),
              [](const PhotoFile& a, const PhotoFile& b) { return a.path < b.path; });
  }

  PhotoListing Listing() && { return std::move(listing_); }

 private:
  void Visit(const fs::path& folder) {
    if (!visited_.insert(fs::canonical(folder)).second) return;
    const std::vector<fs::path> entries = Entries(folder);
    const std::set<fs::path> jpegs = JpegStems(entries);
    for (const fs::path& entry : entries) {
      std::error_code ignored;  // a dangling link is neither
      if (fs::is_directory(entry, ignored)) {
        VisitBelow(entry);
      } else if (fs::is_regular_file(entry, ignored)) {
        Consider(entry, jpegs);
      }
    }
  }

  // One folder that cannot be read costs only itself.
  void VisitBelow(const fs::path& folder) {
    if (IsOneOf(LowerCase(folder.filename().string()), kSystemFolders)) return;
    try {
      Visit(folder);
    } catch (const fs::filesystem_error& error) {
      Add(folder, fmt::format("the folder cannot be read ({}); make it readable, or remove it",
                              error.code().message()));
    }
  }

  void Consider(const fs::path& path, const std::set<fs::path>& jpegs) {
    const std::string extension = LowerExtension(path);
    if (IsOneOf(extension, kJpegExtensions) || (extension.empty() && StartsLikeJpeg(path))) {
      Add(path, "");
    } else if (IsOneOf(extension, kOtherPictures) && !IsMask(path) &&
               !jpegs.contains(path.stem())) {  // a camera's raw file lies beside its JPEG
      Add(path,
          fmt::format("{} pictures are not read; convert the photo to JPEG", extension.substr(1)));
    } else {
      ++listing_.other_files;
    }
  }

  void Add(const fs::path& path, std::string problem) {
    const fs::path file = path.lexically_relative(root_);
    std::string name = file.generic_string();
    if (!IsPrintableUtf8(name)) {
      for (char& c : name) {
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
      }
      problem = "the file's name is not valid UTF-8 or has control characters; rename the file";
    }
    listing_.files.push_back({std::move(name), file, std::move(problem)});
  }

  fs::path root_;
  std::set<fs::path> visited_;
  PhotoListing listing_;
};

}  // namespace

PhotoListing ListPhotoFiles(const fs::path& folder) {
  std::error_code failure;
  if (!fs::exists(folder, failure)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: no such folder", folder.string()),
                "give the folder that holds the photos");
  }
  if (!fs::is_directory(folder, failure)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: not a folder", folder.string()),
                "give the folder that holds the photos, not one of its files");
  }
  try {
    return FolderWalk(folder).Listing();
  } catch (const fs::filesystem_error& error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: {}", error.path1().string(), error.code().message()),
                "make the folder readable for the user who runs this program");
  }
}

std::vector<PhotoFile> FindPhotoFiles(const fs::path& folder) {
  return ListPhotoFiles(folder).files;
}

}  // namespace stucco
