// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace stucco {

// File names (without folder and extension) for facet ids: letters, digits, '-', '_' and '.' stay,
// everything else becomes '_' ("C0001/W03" -> "C0001_W03"); names that would differ in nothing but
// case, or not at all, get a number.
std::vector<std::string> FileNames(const std::vector<std::string>& ids);

}  // namespace stucco
