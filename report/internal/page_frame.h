// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace stucco::internal {

// What stands before and after the sections of a page that loads nothing. `title` is plain text.
std::string PageBegin(std::string_view title);
std::string PageEnd();

}  // namespace stucco::internal
