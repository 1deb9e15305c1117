// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace stucco::plan {

// What a DJI drone or its controller would stumble over in a mission file.
struct LintFinding {
  std::string element;  // wpmz/waylines.wpml: Folder/Placemark[3]/wpml:executeHeight
  std::string rule;     // short and stable: "required", "range", "action-group-id" ...
  std::string text;     // for people
};

}  // namespace stucco::plan
