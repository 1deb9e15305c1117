// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <new>
#include <system_error>

#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/run.h"
#include "pipeline/engine/units.h"
#include "pipeline/engine/work_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"
#include "tests/pipeline/tiny_disk.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Stages = std::set<std::string>;

// Lets one stage throw from now on.
template <typename Exception>
void LetFail(FakeSurvey& fake, const std::string& failing, const Exception& exception) {
  fake.during = [failing, exception](const std::string& stage, StageContext&) {
    if (stage == failing) {
      throw exception;
    }
  };
}

TEST(Failure, KeepsOldOutputsAndStillReports) {
  FakeSurvey fake;
  fake.Run();
  const auto before = fake.Outputs();
  LetFail(fake, "calib", Error(ErrorKind::kBadInput, "p1.jpg: no features", "take it again"));
  fake.SetOption("ingest.size", "4");
  const RunResult result = fake.Run();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(OutcomeOf(result, "calib").action, StageAction::kFailed);
  EXPECT_EQ(OutcomeOf(result, "dense").action, StageAction::kBlocked);
  EXPECT_EQ(FakeSurvey::Ran(result), (Stages{"ingest", "side", "report"}));
  const auto after = fake.Outputs();
  EXPECT_EQ(after.at("calib/features.txt"), before.at("calib/features.txt"));
  EXPECT_EQ(after.at("dense/result.txt"), before.at("dense/result.txt"));
  EXPECT_THAT(after.at("report/result.txt"),
              HasSubstr("calib failed p1.jpg: no features take it again"));
  EXPECT_THAT(after.at("report/result.txt"), HasSubstr("dense stale calib failed"));
  EXPECT_THAT(fake.log, HasSubstr("calib: failed: p1.jpg: no features\n  take it again"));
}

TEST(Failure, IsRememberedAndForgottenWhenMended) {
  FakeSurvey fake;
  LetFail(fake, "calib", Error(ErrorKind::kStageFailed, "photos do not overlap", "fly again"));
  EXPECT_EQ(fake.Run().exit_code, 1);
  SurveyStatus status = fake.Status();
  EXPECT_EQ(StateOf(status, "calib"), "failed");
  EXPECT_EQ(ReasonsOf(status, "calib"), "photos do not overlap");
  EXPECT_EQ(StateOf(status, "dense"), "missing");
  EXPECT_EQ(StateOf(status, "report"), "done");
  EXPECT_THAT(status.next, HasSubstr("fly again"));
  // The same failure once more: the report has nothing new to say.
  const RunResult again = fake.Run();
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(OutcomeOf(again, "report").action, StageAction::kUpToDate);
  fake.during = nullptr;
  EXPECT_EQ(fake.Run().exit_code, 0);
  status = fake.Status();
  EXPECT_EQ(StateOf(status, "calib"), "done");
  EXPECT_EQ(StateOf(status, "report"), "done");
  EXPECT_FALSE(fs::exists(WorkFolder(fake.survey).Failure("calib")));
  EXPECT_THAT(fake.Outputs().at("report/result.txt"), HasSubstr("calib done"));
}

TEST(Failure, OfOtherOptionsOrInputsIsNotBroughtBack) {
  FakeSurvey fake;
  fake.Run();
  LetFail(fake, "calib", Error(ErrorKind::kStageFailed, "too few features"));
  fake.SetOption("calib.size", "2");
  fake.Run();
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "failed");
  fake.SetOption("calib.size", "1");
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "done");
  fake.SetOption("calib.size", "3");
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "stale");
  EXPECT_EQ(ReasonsOf(fake.Status(), "calib"), "option calib.size changed from 1 to 3");
  fake.SetOption("calib.size", "2");
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "failed");
  WriteFile(WorkFolder(fake.survey).Failure("calib"), "{\"version\": \"x\"}");
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "stale");
}

TEST(Failure, IsReportedAlsoByARunThatWasAskedForLess) {
  FakeSurvey fake;
  RunOptions until, goal;
  until.until = "dense";
  goal.goal = "calib";
  fake.Run(until);
  EXPECT_EQ(fake.Outputs().count("report/result.txt"), 0u);  // not asked for, and nothing failed
  fake.SetOption("calib.size", "2");
  LetFail(fake, "calib", Error(ErrorKind::kStageFailed, "no overlap"));
  EXPECT_EQ(FakeSurvey::Ran(fake.Run(until)), (Stages{"report"}));
  EXPECT_THAT(fake.Outputs().at("report/result.txt"), HasSubstr("calib failed no overlap"));
  fake.SetOption("calib.size", "3");
  LetFail(fake, "calib", Error(ErrorKind::kStageFailed, "still none"));
  EXPECT_EQ(fake.Run(goal).exit_code, 1);
  EXPECT_THAT(fake.Outputs().at("report/result.txt"), HasSubstr("calib failed still none"));
}

TEST(Failure, EveryKindHasItsExitCode) {
  FakeSurvey fake;
  LetFail(fake, "side", Error(ErrorKind::kQualityGate, "below 0.5"));
  EXPECT_EQ(fake.Run().exit_code, 4);
  LetFail(fake, "side", Error(ErrorKind::kOutOfResource, "disk full"));
  EXPECT_EQ(fake.Run().exit_code, 5);
  LetFail(fake, "side", std::bad_alloc());
  EXPECT_EQ(fake.Run().exit_code, 5);
  EXPECT_THAT(fake.log, HasSubstr("out of memory"));
  LetFail(fake, "side", std::system_error(ENOSPC, std::generic_category(), "x.ply"));
  EXPECT_EQ(fake.Run().exit_code, 5);
  LetFail(fake, "side", std::system_error(EDQUOT, std::system_category(), "x.ply"));
  EXPECT_EQ(fake.Run().exit_code, 5);
  LetFail(fake, "side", std::system_error(EACCES, std::generic_category(), "x.ply"));
  EXPECT_EQ(fake.Run().exit_code, 3);
  LetFail(fake, "side", std::logic_error("index 7"));
  EXPECT_EQ(fake.Run().exit_code, 1);
  EXPECT_THAT(fake.log, HasSubstr("unexpected error: index 7"));
  LetFail(fake, "side", 42);
  EXPECT_EQ(fake.Run().exit_code, 1);
}

TEST(Failure, OfTheReportItselfIsAFailure) {
  FakeSurvey fake;
  LetFail(fake, "report", Error(ErrorKind::kStageFailed, "no template"));
  EXPECT_EQ(fake.Run().exit_code, 1);
  EXPECT_EQ(StateOf(fake.Status(), "report"), "failed");
}

TEST(Failure, UnitsOfAFailedStageAreKept) {
  FakeSurvey fake;
  LetFail(fake, "calib", Error(ErrorKind::kStageFailed, "late"));
  fake.Run();
  fake.during = nullptr;
  const RunResult result = fake.Run();
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("features").computed, 0);
  EXPECT_EQ(OutcomeOf(result, "calib").units.at("pair").reused, 10);
}

TEST(Interrupt, StopsResumablyWithItsExitCode) {
  FakeSurvey fake;
  fake.during = [&fake](const std::string& stage, StageContext&) {
    if (stage == "calib") {
      fake.interrupted = true;
    }
  };
  const RunResult result = fake.Run();
  fake.interrupted = false;
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(FakeSurvey::Ran(result), (Stages{"ingest"}));
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "missing");  // no failure: nothing is wrong
  fake.during = nullptr;
  const RunResult resumed = fake.Run();
  EXPECT_EQ(resumed.exit_code, 0);
  EXPECT_EQ(OutcomeOf(resumed, "calib").units.at("pair").computed, 0);
  for (const auto& [unit, count] : fake.ComputedUnits()) {
    EXPECT_EQ(count, 1) << unit;
  }
}

// A stream that interrupts the program when it tells of hashing.
ssize_t InterruptAtHashing(void* fake, const char* text, size_t size) {
  if (std::string_view(text, size).find("hashing photos") != std::string_view::npos) {
    static_cast<FakeSurvey*>(fake)->interrupted = true;
  }
  return static_cast<ssize_t>(size);
}

TEST(Interrupt, StopsAlsoWhilePhotosAreHashed) {
  FakeSurvey fake;
  std::FILE* stream = fopencookie(&fake, "w", {nullptr, InterruptAtHashing, nullptr, nullptr});
  ASSERT_NE(stream, nullptr);
  Console console(stream, false, Verbosity::kNormal);
  const RunResult result = stucco::Run(fake.survey, fake.table, {}, console, fake.platform);
  fake.interrupted = false;
  std::fclose(stream);
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(fake.Events("interrupted").size(), 1u);
  EXPECT_TRUE(fake.Outputs().empty());
  EXPECT_EQ(fake.Run().exit_code, 0);
}

TEST(Failure, OfAUnitOnADiskWithoutRoomForItsFolderIsOutOfResource) {
  const FakeSurvey fake;
  const TinyDisk disk(fake.survey, "nr_inodes=1");
  if (!disk.mounted()) {
    GTEST_SKIP() << "no right to mount a small disk here";
  }
  try {
    DiskUnits(fake.survey / "units", nullptr).Save("kind", "key", "bytes");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kOutOfResource) << e.what();
  }
}

TEST(Failure, OnAFullDiskNothingIsLost) {
  FakeSurvey fake;
  const std::string settings = ReadFile(fake.survey / "survey.toml");
  const TinyDisk disk(fake.survey);
  if (!disk.mounted()) {
    GTEST_SKIP() << "no right to mount a small disk here";
  }
  WriteFile(fake.survey / "survey.toml", settings);
  ASSERT_EQ(fake.Run().exit_code, 0);
  const auto outputs = fake.Outputs();
  fake.during = [](const std::string& stage, StageContext& context) {
    if (stage == "side") {
      WriteFile(context.out / "large.bin", std::string(400'000, 'x'));
    }
  };
  fake.SetOption("side.size", "8");
  const RunResult result = fake.Run();
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(fake.log, HasSubstr("large.bin"));
  EXPECT_EQ(fake.Outputs().at("side/result.txt"), outputs.at("side/result.txt"));
  fake.during = nullptr;
  EXPECT_EQ(fake.Run().exit_code, 0);
  EXPECT_THAT(fake.Outputs().at("side/result.txt"), HasSubstr("size 8"));
}

}  // namespace
}  // namespace stucco
