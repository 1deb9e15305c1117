// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace stucco::test {

// Errors and warnings of the Khronos glTF validator about a GLB, one a line, empty for none.
// Nothing where the validator is not installed (scripts/install_checkers.sh does that).
std::optional<std::string> KhronosFindings(const std::filesystem::path& glb);

}  // namespace stucco::test
