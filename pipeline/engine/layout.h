// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/engine/stages.h"

namespace stucco {

// The path without links and dots, as far as it exists. Never throws.
std::filesystem::path RealPath(const std::filesystem::path& path);

// True for a folder itself and for all that is below it; of real paths.
bool IsInside(const std::filesystem::path& path, const std::filesystem::path& folder);

// Throws Error (kBadInput) when a run would write among the photos: the survey lies inside its
// photo folder, or the photos lie in a folder that a stage replaces.
void RequireApart(const std::filesystem::path& survey, const std::filesystem::path& photos,
                  const StageTable& table);

}  // namespace stucco
