// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/decide.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::HasSubstr;

constexpr ReplaceMode kAllModes[] = {ReplaceMode::kAuto, ReplaceMode::kAlways, ReplaceMode::kNever};

// A wall that was painted, and is shown again in full and at the same resolution.
FacetEvidence Unchanged() {
  return {.painted_before = 0.95,
          .painted_after = 0.95,
          .both = 0.95,
          .compared = 0.95,
          .gsd_before_m = 0.02,
          .gsd_after_m = 0.021,
          .changed_share = 0.01};
}

TEST(Decide, KeepsWhatDidNotChange) {
  EXPECT_EQ(Decide(ReplaceMode::kAuto, Unchanged()).choice, FacetChoice::kKept);
  EXPECT_EQ(Decide(ReplaceMode::kAlways, Unchanged()).choice, FacetChoice::kReplaced);
  EXPECT_EQ(Decide(ReplaceMode::kNever, Unchanged()).choice, FacetChoice::kKept);
}

TEST(Decide, SaysWhatCannotBeCompared) {
  FacetEvidence evidence = Unchanged();
  EXPECT_THAT(Decide(ReplaceMode::kAuto, evidence).why, HasSubstr("has not changed"));
  evidence.compared = 0.2;
  const FacetDecision decision = Decide(ReplaceMode::kAuto, evidence);
  EXPECT_EQ(decision.choice, FacetChoice::kKept);
  EXPECT_THAT(decision.why, HasSubstr("75 % of it"));
}

TEST(Decide, DoesNotSayThatWhatItCannotCompareIsUnchanged) {
  FacetEvidence evidence = Unchanged();
  evidence.painted_before = 0.9;
  evidence.painted_after = 0.03;  // beside it, and too little to fill
  evidence.both = evidence.compared = 0;
  evidence.changed_share = 0;
  const FacetDecision decision = Decide(ReplaceMode::kAuto, evidence);
  EXPECT_EQ(decision.choice, FacetChoice::kKept);
  EXPECT_THAT(decision.why, HasSubstr("nothing of it that was painted"));
}

TEST(Decide, FillsNoGapsOfAWallThatChanged) {
  FacetEvidence evidence = Unchanged();
  evidence.painted_before = 0.7;
  evidence.painted_after = evidence.both = 0.3;
  evidence.painted_after += 0.1;
  evidence.compared = 0.3;
  EXPECT_EQ(Decide(ReplaceMode::kAuto, evidence).choice, FacetChoice::kFilled);
  evidence.changed_share = 0.5;
  EXPECT_EQ(Decide(ReplaceMode::kAuto, evidence).choice, FacetChoice::kKept);
}

TEST(Decide, KeepsWhatNoNewPhotoShows) {
  FacetEvidence evidence = Unchanged();
  evidence.painted_after = evidence.both = 0;
  for (const ReplaceMode mode : kAllModes) {
    EXPECT_EQ(Decide(mode, evidence).choice, FacetChoice::kKept);
  }
}

TEST(Decide, PaintsWhatHadNoPicture) {
  for (const ReplaceMode mode : kAllModes) {
    EXPECT_EQ(Decide(mode, {.painted_after = 0.1}).choice, FacetChoice::kPainted);
  }
}

TEST(Decide, ReplacesWhatChanged) {
  FacetEvidence evidence = Unchanged();
  evidence.changed_share = 0.5;
  evidence.gsd_after_m = 0.05;  // coarser, but true
  const FacetDecision decision = Decide(ReplaceMode::kAuto, evidence);
  EXPECT_EQ(decision.choice, FacetChoice::kReplaced);
  EXPECT_THAT(decision.why, HasSubstr("50 %"));
  EXPECT_EQ(Decide(ReplaceMode::kNever, evidence).choice, FacetChoice::kKept);
}

TEST(Decide, ReplacesNoWholeWallByAPart) {
  FacetEvidence evidence = Unchanged();
  evidence.changed_share = 0.5;
  evidence.painted_after = evidence.both = 0.5;
  const FacetDecision decision = Decide(ReplaceMode::kAuto, evidence);
  EXPECT_EQ(decision.choice, FacetChoice::kKept);
  EXPECT_THAT(decision.why, HasSubstr("too little"));
  EXPECT_EQ(Decide(ReplaceMode::kAlways, evidence).choice, FacetChoice::kReplaced);
}

TEST(Decide, KeepsWhatIsOnlyShownFinerAndSaysSo) {
  FacetEvidence evidence = Unchanged();
  EXPECT_EQ(Decide(ReplaceMode::kAuto, evidence).why, "it has not changed");
  evidence.gsd_after_m = 0.01;
  const FacetDecision decision = Decide(ReplaceMode::kAuto, evidence);
  EXPECT_EQ(decision.choice, FacetChoice::kKept);
  EXPECT_THAT(decision.why, HasSubstr("2.0 times finer"));
  evidence.gsd_before_m = 0;  // not known
  EXPECT_EQ(Decide(ReplaceMode::kAuto, evidence).why, "it has not changed");
}

TEST(Decide, FillsGaps) {
  FacetEvidence evidence = Unchanged();
  evidence.painted_before = 0.6;
  evidence.both = 0.6;
  EXPECT_EQ(Decide(ReplaceMode::kAuto, evidence).choice, FacetChoice::kFilled);
  EXPECT_EQ(Decide(ReplaceMode::kNever, evidence).choice, FacetChoice::kFilled);
  evidence.painted_after = 0.62;  // not worth other bytes, unless gaps were asked for
  EXPECT_EQ(Decide(ReplaceMode::kAuto, evidence).choice, FacetChoice::kKept);
  EXPECT_EQ(Decide(ReplaceMode::kNever, evidence).choice, FacetChoice::kFilled);
}

}  // namespace
}  // namespace stucco
