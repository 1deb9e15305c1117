// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "survey/error.h"

namespace stucco {
namespace {

std::vector<std::string> NamesOf(const StageTable& table) {
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const Stage& stage : table) names.push_back(stage.name);
  return names;
}

bool IsIn(const std::vector<std::string>& stages, const std::string& stage) {
  return std::find(stages.begin(), stages.end(), stage) != stages.end();
}

}  // namespace

bool Selection::Contains(const std::string& stage) const {
  return IsIn(stages, stage);
}
bool Selection::IsForced(const std::string& stage) const {
  return IsIn(forced, stage);
}
bool Selection::IsBeforeFirst(const std::string& stage) const {
  return IsIn(before_first, stage);
}

Selection Select(const StageTable& table, const RunOptions& options) {
  Selection selection;
  if (!options.goal.empty()) {
    selection.stages = WithNeeds(table, options.goal);
    if (options.force) {
      selection.forced = {options.goal};
    }
    return selection;
  }
  const Stage& first = options.from.empty() ? table.front() : GetStage(table, options.from);
  const Stage& last = options.until.empty() ? table.back() : GetStage(table, options.until);
  if (&first > &last) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--from {} comes after --until {}", first.name, last.name),
                fmt::format("the order of the stages is {}", fmt::join(NamesOf(table), ", ")));
  }
  const std::vector<std::string> needed = WithNeeds(table, last.name);
  for (const Stage& stage : table) {
    if (&stage < &first) {
      selection.before_first.push_back(stage.name);
    } else if (&stage <= &last && (options.until.empty() || IsIn(needed, stage.name))) {
      selection.stages.push_back(stage.name);
    }
  }
  if (options.force) {
    selection.forced = selection.stages;
  }
  return selection;
}

}  // namespace stucco
