// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace stucco {

// Throws Error (kBadInput) where `out` exists, unless it may be overwritten or is an empty folder.
void RequireFree(const std::filesystem::path& out, bool overwrite);

// Byte by byte, in one step, with the folders above. Throws Error, as ReadFile and WriteFile do.
void CopyFile(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace stucco
