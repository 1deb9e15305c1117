// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/assess.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/work_folder.h"

namespace stucco {
namespace {

std::vector<std::string> OutputProblems(const Manifest& manifest, const SurveyPaths& paths,
                                        int threads, HashCache& hashes) {
  std::vector<std::string> files, problems;
  for (const auto& [file, hash] : manifest.outputs) {
    files.push_back(file);
  }
  const std::vector<std::string> contents = HashFiles(paths.survey, files, threads, hashes);
  for (size_t i = 0; i < files.size(); ++i) {
    std::error_code error;
    if (!std::filesystem::exists(paths.survey / files[i], error)) {
      problems.push_back(fmt::format("output {} is gone", files[i]));
    } else if (contents[i] != manifest.outputs.at(files[i])) {
      problems.push_back(fmt::format("output {} was changed or damaged", files[i]));
    }
  }
  return problems;
}

}  // namespace

std::string Name(StageState state) {
  switch (state) {
    case StageState::kDone:
      return "done";
    case StageState::kStale:
      return "stale";
    case StageState::kMissing:
      return "missing";
    case StageState::kFailed:
      return "failed";
  }
  return {};
}

Assessment Assess(const Stage& stage, const SurveyPaths& paths, const Fingerprint& now, int threads,
                  HashCache& hashes) {
  const WorkFolder work(paths.survey);
  Assessment result;
  ManifestFile file = ReadManifest(work.Manifest(stage.name));
  std::error_code error;
  if (file.manifest) {
    result.manifest = std::move(file.manifest);
    if (result.manifest->imported_from.empty()) {
      result.reasons = Differences(stage.name, result.manifest->fingerprint, now);
    }
    for (std::string& problem : OutputProblems(*result.manifest, paths, threads, hashes)) {
      result.reasons.push_back(std::move(problem));
    }
    result.state = result.reasons.empty() ? StageState::kDone : StageState::kStale;
  } else if (!file.problem.empty()) {
    result.state = StageState::kStale;
    result.reasons.push_back(file.problem);
  } else if (std::filesystem::exists(paths.survey / stage.name, error)) {
    result.state = StageState::kStale;
    result.reasons.push_back(fmt::format("folder {} has no manifest", stage.name));
  } else {
    result.reasons.emplace_back("not made yet");
  }
  if (result.state != StageState::kDone) {
    std::optional<Failure> failure = ReadFailure(work.Failure(stage.name));
    // One of other options or inputs says nothing about what is there now.
    if (failure && failure->fingerprint == now) {
      result.failure = std::move(failure);
      result.state = StageState::kFailed;
      result.reasons = {result.failure->why};
    }
  }
  return result;
}

void ApplyNeeds(const Stage& stage, const std::map<std::string, StageState>& states,
                Assessment& assessment) {
  const bool imported = assessment.manifest && !assessment.manifest->imported_from.empty();
  const bool settled =
      assessment.state == StageState::kDone || assessment.state == StageState::kStale;
  if (imported || !settled) {
    return;
  }
  const bool some_failed =
      std::any_of(stage.needs.begin(), stage.needs.end(), [&](const std::string& need) {
        const auto state = states.find(need);
        return state != states.end() && state->second == StageState::kFailed;
      });
  if (stage.reports_failures && some_failed) {
    return;
  }
  std::vector<std::string> changing;
  for (const std::string& need : stage.needs) {
    const auto state = states.find(need);
    if (state == states.end() || state->second == StageState::kDone) {
      continue;
    }
    // Says the same in other words.
    std::erase(assessment.reasons, fmt::format("input {} changed", StateInput(need)));
    changing.push_back(fmt::format(
        "{} {}", need, state->second == StageState::kFailed ? "failed" : "will change"));
  }
  if (!changing.empty()) {
    assessment.state = StageState::kStale;
    assessment.reasons.insert(assessment.reasons.end(), changing.begin(), changing.end());
  }
}

std::string JoinReasons(const std::vector<std::string>& reasons) {
  constexpr size_t kShown = 3;
  std::string text;
  for (size_t i = 0; i < reasons.size() && i < kShown; ++i) {
    text += (i > 0 ? "; " : "") + reasons[i];
  }
  if (reasons.size() > kShown) {
    text += fmt::format("; and {} more", reasons.size() - kShown);
  }
  return text;
}

const Usage* UsageOf(const Assessment& assessment) {
  if (assessment.failure) {
    return &assessment.failure->usage;
  }
  return assessment.manifest ? &assessment.manifest->usage : nullptr;
}

StageStatus ToStatus(const std::string& stage, const Assessment& assessment) {
  StageStatus status;
  status.stage = stage;
  status.state = Name(assessment.state);
  status.why = JoinReasons(assessment.reasons);
  if (assessment.failure) {
    status.remedy = assessment.failure->remedy;
  }
  if (const Usage* usage = UsageOf(assessment)) {
    status.wall_s = usage->wall_s;
    status.cpu_s = usage->cpu_s;
    status.peak_memory_mb = usage->peak_memory_mb;
  }
  return status;
}

}  // namespace stucco
