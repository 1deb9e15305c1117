// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/assess.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/work_folder.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The stage "side" of a survey that was run, whose fingerprint now is `now`.
class AssessTest : public testing::Test {
 protected:
  AssessTest() { fake.Run(); }

  Manifest Written() { return *ReadManifest(Path()).manifest; }
  std::filesystem::path Path() { return WorkFolder(fake.survey).Manifest("side"); }
  Assessment AssessSide(const Fingerprint& now) {
    HashCache hashes(WorkFolder(fake.survey).Hashes());
    return Assess(fake.table[2], {fake.survey, fake.photos}, now, 1, hashes);
  }

  FakeSurvey fake;
};

TEST_F(AssessTest, DoneAsLongAsNothingIsDifferent) {
  const Fingerprint now = Written().fingerprint;
  EXPECT_EQ(AssessSide(now).state, StageState::kDone);
  EXPECT_THAT(AssessSide(now).reasons, IsEmpty());
}

TEST_F(AssessTest, EveryDifferenceIsAReason) {
  Fingerprint now = Written().fingerprint;
  now.options["size"] = "9";
  WriteFile(fake.survey / "side/result.txt", "changed by hand");
  const Assessment assessment = AssessSide(now);
  EXPECT_EQ(assessment.state, StageState::kStale);
  EXPECT_THAT(assessment.reasons, ElementsAre("option side.size changed from 1 to 9",
                                              "output side/result.txt was changed or damaged"));
}

TEST_F(AssessTest, WhatWasImportedDependsOnItselfAlone) {
  Manifest manifest = Written();
  manifest.imported_from = "/elsewhere";
  WriteManifest(manifest, Path());
  EXPECT_EQ(AssessSide({}).state, StageState::kDone);
  std::filesystem::remove(fake.survey / "side/result.txt");
  EXPECT_THAT(AssessSide({}).reasons, ElementsAre("output side/result.txt is gone"));
  Assessment assessment = AssessSide({});
  ApplyNeeds(fake.table[2], {{"ingest", StageState::kStale}}, assessment);
  EXPECT_THAT(assessment.reasons, ElementsAre("output side/result.txt is gone"));
}

TEST_F(AssessTest, AStageThatNeedsAChangingOneIsStale) {
  Assessment assessment = AssessSide(Written().fingerprint);
  ApplyNeeds(fake.table[2], {{"ingest", StageState::kDone}}, assessment);
  EXPECT_EQ(assessment.state, StageState::kDone);
  ApplyNeeds(fake.table[2], {{"ingest", StageState::kStale}}, assessment);
  EXPECT_EQ(assessment.state, StageState::kStale);
  EXPECT_THAT(assessment.reasons, ElementsAre("ingest will change"));
}

TEST_F(AssessTest, UsageIsOfTheAttemptThatTheStateIsOf) {
  const Assessment done = AssessSide(Written().fingerprint);
  ASSERT_NE(UsageOf(done), nullptr);
  EXPECT_EQ(UsageOf(done)->wall_s, Written().usage.wall_s);
  Assessment failed = done;
  failed.failure.emplace();
  failed.failure->usage.wall_s = 77;
  EXPECT_EQ(UsageOf(failed)->wall_s, 77);
  EXPECT_EQ(ToStatus("side", failed).wall_s, 77);
  EXPECT_EQ(UsageOf(Assessment()), nullptr);
  EXPECT_EQ(ToStatus("side", Assessment()).wall_s, -1);
}

TEST(JoinReasons, NamesTheFirstThree) {
  EXPECT_EQ(JoinReasons({}), "");
  EXPECT_EQ(JoinReasons({"a", "b", "c"}), "a; b; c");
  EXPECT_EQ(JoinReasons({"a", "b", "c", "d", "e"}), "a; b; c; and 2 more");
}

}  // namespace
}  // namespace stucco
