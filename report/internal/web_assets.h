// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace stucco::internal {

// The page's own style sheet and script: the files of report/web, put into a source file by
// cmake/embed_page.cmake when the program is built.
std::string_view PageStyle();
std::string_view PageScript();

}  // namespace stucco::internal
