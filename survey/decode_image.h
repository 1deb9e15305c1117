// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "survey/pixels.h"

namespace stucco {

// A picture from the bytes of its file, whatever its format (JPEG, PNG, and what OpenCV reads
// besides), as 8-bit grey (1 channel), RGB (3) or RGB with alpha (4). `name` is for messages.
// Throws Error (kBadInput): damaged, truncated, unknown format.
Image DecodeImage(std::string_view bytes, const std::string& name);

}  // namespace stucco
