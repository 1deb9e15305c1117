// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace stucco {

// A picture that a CityJSON file names.
struct CityPicture {
  std::filesystem::path image;  // where it is now
  std::string name;             // where the file looks for it, relative to itself
};

}  // namespace stucco
