// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "pipeline/engine/work_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Lock, ASecondRunNamesTheFirst) {
  FakeSurvey fake;
  const SurveyLock lock(fake.survey, "stucco run here", RealPlatform());
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
  fake.platform = WithoutLocks();
  const RunResult result = fake.Run();
  EXPECT_FALSE(CurrentOwner(fake.survey, fake.platform));
  fake.platform = RealPlatform();
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
  while (!CurrentOwner(fake.survey, fake.platform)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_THROW(fake.Run(), Error);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(CurrentOwner(fake.survey, fake.platform));
  fake.SetOption("calib.pause_us", "0");
  EXPECT_EQ(fake.Run().exit_code, 0);
  EXPECT_THAT(fake.log, HasSubstr("did not end in order"));
  fake.Run();
  EXPECT_THAT(fake.log, Not(HasSubstr("did not end in order")));
}

}  // namespace
}  // namespace stucco
