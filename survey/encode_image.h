// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "survey/pixels.h"

namespace stucco {

// What WriteImage writes: the bytes of a JPEG or PNG, by the extension of `path`, which need not
// exist.
std::string EncodeImage(const Image& image, const std::filesystem::path& path, int quality = 92);

}  // namespace stucco
