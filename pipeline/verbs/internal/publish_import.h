// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/engine/platform.h"

namespace stucco {

// Lets `write` fill a folder and puts it in the place of a stage's outputs, with a manifest that
// names the source, so that `run` goes on from it. Returns what the user should know. Throws Error.
std::vector<std::string> PublishImport(
    const std::filesystem::path& survey, const std::string& stage,
    const std::filesystem::path& source, const Platform& platform,
    const std::function<void(const std::filesystem::path& out)>& write);

}  // namespace stucco
