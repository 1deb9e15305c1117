// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/units.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <vector>

#include "pipeline/engine/exit_code.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

std::string Header(std::string_view bytes) {
  return fmt::format("stucco-unit 1 {} {}\n", bytes.size(), HashBytes(bytes));
}

// A key that can be a file name stays as it is, so that people can find a unit.
std::string FileName(std::string_view key) {
  const bool plain = !key.empty() && key.size() <= 100 && key.front() != '.' &&
                     std::all_of(key.begin(), key.end(), [](unsigned char c) {
                       return std::isalnum(c) || c == '-' || c == '_' || c == '.';
                     });
  return plain ? std::string(key) : HashBytes(key);
}

}  // namespace

DiskUnits::DiskUnits(fs::path folder, Listener listener)
    : folder_(std::move(folder)), listener_(std::move(listener)) {}

fs::path DiskUnits::Path(std::string_view kind, std::string_view key) const {
  return folder_ / FileName(kind) / FileName(key);
}

std::optional<std::string> DiskUnits::Load(std::string_view kind, std::string_view key) {
  const fs::path path = Path(kind, key);
  std::error_code missing;
  if (!fs::exists(path, missing)) {
    return std::nullopt;
  }
  std::string content;
  try {
    content = ReadFile(path);
  } catch (const Error&) {
    return std::nullopt;
  }
  const size_t body = content.find('\n') + 1;
  const std::string_view bytes = std::string_view(content).substr(body);
  if (body == 0 || std::string_view(content).substr(0, body) != Header(bytes)) {
    return std::nullopt;
  }
  const std::lock_guard lock(mutex_);
  if (touched_.insert(path).second) {
    ++counts_[std::string(kind)].reused;
  }
  content.erase(0, body);
  return content;
}

void DiskUnits::Save(std::string_view kind, std::string_view key, std::string_view bytes) {
  static std::atomic<uint64_t> counter = 0;
  const fs::path path = Path(kind, key);
  const fs::path beside =
      path.parent_path() / fmt::format(".{}-{}.tmp", getpid(), counter.fetch_add(1));
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) {
    throw WriteError(path.parent_path(), "cannot be created", error.value());
  }
  std::string content = Header(bytes);
  content += bytes;
  try {
    WriteFile(beside, content);
  } catch (const Error&) {
    fs::remove(beside, error);
    throw;
  }
  fs::rename(beside, path, error);
  if (error) {
    const int number = error.value();
    fs::remove(beside, error);
    throw WriteError(path, "cannot be written", number);
  }
  {
    const std::lock_guard lock(mutex_);
    touched_.insert(path);
    ++counts_[std::string(kind)].computed;
  }
  if (listener_) {
    listener_(kind, key, bytes.size());
  }
}

std::map<std::string, UnitCount> DiskUnits::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void DiskUnits::DeleteUntouched() {
  const std::lock_guard lock(mutex_);
  std::error_code error;
  std::vector<fs::path> unused;
  for (fs::recursive_directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file() && !touched_.contains(entry->path())) {
      unused.push_back(entry->path());
    }
  }
  for (const fs::path& path : unused) {
    fs::remove(path, error);
  }
}

}  // namespace stucco
