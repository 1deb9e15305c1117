// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace stucco {

// What a file system says about a file without opening it.
struct FileStamp {
  int64_t size = 0;
  int64_t modified_ns = 0;
  int64_t changed_ns = 0;  // inode change time, which no program can set back
  uint64_t inode = 0;
  auto operator<=>(const FileStamp&) const = default;
};

// Content hashes of files, remembered by stamp so that a photo is read once and not at every run.
// Only an accelerator: what is up to date is decided by the hashes, never by the times. A damaged
// or missing cache file is an empty cache. Thread-safe.
class HashCache {
 public:
  explicit HashCache(std::filesystem::path file);

  // From here on Hash also saves, at most this often: what a killed run read is not read again.
  void SaveEvery(std::chrono::seconds interval);

  // Hash of the file's content. Throws Error (kBadInput) when it cannot be read.
  std::string Hash(const std::filesystem::path& file);

  // True when Hash will not have to read the file.
  bool Remembers(const std::filesystem::path& file);

  // Writes the cache; failing to is no error, the next run reads the files again.
  void Save();

 private:
  struct Entry {
    FileStamp stamp;
    std::string hash;
    bool used = false;
  };

  void SaveLocked();

  std::filesystem::path file_;
  std::optional<std::chrono::seconds> interval_;
  std::chrono::steady_clock::time_point saved_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;  // by absolute path
  bool changed_ = false;
};

}  // namespace stucco
