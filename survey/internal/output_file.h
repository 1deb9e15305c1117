// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace stucco::internal {

// A file that is written from its beginning; every failure is an Error that names it
// (kOutOfResource for a full disk).
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void Write(std::string_view bytes);
  void FlushToDisk();
  // Some file systems report a full disk only here.
  void Close();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

void CreateFolder(const std::filesystem::path& folder);

}  // namespace stucco::internal
