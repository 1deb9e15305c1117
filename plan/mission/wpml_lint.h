// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stucco::plan {

// What a DJI drone or its controller would stumble over in a mission file.
struct LintFinding {
  std::string element;  // wpmz/waylines.wpml: Folder/Placemark[3]/wpml:executeHeight
  std::string rule;     // short and stable: "required", "range", "action-group-id" ...
  std::string text;     // for people
};

// Checks a mission (KMZ) or one of the documents in it, also of other programs, against DJI's
// WPML documentation. Nothing found means that none of the rules is broken, not that the mission is
// safe to fly. Throws Error when the file cannot be read at all.
std::vector<LintFinding> LintKmz(const std::filesystem::path& path);
std::vector<LintFinding> LintWaylines(const std::string& xml);
std::vector<LintFinding> LintTemplate(const std::string& xml);

}  // namespace stucco::plan
