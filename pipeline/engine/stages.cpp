// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "survey/error.h"

namespace stucco {

const Stage& GetStage(const StageTable& table, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Stage& stage) { return stage.name == name; });
  if (found != table.end()) {
    return *found;
  }
  std::string names, nearest;
  int nearest_distance = std::numeric_limits<int>::max();
  for (const Stage& stage : table) {
    names += (names.empty() ? "" : ", ") + stage.name;
    const int distance = EditDistance(stage.name, name);
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = stage.name;
    }
  }
  // Beyond this a guess would only confuse.
  const bool near = nearest_distance <= std::max<int>(2, static_cast<int>(name.size()) / 3);
  throw Error(
      ErrorKind::kUsage, fmt::format("there is no stage \"{}\"", name),
      near ? fmt::format("did you mean {}?", nearest) : fmt::format("the stages are {}", names));
}

std::vector<std::string> WithNeeds(const StageTable& table, std::string_view name) {
  std::set<std::string> wanted = {GetStage(table, name).name};
  std::vector<std::string> result;
  // Backwards: what a stage needs stands before it.
  for (auto stage = table.rbegin(); stage != table.rend(); ++stage) {
    if (wanted.contains(stage->name)) {
      wanted.insert(stage->needs.begin(), stage->needs.end());
      result.insert(result.begin(), stage->name);
    }
  }
  return result;
}

std::string FindProblem(const StageTable& table) {
  std::set<std::string> before;
  for (const Stage& stage : table) {
    for (const std::string& need : stage.needs) {
      if (!before.contains(need)) {
        return fmt::format("stage {} needs {}, which does not stand before it", stage.name, need);
      }
    }
    if (!before.insert(stage.name).second) {
      return fmt::format("stage {} is listed twice", stage.name);
    }
  }
  return {};
}

}  // namespace stucco
