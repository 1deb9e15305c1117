// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/run_proxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "proxy/abstract.h"
#include "proxy/map/facade_ids.h"
#include "proxy/output/elevations.h"
#include "proxy/output/proxy_files.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/plan_of_survey.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

// The plan is a prior: one that is of another place changes nothing.
void NameAfterPlan(const std::optional<Plan>& plan, const Georef& georef, Progress& progress,
                   Proxy& proxy) {
  const bool named = std::ranges::any_of(
      proxy.buildings, [](const Building& building) { return building.source == "map"; });
  if (!plan || named) return;
  if (georef.frame != "enu") {
    progress.Note("without positions nothing says which facade of the plan a wall is");
    return;
  }
  const FacadeNaming naming = NameFacades(*plan, georef, proxy);
  if (!naming.shift_m) {
    progress.Note("the walls are not where the plan has facades, and keep their own ids");
    return;
  }
  progress.Note(fmt::format(
      "{} of {} walls are parts of {} of the plan's {} facades, which the survey shows {:.1f} m "
      "east and {:.1f} m north of the plan",
      naming.named, naming.walls, naming.facades, plan->facades.size(), naming.shift_m->x(),
      naming.shift_m->y()));
}

}  // namespace

int PointsWithin(uint64_t memory_limit_bytes, int max_points) {
  constexpr uint64_t kBytesPerPoint = 400;  // 220 measured on 1.8 million, and some to spare
  constexpr uint64_t kFewest = 100000;
  const uint64_t room = std::max(kFewest, memory_limit_bytes / 2 / kBytesPerPoint);
  return static_cast<int>(std::min<uint64_t>(room, static_cast<uint64_t>(max_points)));
}

void RunProxy(const ProxyOptions& options, StageContext& context) {
  Progress& progress = *context.progress;
  progress.Begin("abstracting the cloud to planes", 3);
  // Nothing that ingest knows about a photo matters to the model: its captures are no input.
  const ProxyInput input{StreamOf(context.survey / kCloudFile),
                         JoinPhotos(ReadColmapModel(context.survey / kSparseFolder), {}),
                         ReadGeoref(context.survey / kGeorefFile), PlanOfSurvey(context)};
  context.ThrowIfCancelled();
  progress.Advance();
  ProxyFindings findings;
  ProxyOptions affordable = options;
  affordable.max_points = PointsWithin(context.memory_limit_bytes, options.max_points);
  if (affordable.max_points < options.max_points) {
    findings.notes.push_back(fmt::format("run.memory_limit_gb allows {} points of max_points {}",
                                         affordable.max_points, options.max_points));
  }
  Proxy proxy = AbstractCloud(input, affordable, context.threads, findings);
  for (const auto& note : findings.notes) progress.Note(note);
  for (const auto& [text, warns] : findings.of_map) {
    if (warns) {
      progress.Warn(text);
    } else {
      progress.Note(text);
    }
    proxy.findings.push_back(text);
  }
  for (const std::string& text : findings.of_model) {
    progress.Note(text);
    proxy.findings.push_back(text);
  }
  for (const auto& warning : findings.warnings) progress.Warn(warning);
  context.ThrowIfCancelled();
  progress.Advance();
  if (const auto problem = FindProblem(proxy)) {
    throw Error(ErrorKind::kStageFailed, "the planar model is not sound: " + *problem,
                "Please report this with the survey; proxy.solids = false may avoid it.");
  }
  NameAfterPlan(input.plan, input.georef, progress, proxy);
  WriteProxyFiles(proxy, context.out);
  WriteElevations(input.cloud, proxy, context.out / "elevations");
  progress.Advance();
}

}  // namespace stucco
