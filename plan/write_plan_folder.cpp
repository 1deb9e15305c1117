// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/field/checklist.h"
#include "plan/make_plan.h"
#include "plan/mission/mission.h"
#include "plan/output/coverage_map.h"
#include "plan/output/match_map.h"
#include "plan/output/preview.h"
#include "survey/files.h"
#include "survey/plan_io.h"

namespace stucco::plan {

std::vector<std::string> WritePlanFolder(const PlanResult& result, const PlanOptions& options,
                                         const std::filesystem::path& folder) {
  const CameraPreset camera = FindCamera(options.camera);
  MissionOptions mission;
  mission.pace = result.plan.pace;
  mission.dji = {camera.dji_drone, camera.dji_drone_sub, camera.dji_payload};
  WritePlan(result.plan, folder / "plan.json");
  WriteStats(result.stats, folder / "stats.json");
  WriteFile(folder / "preview.svg", PreviewSvg(result.plan, result.stats));
  WriteFile(folder / "coverage.svg", CoverageSvg(result.plan, result.coverage));
  WriteFile(folder / "matches.svg", MatchSvg(result.plan));
  const FieldFacts facts = {result.flights, WriteMissionFiles(result.plan, mission, folder),
                            result.days, ProposeGroundPoints(result.plan, result.coverage)};
  WriteFile(folder / "checklist.html", ChecklistHtml(result.plan, result.stats, facts));
  return facts.missions.notes;
}

}  // namespace stucco::plan
