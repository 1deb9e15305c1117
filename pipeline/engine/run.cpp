// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/run.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <chrono>

#include "pipeline/engine/assess.h"
#include "pipeline/engine/events.h"
#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/lock.h"
#include "pipeline/engine/outputs.h"
#include "pipeline/engine/progress.h"
#include "pipeline/engine/run_stage.h"
#include "pipeline/engine/selection.h"
#include "pipeline/engine/work_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr int kEventsVersion = 1;
constexpr std::chrono::seconds kHashesSaved(5);

Settings LoadRunSettings(const fs::path& survey, const StageTable& table,
                         const RunOptions& options) {
  Settings settings = LoadSettings(survey, table, options.set);
  if (options.threads > 0) {
    settings.run.threads = options.threads;
  }
  if (options.memory_limit_gb > 0) {
    settings.run.memory_limit_gb = options.memory_limit_gb;
  }
  return settings;
}

// "units: 55 features computed, 3 reused"
std::string UnitsText(const std::map<std::string, UnitCount>& units) {
  std::string text;
  for (const auto& [kind, count] : units) {
    text += fmt::format("{}{}: {} computed, {} reused", text.empty() ? "" : "; ", kind,
                        count.computed, count.reused);
  }
  return text;
}

class Runner {
 public:
  Runner(const fs::path& survey, const StageTable& table, const RunOptions& options,
         Console& console, const Platform& platform)
      : survey_(survey),
        table_(table),
        options_(options),
        console_(console),
        platform_(platform),
        settings_(LoadRunSettings(survey, table, options)),
        selection_(Select(table, options)),
        threads_(ResolvedThreads(settings_.run)),
        lock_(survey, options.command, platform),
        events_(WorkFolder(survey).Events()),
        hashes_(WorkFolder(survey).Hashes()) {}

  RunResult Run() {
    // Libraries that start threads of their own through TBB keep to the limit as well.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(threads_));
    Begin();
    for (const Stage& stage : table_) {
      if (platform_.interrupted()) {
        result_.interrupted = true;
      }
      if (!result_.interrupted) {
        VisitUntilInterrupted(stage);
      }
    }
    hashes_.Save();
    End();
    return std::move(result_);
  }

 private:
  void Begin() {
    events_.Write("run", {{"version", int64_t{kEventsVersion}},
                          {"program", ProgramVersion()},
                          {"pid", int64_t{getpid()}},
                          {"command", options_.command}});
    if (!lock_.held()) {
      Warn(fmt::format("{}: this file system has no locks", survey_.string()),
           "start no second run in this survey until this one has ended");
    }
    if (lock_.killed_owner()) {
      console_.Line(
          fmt::format("The run before this one ({}) did not end in order; its finished work is "
                      "used.",
                      Describe(*lock_.killed_owner())));
    }
    CleanScratch(survey_);
    hashes_.SaveEvery(kHashesSaved);
    if (options_.precheck) {
      options_.precheck(
          settings_, selection_.stages,
          [this](const std::string& what, const std::string& remedy) { Warn(what, remedy); });
    }
    ForgetForced();
  }

  // From here on forced stages count as not made: a run that continues after an interruption needs
  // no --force and repeats nothing.
  void ForgetForced() {
    const WorkFolder work(survey_);
    for (const std::string& stage : selection_.forced) {
      if (ReadManifest(work.Manifest(stage)).manifest) {
        MarkAsOurs(survey_, stage);
      }
      fs::remove_all(work.Units(stage));
      fs::remove(work.Failure(stage));
      fs::remove(work.Manifest(stage));
    }
  }

  void Warn(const std::string& what, const std::string& remedy) {
    console_.Warning(fmt::format("warning: {}: {}", what, remedy));
    events_.Write("warning", {{"text", what}});
  }

  void End() {
    Summarise();
    if (result_.interrupted) {
      result_.exit_code = ExitCode(ErrorKind::kInterrupted);
    }
    events_.Write("run_done", {{"exit_code", int64_t{result_.exit_code}}});
  }

  // Beside each other, the stages show where time went and where cores were idle. One stage alone
  // has said so already.
  void Summarise() {
    std::vector<const StageOutcome*> measured;
    Usage together;
    for (const StageOutcome& outcome : result_.stages) {
      if (outcome.usage.wall_s > 0) {
        measured.push_back(&outcome);
        together.wall_s += outcome.usage.wall_s;
        together.cpu_s += outcome.usage.cpu_s;
        together.cores = outcome.usage.cores;
      }
    }
    if (measured.size() < 2) {
      return;
    }
    console_.Line("Time and cores:");
    for (const StageOutcome* outcome : measured) {
      console_.Line(fmt::format("  {:<8} {}", outcome->stage, UsageText(outcome->usage)));
    }
    console_.Line(fmt::format("  {:<8} {}", "together", UsageText(together)));
  }

  // The first stage that this one needs and that is known to have failed or been blocked.
  std::string Blocker(const Stage& stage) const {
    for (const StageOutcome& outcome : result_.stages) {
      const bool needed =
          std::find(stage.needs.begin(), stage.needs.end(), outcome.stage) != stage.needs.end();
      if (needed &&
          (outcome.action == StageAction::kFailed || outcome.action == StageAction::kBlocked)) {
        return outcome.stage;
      }
    }
    return {};
  }

  void VisitUntilInterrupted(const Stage& stage) {
    try {
      Visit(stage);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::kInterrupted) {
        throw;
      }
      events_.Write("interrupted", {{"stage", stage.name}});
      console_.Warning(fmt::format("{}; what was finished is kept", e.what()));
      result_.interrupted = true;
    }
  }

  Fingerprint FingerprintNow(const Stage& stage, const SurveyPaths& paths) {
    StageProgress progress(stage.name, console_, events_, platform_.interrupted);
    return TakeFingerprint(stage, settings_.stages.at(stage.name),
                           {paths, statuses_, threads_, hashes_, progress});
  }

  void Visit(const Stage& stage) {
    const BoundStage& bound = settings_.stages.at(stage.name);
    const SurveyPaths paths{survey_, settings_.photos};
    const std::string blocker = stage.reports_failures ? "" : Blocker(stage);
    // What went wrong is reported also by a run that was asked for less.
    const bool selected =
        selection_.Contains(stage.name) || (stage.reports_failures && !FirstFailed().empty());
    Fingerprint now = FingerprintNow(stage, paths);
    Assessment assessment = Assess(stage, paths, now, threads_, hashes_);
    ApplyNeeds(stage, states_, assessment);
    if (selected && blocker.empty() && assessment.state != StageState::kDone) {
      if (selection_.IsForced(stage.name)) {
        assessment.reasons = {"asked for with --force"};
      }
      RunOne({stage, bound, paths, std::move(now), statuses_, threads_,
              static_cast<uint64_t>(settings_.run.memory_limit_gb * (1 << 30))},
             assessment);
    } else {
      Pass(stage, selected, blocker, assessment);
    }
    // What --from takes as it is does not make later stages stale.
    states_[stage.name] =
        selection_.IsBeforeFirst(stage.name) ? StageState::kDone : assessment.state;
    statuses_.push_back(ToStatus(stage.name, assessment));
  }

  // A stage that does not run: up to date, not asked for, or blocked.
  void Pass(const Stage& stage, bool selected, const std::string& blocker,
            const Assessment& assessment) {
    StageOutcome outcome;
    outcome.stage = stage.name;
    if (!selected) {
      if (assessment.state != StageState::kDone && selection_.IsBeforeFirst(stage.name)) {
        const bool is_there = fs::exists(survey_ / stage.name);
        console_.Warning(
            fmt::format("warning: {} is {} ({}) and is {}", stage.name, Name(assessment.state),
                        JoinReasons(assessment.reasons),
                        is_there ? "taken as it is" : "left out: a run without --from makes it"));
      }
    } else if (!blocker.empty()) {
      outcome.action = StageAction::kBlocked;
      outcome.reasons = {fmt::format("{} failed", FirstFailed())};
      console_.Line(fmt::format("{}: not run, because {}", stage.name, outcome.reasons.front()));
      events_.Write("stage_blocked", {{"stage", stage.name}, {"why", outcome.reasons.front()}});
    } else {
      outcome.action = StageAction::kUpToDate;
      console_.Line(fmt::format("{}: up to date", stage.name));
      events_.Write("stage_up_to_date", {{"stage", stage.name}});
    }
    result_.stages.push_back(std::move(outcome));
  }

  std::string FirstFailed() const {
    for (const StageOutcome& outcome : result_.stages) {
      if (outcome.action == StageAction::kFailed) {
        return outcome.stage;
      }
    }
    return {};
  }

  void RunOne(const StageJob& job, Assessment& assessment) {
    const std::string& name = job.stage.name;
    console_.Line(
        fmt::format("{}: {} ({})", name, job.stage.title, JoinReasons(assessment.reasons)));
    events_.Write("stage", {{"stage", name}, {"why", JoinReasons(assessment.reasons)}});
    StageOutcome outcome;
    outcome.stage = name;
    outcome.reasons = assessment.reasons;
    StageRunResult ran;
    try {
      ran = RunStage(job, platform_, console_, events_, hashes_);
    } catch (const Error& e) {
      console_.Warning(fmt::format("{}; what was finished is kept", e.what()));
      result_.interrupted = true;
      outcome.action = StageAction::kInterrupted;
      result_.stages.push_back(std::move(outcome));
      return;
    }
    hashes_.Save();
    assessment.manifest = std::move(ran.manifest);
    assessment.failure = ran.failure;
    if (ran.failure) {
      Failed(*ran.failure, outcome, assessment);
    } else {
      Succeeded(*assessment.manifest, outcome, assessment);
    }
    result_.stages.push_back(std::move(outcome));
  }

  void Succeeded(const Manifest& manifest, StageOutcome& outcome, Assessment& assessment) {
    outcome.action = StageAction::kRan;
    outcome.usage = manifest.usage;
    outcome.units = manifest.units;
    assessment.state = StageState::kDone;
    assessment.reasons.clear();
    console_.Line(fmt::format("{}: done in {}, {} of memory", outcome.stage,
                              UsageText(outcome.usage), MemoryText(outcome.usage.peak_memory_mb)));
    if (!outcome.units.empty()) {
      console_.Detail(fmt::format("  {}: {}", outcome.stage, UnitsText(outcome.units)));
    }
    events_.Write("stage_done", {{"stage", outcome.stage},
                                 {"wall_s", outcome.usage.wall_s},
                                 {"cpu_s", outcome.usage.cpu_s},
                                 {"cores", int64_t{outcome.usage.cores}},
                                 {"peak_memory_mb", outcome.usage.peak_memory_mb}});
  }

  void Failed(const Failure& failure, StageOutcome& outcome, Assessment& assessment) {
    outcome.action = StageAction::kFailed;
    outcome.usage = failure.usage;
    outcome.failure = failure;
    assessment.state = StageState::kFailed;
    assessment.reasons = {failure.why};
    if (result_.exit_code == 0) {
      result_.exit_code = ExitCode(KindFromName(failure.kind));
    }
    console_.Warning(fmt::format("{}: failed: {}{}", failure.stage, failure.why,
                                 failure.remedy.empty() ? "" : "\n  " + failure.remedy));
  }

  const fs::path& survey_;
  const StageTable& table_;
  const RunOptions& options_;
  Console& console_;
  const Platform& platform_;
  const Settings settings_;
  const Selection selection_;
  const int threads_;
  const SurveyLock lock_;
  EventLog events_;
  HashCache hashes_;
  std::map<std::string, StageState> states_;
  std::vector<StageStatus> statuses_;
  RunResult result_;
};

}  // namespace

std::string Name(StageAction action) {
  switch (action) {
    case StageAction::kUpToDate:
      return "up_to_date";
    case StageAction::kRan:
      return "ran";
    case StageAction::kFailed:
      return "failed";
    case StageAction::kInterrupted:
      return "interrupted";
    case StageAction::kBlocked:
      return "blocked";
    case StageAction::kSkipped:
      return "skipped";
  }
  return {};
}

RunResult Run(const fs::path& survey, const StageTable& table, const RunOptions& options,
              Console& console, const Platform& platform) {
  assert(FindProblem(table).empty());
  return Runner(survey, table, options, console, platform).Run();
}

}  // namespace stucco
