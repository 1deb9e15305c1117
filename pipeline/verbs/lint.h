// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stucco {

// What a DJI drone or its controller would stumble over in a mission file.
struct MissionFault {
  std::string element;  // wpmz/waylines.wpml: Folder/Placemark[3]/wpml:executeHeight
  std::string rule;     // short and stable
  std::string text;     // for people
};

// Checks a DJI mission (KMZ), of this or another program. Throws Error when it cannot be read.
std::vector<MissionFault> LintMission(const std::filesystem::path& kmz);

}  // namespace stucco
