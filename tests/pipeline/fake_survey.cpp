// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/pipeline/fake_survey.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "pipeline/engine/fingerprint.h"
#include "pipeline/engine/work_folder.h"
#include "pipeline/verbs/run.h"
#include "survey/files.h"
#include "survey/image.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

struct FakeOptions {
  int size = 1;
  int pause_us = 0;
};

void DescribeFake(OptionTable& table, FakeOptions& options) {
  table.Add("size", options.size, 0, 1000, "Written into the output.");
  table.Add("pause_us", options.pause_us, 0, 1'000'000, "Time that a unit takes, microseconds.")
      .affects_result = false;
}

void Write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  WriteFile(path, text);
}

std::string FakeUnit(const StageContext& context, const FakeOptions& options,
                     const std::string& kind, const std::string& content) {
  const std::string key = HashBytes(fmt::format("{} {} {}", kind, options.size, content));
  return ComputeUnit(context, kind, key, [&] {
    std::this_thread::sleep_for(std::chrono::microseconds(options.pause_us));
    return kind + " of " + content + "\n";
  });
}

void FakeIngest(const FakeOptions& options, StageContext& context) {
  std::string text = fmt::format("size {}\n", options.size);
  for (const std::string& file : FilesBelow(context.photos)) {
    text += file + " " + HashFile(context.photos / file) + "\n";
  }
  Write(context.out / "list.txt", text);
}

std::vector<std::string> Lines(const fs::path& path) {
  std::vector<std::string> lines;
  std::istringstream in(ReadFile(path));
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

void FakeCalib(const FakeOptions& options, StageContext& context) {
  const std::vector<std::string> photos = Lines(context.survey / "ingest/list.txt");
  std::string features, pairs;
  context.progress->Begin("features", photos.size());
  for (const std::string& photo : photos) {
    features += FakeUnit(context, options, "features", photo);
    context.progress->Advance();
  }
  context.progress->Begin("pairs", photos.size());
  for (size_t i = 0; i < photos.size(); ++i) {
    for (size_t j = i + 1; j < photos.size(); ++j) {
      pairs += FakeUnit(context, options, "pair", photos[i] + photos[j]);
    }
    context.progress->Advance();
  }
  Write(context.out / "features.txt", features);
  Write(context.out / "sparse/0/pairs.txt", pairs);
}

// Output: everything that the stage may read, and its option.
void FakeCopy(const Stage& stage, const FakeOptions& options, StageContext& context) {
  std::string text = fmt::format("size {}\n", options.size);
  for (const std::string& input : stage.inputs) {
    const fs::path path = context.survey / input;
    text += input + " " + (fs::exists(path) ? HashFile(path) : "missing") + "\n";
  }
  for (const StageStatus& status : context.statuses) {
    text += fmt::format("{} {} {} {}\n", status.stage, status.state, status.why, status.remedy);
  }
  Write(context.out / "result.txt", text);
}

Stage MakeStage(FakeSurvey* owner, const std::string& name, std::vector<std::string> needs,
                std::vector<std::string> inputs) {
  Stage stage;
  stage.name = name;
  stage.title = "fake " + name;
  stage.needs = std::move(needs);
  stage.inputs = std::move(inputs);
  stage.photos_are_input = name == "ingest";
  stage.opens_photos = name == "ingest";
  stage.reports_failures = name == "report";
  stage.bind = [owner, stage] {
    auto options = std::make_shared<FakeOptions>();
    BoundStage bound{OptionTable(stage.name), [owner, stage, options](StageContext& context) {
                       if (stage.name == "ingest") {
                         FakeIngest(*options, context);
                       } else if (stage.name == "calib") {
                         FakeCalib(*options, context);
                       } else {
                         FakeCopy(stage, *options, context);
                       }
                       if (owner->during) {
                         owner->during(stage.name, context);
                       }
                     }};
    DescribeFake(bound.options, *options);
    return bound;
  };
  return stage;
}

}  // namespace

FakeSurvey::FakeSurvey() : root(folder.path()), survey(root / "survey"), photos(root / "photos") {
  table = {MakeStage(this, "ingest", {}, {}),
           MakeStage(this, "calib", {"ingest"}, {"ingest/list.txt"}),
           MakeStage(this, "side", {"ingest"}, {"ingest/list.txt"}),
           MakeStage(this, "dense", {"calib"}, {"calib/sparse/0/pairs.txt"}),
           MakeStage(this, "report", {"ingest", "calib", "side", "dense"},
                     {"side/result.txt", "dense/result.txt"})};
  fs::create_directories(survey);
  fs::create_directories(photos);
  for (int i = 0; i < 4; ++i) {
    AddPhoto(fmt::format("p{}.jpg", i), i);
  }
  WriteSettings();
  platform.interrupted = [this] { return interrupted.load(); };
}

void FakeSurvey::AddPhoto(const std::string& name, int seed) {
  Image image;
  image.width_px = 16;
  image.height_px = 8;
  image.data.resize(16 * 8 * 3);
  for (size_t i = 0; i < image.data.size(); ++i) {
    image.data[i] = static_cast<uint8_t>(40 * seed + 7 * (i / 24));
  }
  fs::create_directories((photos / name).parent_path());
  WriteImage(image, photos / name);
}

void FakeSurvey::WriteSettings() const {
  std::string text = "photos = \"../photos\"\n[run]\nthreads = 1\n";
  for (const auto& [section, values] : options_) {
    text += "[" + section + "]\n";
    for (const auto& [name, value] : values) {
      text += name + " = " + value + "\n";
    }
  }
  WriteFile(survey / "survey.toml", text);
}

void FakeSurvey::SetOption(const std::string& name, const std::string& toml_value) {
  const size_t dot = name.find('.');
  options_[name.substr(0, dot)][name.substr(dot + 1)] = toml_value;
  WriteSettings();
}

RunResult FakeSurvey::Run(RunOptions options) {
  std::FILE* file = std::tmpfile();
  RunResult result;
  const auto keep_log = [&] {
    std::rewind(file);
    log.clear();
    char part[4096];
    while (const size_t size = std::fread(part, 1, sizeof(part), file)) {
      log.append(part, size);
    }
    std::fclose(file);
  };
  try {
    Console console(file, false, Verbosity::kVerbose);
    result = RunSurvey(survey, table, options, console, platform);
  } catch (...) {
    keep_log();
    throw;
  }
  keep_log();
  return result;
}

std::set<std::string> FakeSurvey::Ran(const RunResult& result) {
  std::set<std::string> ran;
  for (const StageOutcome& outcome : result.stages) {
    if (outcome.action == StageAction::kRan) {
      ran.insert(outcome.stage);
    }
  }
  return ran;
}

std::map<std::string, std::string> FakeSurvey::Outputs() const {
  std::map<std::string, std::string> outputs;
  for (const std::string& file : FilesBelow(survey)) {
    if (!file.starts_with(".stucco/") && file != "survey.toml") {
      outputs[file] = ReadFile(survey / file);
    }
  }
  return outputs;
}

std::vector<std::string> FakeSurvey::Events(const std::string& event) const {
  std::vector<std::string> found;
  for (const std::string& line : Lines(WorkFolder(survey).Events())) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_object() && json.value("event", "") == event) {
      found.push_back(line);
    }
  }
  return found;
}

std::map<std::string, int> FakeSurvey::ComputedUnits() const {
  std::map<std::string, int> counts;
  for (const std::string& line : Events("unit")) {
    const auto json = nlohmann::json::parse(line);
    ++counts[json.at("stage").get<std::string>() + "/" + json.at("kind").get<std::string>() + "/" +
             json.at("key").get<std::string>()];
  }
  return counts;
}

pid_t StartRun(FakeSurvey& fake) {
  const pid_t child = fork();
  if (child == 0) {
    int code = 99;
    try {
      code = fake.Run().exit_code;
    } catch (const std::exception&) {
      code = 98;
    }
    _exit(code);
  }
  return child;
}

Platform WithoutLocks() {
  Platform platform = RealPlatform();
  platform.lock_file = [](int, LockMode) { return LockResult::kImpossible; };
  return platform;
}

Platform WithoutExchange() {
  Platform platform = RealPlatform();
  platform.exchange_folders = [](const fs::path&, const fs::path&) { return false; };
  return platform;
}

std::string ReasonsOf(const SurveyStatus& status, const std::string& stage) {
  for (const StageReport& report : status.stages) {
    if (report.stage == stage) {
      return fmt::format("{}", fmt::join(report.assessment.reasons, "; "));
    }
  }
  throw std::runtime_error("no such stage");
}

std::string StateOf(const SurveyStatus& status, const std::string& stage) {
  for (const StageReport& report : status.stages) {
    if (report.stage == stage) {
      return Name(report.assessment.state);
    }
  }
  throw std::runtime_error("no such stage");
}

const StageOutcome& OutcomeOf(const RunResult& result, const std::string& stage) {
  for (const StageOutcome& outcome : result.stages) {
    if (outcome.stage == stage) {
      return outcome;
    }
  }
  throw std::runtime_error("no such stage");
}

}  // namespace stucco
