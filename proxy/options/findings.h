// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace stucco {

// What was found on the way: one line each for the log.
struct ProxyFindings {
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  // Where the plan's map and the cloud disagree: for the log, and kept (Proxy::findings). Those
  // that something is missing by are warnings.
  struct OfMap {
    std::string text;
    bool warns = false;
  };
  std::vector<OfMap> of_map;
  std::vector<std::string> of_model;  // what photos show and the model lacks; kept, too
};

}  // namespace stucco
