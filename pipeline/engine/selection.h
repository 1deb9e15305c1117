// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/engine/run_options.h"
#include "pipeline/engine/stages.h"

namespace stucco {

// Which stages a run looks at, and which of them run even when they are up to date.
struct Selection {
  std::vector<std::string> stages;  // in the table's order
  std::vector<std::string> forced;
  std::vector<std::string> before_first;  // needed ones that --from takes as they are

  bool Contains(const std::string& stage) const;
  bool IsForced(const std::string& stage) const;
  bool IsBeforeFirst(const std::string& stage) const;
};

// Throws Error (kUsage) for unknown stages and for --from after --until.
Selection Select(const StageTable& table, const RunOptions& options);

}  // namespace stucco
