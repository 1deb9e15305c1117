// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stucco::plan::internal {

struct ZipEntry {
  std::string name;
  std::string bytes;
};

// All entries carry the same fixed time. Throws Error that names the file.
void WriteZip(const std::filesystem::path& path, const std::vector<ZipEntry>& entries);
std::vector<ZipEntry> ReadZip(const std::filesystem::path& path);

}  // namespace stucco::plan::internal
