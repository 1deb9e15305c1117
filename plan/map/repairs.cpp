// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/repairs.h"

#include <fmt/format.h>

#include <map>

namespace stucco::plan {

std::vector<std::string> RepairLog::Lines() const {
  constexpr int kMostLines = 20;
  constexpr size_t kNamed = 3;
  std::map<std::string, std::vector<std::string>> buildings;
  for (const auto& [building, what] : entries_) buildings[what].push_back(building);
  std::vector<std::string> lines;
  for (const auto& [building, what] : entries_) {
    std::vector<std::string>& alike = buildings.at(what);
    if (alike.size() <= kMostLines) {
      lines.push_back(building.empty() ? what : fmt::format("{}: {}", building, what));
    } else if (alike.size() > kMostLines && !alike.front().empty()) {
      std::string names;
      for (size_t i = 0; i < kNamed; ++i) names += alike[i] + ", ";
      lines.push_back(fmt::format("{} buildings ({}...): {}", alike.size(), names, what));
      alike.assign(alike.size(), "");  // said
    }
  }
  return lines;
}

}  // namespace stucco::plan
