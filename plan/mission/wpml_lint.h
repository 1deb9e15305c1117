// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/mission/lint_finding.h"

namespace stucco::plan {

// Checks a mission (KMZ) or one of the documents in it, also of other programs, against DJI's
// WPML documentation. Nothing found means that none of the rules is broken, not that the mission is
// safe to fly. Throws Error when the file cannot be read at all.
std::vector<LintFinding> LintKmz(const std::filesystem::path& path);
std::vector<LintFinding> LintWaylines(const std::string& xml);
std::vector<LintFinding> LintTemplate(const std::string& xml);

}  // namespace stucco::plan
