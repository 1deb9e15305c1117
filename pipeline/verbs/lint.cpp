// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/lint.h"

#include "plan/mission/wpml_lint.h"

namespace stucco {

std::vector<MissionFault> LintMission(const std::filesystem::path& kmz) {
  std::vector<MissionFault> faults;
  for (const plan::LintFinding& finding : plan::LintKmz(kmz)) {
    faults.push_back({finding.element, finding.rule, finding.text});
  }
  return faults;
}

}  // namespace stucco
