// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/hash_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <optional>
#include <sstream>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

constexpr char kHeader[] = "stucco-hashes 1 ";

// A file changed again within one tick of the kernel's clock keeps its times. A stamp this young is
// not remembered (git's "racy" entries).
constexpr int64_t kYoungestNs = 50'000'000;

int64_t Nanoseconds(const timespec& time) {
  return static_cast<int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

std::optional<FileStamp> Stamp(const std::filesystem::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return FileStamp{status.st_size, Nanoseconds(status.st_mtim), Nanoseconds(status.st_ctim),
                   status.st_ino};
}

bool IsYoung(const FileStamp& stamp) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count() - stamp.changed_ns <
         kYoungestNs;
}

std::string Key(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().string();
}

}  // namespace

HashCache::HashCache(std::filesystem::path file) : file_(std::move(file)) {
  std::string text;
  try {
    text = ReadFile(file_);
  } catch (const Error&) {
    return;
  }
  const size_t end = text.find('\n');
  if (end == std::string::npos ||
      text.substr(0, end) != kHeader + HashBytes(text.substr(end + 1))) {
    return;
  }
  std::istringstream lines(text.substr(end + 1));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    Entry entry;
    std::string path;
    if (fields >> entry.hash >> entry.stamp.size >> entry.stamp.modified_ns >>
            entry.stamp.changed_ns >> entry.stamp.inode &&
        fields.get() == ' ' && std::getline(fields, path)) {
      entries_[path] = entry;
    }
  }
}

std::string HashCache::Hash(const std::filesystem::path& file) {
  const std::string key = Key(file);
  const std::optional<FileStamp> before = Stamp(file);
  if (before) {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(key);
    if (entry != entries_.end() && entry->second.stamp == *before) {
      entry->second.used = true;
      return entry->second.hash;
    }
  }
  std::string hash = HashFile(file);
  const std::lock_guard lock(mutex_);
  changed_ = true;
  // Not remembered: a file that changed while it was read, and a name that the line format cannot
  // hold.
  if (before && before == Stamp(file) && !IsYoung(*before) && key.find('\n') == std::string::npos) {
    entries_[key] = {*before, hash, true};
  } else {
    entries_.erase(key);
  }
  if (interval_ && std::chrono::steady_clock::now() - saved_ >= *interval_) {
    SaveLocked();
  }
  return hash;
}

bool HashCache::Remembers(const std::filesystem::path& file) {
  const std::optional<FileStamp> stamp = Stamp(file);
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(Key(file));
  return stamp && entry != entries_.end() && entry->second.stamp == *stamp;
}

void HashCache::SaveEvery(std::chrono::seconds interval) {
  const std::lock_guard lock(mutex_);
  interval_ = interval;
  saved_ = std::chrono::steady_clock::now();
}

void HashCache::Save() {
  const std::lock_guard lock(mutex_);
  SaveLocked();
}

void HashCache::SaveLocked() {
  saved_ = std::chrono::steady_clock::now();
  if (!changed_) {
    return;
  }
  std::string body;
  for (const auto& [path, entry] : entries_) {
    if (entry.used || Stamp(path) == entry.stamp) {
      body += fmt::format("{} {} {} {} {} {}\n", entry.hash, entry.stamp.size,
                          entry.stamp.modified_ns, entry.stamp.changed_ns, entry.stamp.inode, path);
    }
  }
  try {
    WriteFileAtomically(file_, fmt::format("{}{}\n{}", kHeader, HashBytes(body), body));
    changed_ = false;
  } catch (const Error&) {
    // A read-only survey can still be looked at.
  }
}

}  // namespace stucco
