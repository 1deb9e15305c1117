// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stucco {

// Whether a word stands where a verb should and is none.
bool IsUnknownVerb(const CLI::App& app, const std::string& word);

// What to type instead of arguments that were refused: the nearest verb or options, or where the
// help is.
std::string SuggestUsage(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace stucco
