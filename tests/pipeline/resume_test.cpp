// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>

#include "pipeline/lock.h"
#include "pipeline/outputs.h"
#include "pipeline/run.h"
#include "pipeline/work_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::HasSubstr;

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

// Kills the child after `wait`; returns true when it was still at work.
bool KillAfter(pid_t child, std::chrono::microseconds wait) {
  std::this_thread::sleep_for(wait);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << status;
  return WIFSIGNALED(status);
}

// Runs, killed at random moments, until nothing is left to do. How fast a machine is cannot be
// known, so the moments are spread evenly over magnitudes, from the start of a process to the end
// of a run. Returns the number of runs that were killed at work.
int RunWithKills(FakeSurvey& fake, std::mt19937& random) {
  fake.SetOption("calib.pause_us", "1000");
  std::uniform_real_distribution<double> magnitude(std::log(50.0), std::log(50e3));
  int kills = 0;
  for (int attempt = 0; attempt < 10; ++attempt) {
    const auto wait = static_cast<int64_t>(std::exp(magnitude(random)));
    kills += KillAfter(StartRun(fake), std::chrono::microseconds(wait));
  }
  EXPECT_EQ(fake.Run().exit_code, 0);
  return kills;
}

class Resume : public testing::TestWithParam<bool> {};

TEST_P(Resume, KilledAtAnyMomentGivesTheSameBytesAndNoWorkTwice) {
  ForbidFolderExchange(GetParam());
  FakeSurvey whole, killed;
  std::mt19937 random(7);
  int kills = 0;
  // From the second round on, finished outputs get replaced.
  for (int round = 1; round <= 3 || (kills < 12 && round < 100); ++round) {
    whole.SetOption("ingest.size", std::to_string(round));
    killed.SetOption("ingest.size", std::to_string(round));
    ASSERT_EQ(whole.Run().exit_code, 0);
    kills += RunWithKills(killed, random);
    ASSERT_EQ(killed.Outputs(), whole.Outputs());
  }
  EXPECT_GE(kills, 12) << "the test has to kill runs to mean anything";
  for (const auto& [unit, count] : killed.ComputedUnits()) {
    EXPECT_EQ(count, 1) << unit << " was computed again after it was on disk";
  }
  EXPECT_TRUE(FilesBelow(WorkFolder(killed.survey).Scratch()).empty());
  ForbidFolderExchange(false);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutExchange, Resume, testing::Bool());

TEST(Lock, ASecondRunNamesTheFirst) {
  FakeSurvey fake;
  const SurveyLock lock(fake.survey, "stucco run here");
  try {
    fake.Run();
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(e.what(), HasSubstr("process " + std::to_string(getpid())));
    EXPECT_THAT(e.what(), HasSubstr("stucco run here"));
    EXPECT_THAT(e.remedy(), HasSubstr("kill"));
  }
  const SurveyStatus status = fake.Status();
  ASSERT_TRUE(status.running);
  EXPECT_EQ(status.running->pid, getpid());
  EXPECT_THAT(status.next, HasSubstr("wait"));
}

TEST(Lock, AFileSystemWithoutLocksIsSaidAndUsed) {
  FakeSurvey fake;
  ForbidFileLocks(true);
  const RunResult result = fake.Run();
  EXPECT_FALSE(CurrentOwner(fake.survey));
  ForbidFileLocks(false);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(fake.log, HasSubstr("this file system has no locks"));
  fake.Run();
  EXPECT_THAT(fake.log, Not(HasSubstr("no locks")));
}

TEST(Lock, AnOwnerThatCannotBeReadIsNobody) {
  FakeSurvey fake;
  std::filesystem::create_directories(WorkFolder(fake.survey).root);
  for (const char* text : {"{\"pid\": \"x\"}", "{\"pid\": 1, \"host\": 2}", "[]", "{", "7"}) {
    WriteFile(WorkFolder(fake.survey).Lock(), text);
    EXPECT_EQ(fake.Run().exit_code, 0) << text;
    EXPECT_THAT(fake.log, Not(HasSubstr("did not end in order"))) << text;
  }
}

TEST(Lock, OfADeadProcessIsTakenOver) {
  FakeSurvey fake;
  fake.SetOption("calib.pause_us", "100000");
  const pid_t child = StartRun(fake);
  while (!CurrentOwner(fake.survey)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_THROW(fake.Run(), Error);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(CurrentOwner(fake.survey));
  fake.SetOption("calib.pause_us", "0");
  EXPECT_EQ(fake.Run().exit_code, 0);
  EXPECT_THAT(fake.log, HasSubstr("did not end in order"));
  fake.Run();
  EXPECT_THAT(fake.log, Not(HasSubstr("did not end in order")));
}

}  // namespace
}  // namespace stucco
