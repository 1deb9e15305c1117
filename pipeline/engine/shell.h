// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace stucco {

// A word as it has to be typed in a POSIX shell; quoted only where needed.
std::string ShellWord(const std::string& word);

}  // namespace stucco
