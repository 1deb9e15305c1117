// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco::simulate {

// std::floor is a call where processors of 2003 are to run the program. Requires a value that an
// int holds.
inline int Floor(float value) {
  const int whole = static_cast<int>(value);
  return whole - (value < static_cast<float>(whole) ? 1 : 0);
}

}  // namespace stucco::simulate
