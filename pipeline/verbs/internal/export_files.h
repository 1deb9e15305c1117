// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/model_look.h"

namespace stucco {

// Throws Error (kBadInput) where `out` exists, unless it may be overwritten or is an empty folder.
void RequireFree(const std::filesystem::path& out, bool overwrite);

// What to say of epochs that cannot be shown beside the survey's own look; nothing for none.
std::vector<std::string> NotesOf(const SurveyLooks& looks);

// Byte by byte, in one step, with the folders above. Throws Error, as ReadFile and WriteFile do.
void CopyFile(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace stucco
