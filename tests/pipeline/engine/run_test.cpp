// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "pipeline/engine/work_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/burn.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using std::string_literals::operator""s;
using testing::HasSubstr;

using Stages = std::set<std::string>;
const Stages kAll = {"ingest", "calib", "side", "dense", "report"};

TEST(Run, MakesEverythingAndThenNothing) {
  FakeSurvey fake;
  const RunResult first = fake.Run();
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_EQ(FakeSurvey::Ran(first), kAll);
  EXPECT_EQ(fake.Outputs().size(), 6u);
  EXPECT_EQ(OutcomeOf(first, "calib").units.at("features").computed, 5);
  const RunResult second = fake.Run();
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_EQ(FakeSurvey::Ran(second), Stages());
  EXPECT_EQ(StateOf(fake.Status(), "report"), "done");
}

TEST(Run, AChangedOptionRunsExactlyItsDependants) {
  FakeSurvey fake;
  fake.Run();
  fake.SetOption("calib.size", "2");
  const SurveyStatus status = fake.Status();
  EXPECT_EQ(ReasonsOf(status, "calib"), "option calib.size changed from 1 to 2");
  EXPECT_EQ(ReasonsOf(status, "dense"), "calib will change");
  EXPECT_EQ(ReasonsOf(status, "report"), "calib will change; dense will change");
  EXPECT_EQ(StateOf(status, "side"), "done");
  // The fake's pairs do not hold the option, so dense sees the same bytes and has nothing to do.
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), (Stages{"calib"}));
  fake.SetOption("side.size", "2");
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), (Stages{"side", "report"}));
  fake.SetOption("ingest.size", "2");
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), kAll);
}

TEST(Run, AnOptionWithoutEffectOnResultsRunsNothing) {
  FakeSurvey fake;
  fake.Run();
  fake.SetOption("calib.pause_us", "3");
  RunOptions options;
  options.threads = 2;
  options.memory_limit_gb = 1;
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(options)), Stages());
}

TEST(Run, AnAddedPhotoComputesOnlyItsUnits) {
  FakeSurvey fake;
  fake.Run();
  fake.AddPhoto("p9.jpg", 9);
  EXPECT_EQ(ReasonsOf(fake.Status(), "ingest"), "input photos/p9.jpg is new");
  const RunResult result = fake.Run();
  const auto& units = OutcomeOf(result, "calib").units;
  EXPECT_EQ(units.at("features").computed, 1);
  EXPECT_EQ(units.at("features").reused, 5);
  EXPECT_EQ(units.at("pair").computed, 5);
}

TEST(Run, AChangedPhotoRunsAndATouchedOneDoesNot) {
  FakeSurvey fake;
  fake.Run();
  fs::last_write_time(fake.photos / "p1.jpg", fs::file_time_type::clock::now());
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), Stages());
  const auto time = fs::last_write_time(fake.photos / "p1.jpg");
  fake.AddPhoto("p1.jpg", 77);
  fs::last_write_time(fake.photos / "p1.jpg", time);  // the time lies, the content does not
  EXPECT_EQ(ReasonsOf(fake.Status(), "ingest"), "input photos/p1.jpg changed");
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), kAll);
}

TEST(Run, AMovedPhotoFolderChangesNothing) {
  FakeSurvey fake;
  fake.Run();
  fs::rename(fake.photos, fake.root / "elsewhere");
  std::string settings = ReadFile(fake.survey / "survey.toml");
  settings.replace(settings.find("../photos"), 9, "../elsewhere");
  WriteFile(fake.survey / "survey.toml", settings);
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), Stages());
}

TEST(Run, OddFileNamesAndLinkedFoldersAreSeen) {
  FakeSurvey fake;
  fake.AddPhoto("\xff\xfe.jpg", 5);  // not UTF-8
  fake.AddPhoto("a \"quoted\" \n name.jpg", 6);
  fs::create_directories(fake.root / "card");
  fs::create_directory_symlink(fake.root / "card", fake.photos / "card");
  fs::create_directory_symlink(fake.photos, fake.root / "card" / "loop");
  fake.Run();
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), Stages());
  WriteFile(fake.root / "card/late.jpg", ReadFile(fake.photos / "p1.jpg"));
  EXPECT_EQ(ReasonsOf(fake.Status(), "ingest"), "input photos/card/late.jpg is new");
  WriteFile(fake.photos / ".DS_Store", "a file manager was here");
  fake.Run();
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), Stages());
}

TEST(Run, UnitsOfPhotosThatWentAwayAreRemoved) {
  FakeSurvey fake;
  fake.Run();
  const auto count = [&] { return FilesBelow(WorkFolder(fake.survey).Units("calib")).size(); };
  EXPECT_EQ(count(), 5u + 10u);
  fs::remove(fake.photos / "p3.jpg");
  fake.Run();
  EXPECT_EQ(count(), 4u + 6u);
}

TEST(Run, ADamagedOutputIsMadeAgain) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  WriteFile(fake.survey / "dense/result.txt", "damaged");
  EXPECT_EQ(ReasonsOf(fake.Status(), "dense"), "output dense/result.txt was changed or damaged");
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), (Stages{"dense"}));
  EXPECT_EQ(fake.Outputs(), outputs);
  fs::remove(fake.survey / "dense/result.txt");
  EXPECT_EQ(ReasonsOf(fake.Status(), "dense"), "output dense/result.txt is gone");
  fake.Run();
  EXPECT_EQ(fake.Outputs(), outputs);
}

TEST(Run, ADamagedManifestMeansAgainAndNeverACrash) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  const fs::path path = WorkFolder(fake.survey).Manifest("side");
  const std::string good = ReadFile(path);
  std::string flipped = good;
  flipped[flipped.find("result.txt")] = 'R';  // still JSON
  for (const std::string& bad :
       {""s, "{"s, "[]"s, "null"s, good.substr(0, good.size() / 2), flipped, "\xff\xfe"s,
        "{\"version\": 99}"s, "{\"version\": \"1\"}"s}) {
    WriteFile(path, bad);
    EXPECT_EQ(StateOf(fake.Status(), "side"), "stale") << bad;
    EXPECT_THAT(ReasonsOf(fake.Status(), "side"), HasSubstr("manifest side.json")) << bad;
    EXPECT_EQ(FakeSurvey::Ran(fake.Run()), (Stages{"side"})) << bad;
    EXPECT_EQ(fake.Outputs(), outputs);
  }
}

TEST(Run, ADamagedUnitIsComputedAgain) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  const fs::path units = WorkFolder(fake.survey).Units("calib");
  std::string first = FilesBelow(units).front();
  std::string bytes = ReadFile(units / first);
  bytes.back() ^= 1;
  WriteFile(units / first, bytes);
  RunOptions options;
  fs::remove_all(fake.survey / "calib");
  const RunResult result = fake.Run(options);
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").computed, 1);
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").reused, 4);
  EXPECT_EQ(fake.Outputs(), outputs);
}

TEST(Run, DamagedCachesAndLogsAreNoProblem) {
  FakeSurvey fake;
  fake.Run();
  WriteFile(WorkFolder(fake.survey).Hashes(), "stucco-hashes 1 00\nnonsense");
  WriteFile(WorkFolder(fake.survey).Events(), "{\"event\": \"run\", \"ver");  // torn
  WriteFile(WorkFolder(fake.survey).Lock(), "\xff no owner");
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), Stages());
  EXPECT_EQ(fake.Events("run").size(), 1u);
  EXPECT_EQ(fake.Events("run_done").size(), 1u);
}

TEST(Run, UntilFromAndGoalChooseStages) {
  FakeSurvey fake;
  RunOptions until;
  until.until = "dense";
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(until)), (Stages{"ingest", "calib", "dense"}));
  RunOptions goal;
  goal.goal = "side";
  goal.force = true;
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(goal)), (Stages{"side"}));
  fake.SetOption("ingest.size", "5");
  RunOptions from;
  from.from = "dense";
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(from)), (Stages{"report"}));  // ingest is taken as it is
  EXPECT_THAT(fake.log, HasSubstr("warning: ingest is stale"));
  RunOptions bad;
  bad.from = "dense";
  bad.until = "calib";
  EXPECT_THROW(fake.Run(bad), Error);
  bad.until = "calibb";
  try {
    fake.Run(bad);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    EXPECT_THAT(e.remedy(), HasSubstr("did you mean calib?"));
  }
}

TEST(Run, ForceComputesAgainWithoutOldUnits) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  RunOptions force;
  force.force = true;
  const RunResult result = fake.Run(force);
  EXPECT_EQ(FakeSurvey::Ran(result), kAll);
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").reused, 0);
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").computed, 5);
  EXPECT_EQ(fake.Outputs(), outputs);
}

TEST(Run, AForcedRunThatWasInterruptedGoesOnWithoutForce) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  fake.during = [&fake](const std::string& stage, StageContext&) {
    fake.interrupted = stage == "calib";
  };
  RunOptions force;
  force.force = true;
  const RunResult stopped = fake.Run(force);
  fake.interrupted = false;
  EXPECT_EQ(OutcomeOf(stopped, "calib").action, StageAction::kInterrupted);
  EXPECT_FALSE(OutcomeOf(stopped, "calib").failure);
  fake.during = nullptr;
  const RunResult result = fake.Run();
  EXPECT_EQ(FakeSurvey::Ran(result), (Stages{"calib", "side", "dense", "report"}));
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").computed, 0);
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").reused, 5);
  EXPECT_EQ(fake.Outputs(), outputs);
}

TEST(Run, AnOptionOnTheCommandLineHoldsForOneRun) {
  FakeSurvey fake;
  fake.Run();
  RunOptions options;
  options.set = {"side.size=7"};
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(options)), (Stages{"side", "report"}));
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(options)), Stages());
  EXPECT_EQ(ReasonsOf(fake.Status(), "side"), "option side.size changed from 7 to 1");
}

TEST(Run, AnotherVersionOfAStageRunsItAgain) {
  FakeSurvey fake;
  fake.Run();
  fake.table[2].version = 2;
  EXPECT_THAT(ReasonsOf(fake.Status(), "side"), HasSubstr("version 2, was 1"));
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), (Stages{"side"}));
}

TEST(Run, MeasuresWhatAStageTook) {
  FakeSurvey fake;
  fake.during = [](const std::string& stage, StageContext&) {
    if (stage == "side") {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
  };
  const RunResult result = fake.Run();
  EXPECT_GE(OutcomeOf(result, "side").usage.wall_s, 0.03);
  EXPECT_GT(OutcomeOf(result, "side").usage.peak_memory_mb, 1);
  EXPECT_THAT(fake.log, HasSubstr("side: done in"));
}

TEST(Run, ShowsIdleCores) {
  FakeSurvey fake;
  fake.during = [](const std::string& stage, StageContext&) {
    if (stage == "side") {
      BurnOnTwoThreads(0.1);
    } else if (stage == "dense") {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  };
  const RunResult result = fake.Run();
  const Usage busy = OutcomeOf(result, "side").usage;
  const Usage idle = OutcomeOf(result, "dense").usage;
  EXPECT_GE(busy.cpu_s, 0.19);
  EXPECT_LT(idle.cpu_s, 0.5 * idle.wall_s);
  EXPECT_THAT(fake.log, HasSubstr("side: done in " + UsageText(busy) + ", "));
  const size_t summary = fake.log.find("\nTime and cores:\n");
  ASSERT_NE(summary, fake.log.npos) << fake.log;
  const std::string end = fake.log.substr(summary);
  EXPECT_THAT(end, HasSubstr("\n  side     " + UsageText(busy) + "\n"));
  EXPECT_THAT(end, HasSubstr("\n  dense    " + UsageText(idle) + "\n"));
  EXPECT_THAT(end, HasSubstr("\n  together "));
  for (const std::string& line : fake.Events("stage_done")) {
    const auto record = nlohmann::json::parse(line);
    if (record.at("stage") == "side") {
      EXPECT_GE(record.at("cpu_s"), 0.19);
      EXPECT_EQ(record.at("cores"), AvailableCores());
    } else if (record.at("stage") == "dense") {
      EXPECT_LT(record.at("cpu_s"), 0.5 * record.at("wall_s").get<double>());
    }
  }
}

TEST(Run, OfOneStageNeedsNoSummary) {
  FakeSurvey fake;
  fake.Run();
  RunOptions options;
  options.goal = "side";
  options.force = true;
  fake.Run(options);
  EXPECT_THAT(fake.log, HasSubstr("side: done in"));
  EXPECT_THAT(fake.log, testing::Not(HasSubstr("Time and cores")));
}

TEST(Run, ReportSeesStatesAndTimesOfTheOthers) {
  FakeSurvey fake;
  std::vector<StageStatus> statuses;
  fake.during = [&](const std::string& stage, StageContext& context) {
    if (stage == "report") {
      statuses = context.statuses;
    }
  };
  fake.Run();
  ASSERT_EQ(statuses.size(), 4u);
  EXPECT_EQ(statuses[1].stage, "calib");
  EXPECT_EQ(statuses[1].state, "done");
  EXPECT_GE(statuses[1].wall_s, 0);
}

}  // namespace
}  // namespace stucco
