// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>

#include "pipeline/engine/work_folder.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

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
  FakeSurvey whole, killed;
  if (GetParam()) {
    whole.platform = killed.platform = WithoutExchange();
  }
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
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutExchange, Resume, testing::Bool());

}  // namespace
}  // namespace stucco
