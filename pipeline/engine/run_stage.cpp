// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/run_stage.h"

#include <fmt/format.h>

#include "pipeline/engine/events.h"
#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/outputs.h"
#include "pipeline/engine/progress.h"
#include "pipeline/engine/units.h"
#include "pipeline/engine/work_folder.h"

namespace stucco {
namespace {

DiskUnits MakeUnits(const StageJob& job, EventLog& events) {
  const std::string stage = job.stage.name;
  return DiskUnits(WorkFolder(job.paths.survey).Units(stage),
                   [stage, &events](std::string_view kind, std::string_view key, size_t bytes) {
                     events.Write("unit", {{"stage", stage},
                                           {"kind", std::string(kind)},
                                           {"key", std::string(key)},
                                           {"bytes", static_cast<int64_t>(bytes)}});
                   });
}

// The stage itself, up to its outputs being in place.
void ComputeAndPublish(const StageJob& job, const Platform& platform, Console& console,
                       EventLog& events, UnitStore& units) {
  ScratchFolder scratch(job.paths.survey, job.stage.name);
  {
    StageProgress progress(job.stage.name, console, events, platform.interrupted);
    StageContext context;
    context.survey = job.paths.survey;
    context.photos = job.paths.photos;
    context.out = scratch.path();
    context.threads = job.threads;
    context.memory_limit_bytes = job.memory_limit_bytes;
    context.progress = &progress;
    context.units = &units;
    context.statuses = job.statuses;
    job.bound.run(context);
    context.ThrowIfCancelled();
  }
  if (const auto moved = scratch.Publish(platform)) {
    const std::string text =
        fmt::format("{} was not made by stucco and is now {}; remove it when you do not need it",
                    (job.paths.survey / job.stage.name).string(), moved->string());
    console.Warning(fmt::format("  {}: warning: {}", job.stage.name, text));
    events.Write("warning", {{"stage", job.stage.name}, {"text", text}});
  }
}

void RecordFailure(const Failure& failure, const SurveyPaths& paths, EventLog& events) {
  events.Write("stage_failed", {{"stage", failure.stage},
                                {"kind", failure.kind},
                                {"why", failure.why},
                                {"remedy", failure.remedy},
                                {"wall_s", failure.usage.wall_s},
                                {"cpu_s", failure.usage.cpu_s},
                                {"cores", int64_t{failure.usage.cores}}});
  try {
    WriteFailure(failure, WorkFolder(paths.survey).Failure(failure.stage));
  } catch (const std::exception&) {
    // On a full disk the message on the terminal is all there is.
  }
}

}  // namespace

std::map<std::string, std::string> HashOutputs(const std::filesystem::path& survey,
                                               const std::string& stage, int threads,
                                               HashCache& hashes) {
  const std::vector<std::string> files = FilesBelow(survey / stage);
  const std::vector<std::string> contents = HashFiles(survey / stage, files, threads, hashes);
  std::map<std::string, std::string> outputs;
  for (size_t i = 0; i < files.size(); ++i) {
    outputs[stage + "/" + files[i]] = contents[i];
  }
  return outputs;
}

StageRunResult RunStage(const StageJob& job, const Platform& platform, Console& console,
                        EventLog& events, HashCache& hashes) {
  const std::string& name = job.stage.name;
  const WorkFolder work(job.paths.survey);
  const UsageMeter meter;
  DiskUnits units = MakeUnits(job, events);
  StageRunResult result;
  try {
    ComputeAndPublish(job, platform, console, events, units);
    Manifest manifest;
    manifest.stage = name;
    manifest.program = ProgramVersion();
    manifest.fingerprint = job.fingerprint;
    manifest.outputs = HashOutputs(job.paths.survey, name, job.threads, hashes);
    manifest.usage = meter.Read();
    manifest.units = units.counts();
    WriteManifest(manifest, work.Manifest(name));
    result.manifest = std::move(manifest);
  } catch (...) {
    const Error error = AsError(std::current_exception());
    if (error.kind() == ErrorKind::kInterrupted || platform.interrupted()) {
      events.Write("interrupted", {{"stage", name}});
      throw Error(ErrorKind::kInterrupted, fmt::format("interrupted during {}", name),
                  error.remedy());
    }
    result.failure = Failure{name,           KindName(error.kind()), error.what(),
                             error.remedy(), meter.Read(),           job.fingerprint};
    RecordFailure(*result.failure, job.paths, events);
    return result;
  }
  std::error_code ignored;
  std::filesystem::remove(work.Failure(name), ignored);
  units.DeleteUntouched();
  return result;
}

}  // namespace stucco
