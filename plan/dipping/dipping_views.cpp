// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/dipping_views.h"

#include <chrono>
#include <iterator>

#include "plan/dipping/candidates.h"
#include "plan/dipping/directions.h"
#include "plan/dipping/lift.h"
#include "plan/dipping/optimise.h"
#include "plan/dipping/select.h"

namespace stucco::plan {
DippingReport PlanDippingViews(const DippingSetting& setting, Progress& progress) {
  DippingReport report;
  std::vector<Level> levels = SplitIntoLevels(setting.site);
  progress.Begin("dipping views", levels.size());
  for (Level& level : levels) {
    std::vector<Candidate> candidates = FindCandidates(level, setting);
    LimitReach(setting, level, candidates);
    std::vector<double> turns = InitialTurns(level, setting, candidates);
    std::vector<DippingPoint> points = SelectPoints(setting, ViewsOf(setting, candidates, turns));
    report.candidates += static_cast<int>(candidates.size());
    const auto start = std::chrono::steady_clock::now();
    report.rounds += OptimiseViews(level, setting, turns, points).rounds;
    report.optimise_s +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.points += static_cast<int>(points.size());
    for (const DippingPoint& point : points) {
      std::vector<Hover> hovers = Lift(level, setting, point);
      std::move(hovers.begin(), hovers.end(), std::back_inserter(report.hovers));
    }
    progress.Advance();
  }
  return report;
}

}  // namespace stucco::plan
