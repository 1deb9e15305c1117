// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/run_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "pipeline/engine/events.h"
#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/work_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::Pair;

// One stage, which does what a test says.
class RunStageTest : public testing::Test {
 protected:
  RunStageTest() { stage_.name = "one"; }

  StageRunResult RunOne(const std::function<void(StageContext&)>& run) {
    std::FILE* file = std::tmpfile();
    Console console(file, false, Verbosity::kQuiet);
    EventLog events;
    HashCache hashes(WorkFolder(fake.survey).Hashes());
    const BoundStage bound{OptionTable("one"), run};
    const StageJob job{stage_, bound, {fake.survey, fake.photos}, {}, {}};
    try {
      StageRunResult result = RunStage(job, fake.platform, console, events, hashes);
      std::fclose(file);
      return result;
    } catch (...) {
      std::fclose(file);
      throw;
    }
  }

  FakeSurvey fake;

 private:
  Stage stage_;
};

TEST_F(RunStageTest, PutsOutputsInPlaceAndThenTheirManifest) {
  const StageRunResult result = RunOne([&](StageContext& context) {
    WriteFile(context.out / "x.txt", "new");
    EXPECT_FALSE(fs::exists(fake.survey / "one"));
  });
  EXPECT_FALSE(result.failure);
  EXPECT_EQ(ReadFile(fake.survey / "one/x.txt"), "new");
  const ManifestFile file = ReadManifest(WorkFolder(fake.survey).Manifest("one"));
  ASSERT_TRUE(file.manifest);
  EXPECT_EQ(file.manifest->program, ProgramVersion());
  EXPECT_THAT(file.manifest->outputs,
              ElementsAre(Pair("one/x.txt", HashFile(fake.survey / "one/x.txt"))));
}

TEST_F(RunStageTest, AFailureLeavesTheOldOutputsAndARecordThatSuccessRemoves) {
  const auto write = [](StageContext& context) { WriteFile(context.out / "x.txt", "good"); };
  RunOne(write);
  const StageRunResult failed = RunOne([&](StageContext& context) {
    WriteFile(context.out / "x.txt", "half");
    throw std::runtime_error("no more");
  });
  EXPECT_EQ(ReadFile(fake.survey / "one/x.txt"), "good");
  ASSERT_TRUE(failed.failure);
  EXPECT_EQ(failed.failure->kind, "stage_failed");
  EXPECT_EQ(failed.failure->why, "unexpected error: no more");
  const fs::path record = WorkFolder(fake.survey).Failure("one");
  EXPECT_TRUE(ReadFailure(record));
  RunOne(write);
  EXPECT_FALSE(ReadFailure(record));
}

TEST_F(RunStageTest, AnInterruptionIsNoFailureWhateverTheStageMadeOfIt) {
  for (const bool says_so : {true, false}) {
    fake.interrupted = false;
    const auto stopped = [&](StageContext& context) {
      fake.interrupted = true;
      EXPECT_TRUE(context.progress->Cancelled());
      if (says_so) {
        context.ThrowIfCancelled();
      }
      throw std::runtime_error("a library gave up");
    };
    try {
      RunOne(stopped);
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kInterrupted);
    }
    EXPECT_FALSE(ReadFailure(WorkFolder(fake.survey).Failure("one")));
    EXPECT_FALSE(fs::exists(fake.survey / "one"));
  }
}

TEST_F(RunStageTest, UnitsThatWereNotUsedGoWhenTheStageIsDone) {
  const auto unit = [](const std::string& key) {
    return [key](StageContext& context) { ComputeUnit(context, "kind", key, [&] { return key; }); };
  };
  RunOne(unit("a"));
  const StageRunResult result = RunOne(unit("b"));
  EXPECT_EQ(result.manifest->units.at("kind").computed, 1);
  EXPECT_THAT(FilesBelow(WorkFolder(fake.survey).Units("one")), ElementsAre("kind/b"));
}

}  // namespace
}  // namespace stucco
