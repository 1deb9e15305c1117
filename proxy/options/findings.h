// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace stucco {

// What was found on the way: one line each for the log, the last ones are warnings.
struct ProxyFindings {
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
};

}  // namespace stucco
