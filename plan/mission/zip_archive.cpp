// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/internal/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <memory>

#include "survey/error.h"

namespace stucco::plan::internal {
namespace {

// 2026-01-01 00:00 as MS-DOS wrote it, which knows no time zone.
constexpr zip_uint16_t kTime = 0;
constexpr zip_uint16_t kDate = (2026 - 1980) << 9 | 1 << 5 | 1;
// Mission files are some hundred kilobytes; more, all together, is an attack on memory.
constexpr zip_uint64_t kLargest = 256u << 20;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& reason,
                       const std::string& remedy = "") {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), reason), remedy);
}

std::string Reason(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  return reason;
}

void Add(const std::filesystem::path& path, const ZipEntry& entry, zip_t* archive) {
  zip_source_t* source =
      zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), /*freep=*/0);
  const zip_int64_t index =
      source == nullptr ? -1 : zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    Fail(path, fmt::format("cannot hold {}: {}", entry.name, zip_strerror(archive)));
  }
  zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), kTime, kDate, 0);
}

std::string ReadEntry(const std::filesystem::path& path, zip_t* archive, zip_uint64_t index,
                      zip_uint64_t& budget) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat_index(archive, index, 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0) {
    Fail(path, "is a damaged zip file");
  }
  if (stat.size > budget) Fail(path, "holds more than 256 MB");
  budget -= stat.size;
  const std::unique_ptr<zip_file_t, Discard> file(zip_fopen_index(archive, index, 0));
  if (!file) Fail(path, fmt::format("cannot be unpacked: {}", zip_strerror(archive)));
  std::string bytes(stat.size, '\0');
  if (zip_fread(file.get(), bytes.data(), stat.size) != static_cast<zip_int64_t>(stat.size)) {
    Fail(path, "cannot be unpacked to its end");
  }
  return bytes;
}

}  // namespace

void WriteZip(const std::filesystem::path& path, const std::vector<ZipEntry>& entries) {
  int code = 0;
  std::unique_ptr<zip_t, Discard> archive(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!archive) Fail(path, "cannot be written: " + Reason(code));
  for (const ZipEntry& entry : entries) Add(path, entry, archive.get());
  if (zip_close(archive.get()) != 0) {
    throw Error(ErrorKind::kOutOfResource, fmt::format("{}: cannot be written: {}", path.string(),
                                                       zip_strerror(archive.get())));
  }
  static_cast<void>(archive.release());  // zip_close freed it
}

std::vector<ZipEntry> ReadZip(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) Fail(path, "is not there", "check the path");
  if (std::filesystem::is_directory(path, error)) {
    Fail(path, "is a folder, not a file", "name the KMZ file itself");
  }
  int code = 0;
  const std::unique_ptr<zip_t, Discard> archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) {
    Fail(path, "is no readable zip file: " + Reason(code),
         "a KMZ is a zip file: export or copy it again");
  }
  std::vector<ZipEntry> entries;
  zip_uint64_t budget = kLargest;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* name = zip_get_name(archive.get(), index, 0);
    if (name == nullptr) Fail(path, "is a damaged zip file");
    entries.push_back({name, ReadEntry(path, archive.get(), index, budget)});
  }
  return entries;
}

}  // namespace stucco::plan::internal
