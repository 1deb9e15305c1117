// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pipeline/engine/run.h"
#include "pipeline/engine/stages.h"
#include "pipeline/engine/status.h"
#include "tests/survey/temporary_folder.h"

namespace stucco {

// A survey in a temporary folder with five stages that only hash and copy, so that tests see the
// orchestrator and nothing else:
//   ingest -> calib -> dense, ingest -> side, all -> report (which reports failures)
// calib computes a unit per photo ("features") and per pair of photos ("pair"). Outputs depend on
// the options `size` and on the inputs, not on the option `pause_us` of a unit.
class FakeSurvey {
 public:
  FakeSurvey();

  // A JPEG photo whose content depends on `seed`.
  void AddPhoto(const std::string& name, int seed);
  void SetOption(const std::string& name, const std::string& toml_value);  // "calib.size", "3"

  RunResult Run(RunOptions options = {});
  SurveyStatus Status() { return GetStatus(survey, table, platform); }

  // What the last Run did: stages that ran.
  static std::set<std::string> Ran(const RunResult& result);
  // Content of all output files by path, without .stucco and survey.toml.
  std::map<std::string, std::string> Outputs() const;
  // How often each computed unit is in the event log.
  std::map<std::string, int> ComputedUnits() const;
  std::vector<std::string> Events(const std::string& event) const;  // raw lines of one kind

  test::TemporaryFolder folder;
  std::filesystem::path root, survey, photos;
  StageTable table;
  // Called in a running stage after its units and before it returns.
  std::function<void(const std::string& stage, StageContext& context)> during;
  std::string log;  // what Run told on its console
  // The real one, but interrupted as long as `interrupted` is set.
  Platform platform = RealPlatform();
  std::atomic<bool> interrupted = false;

 private:
  void WriteSettings() const;

  std::map<std::string, std::map<std::string, std::string>> options_;
};

// A run in a process of its own, which tests can kill; it exits with the run's exit code.
pid_t StartRun(FakeSurvey& fake);

// Of file systems that cannot do what most can.
Platform WithoutLocks();
Platform WithoutExchange();

// The reasons of a stage in a status or run, joined.
std::string ReasonsOf(const SurveyStatus& status, const std::string& stage);
std::string StateOf(const SurveyStatus& status, const std::string& stage);
const StageOutcome& OutcomeOf(const RunResult& result, const std::string& stage);

}  // namespace stucco
