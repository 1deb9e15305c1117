// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace stucco {

// Whole-file reading and writing with errors that name the file and the reason (kBadInput for
// reading, kOutOfResource for a full disk, kBadInput for a folder that cannot be written).
std::string ReadFile(const std::filesystem::path& path);
void WriteFile(const std::filesystem::path& path, std::string_view bytes);

// Writes beside the target, flushes to disk and renames: a crash leaves the old file or the new
// one.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

// XXH3, 128 bits, as 32 lower-case hex digits.
std::string HashBytes(std::string_view bytes);
std::string HashFile(const std::filesystem::path& path);

// Hash of a list of parts in which ("ab", "c") and ("a", "bc") differ.
std::string HashParts(std::span<const std::string> parts);

}  // namespace stucco
