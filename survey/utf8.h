// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace stucco {

// Length of the well-formed sequence at the front of a text (Unicode 15, table 3-7); 0 when there
// is none. Requires a text that is not empty.
size_t Utf8SequenceLength(std::string_view text);

// Whether the bytes are well-formed UTF-8 without control characters.
bool IsPrintableUtf8(std::string_view text);

}  // namespace stucco
