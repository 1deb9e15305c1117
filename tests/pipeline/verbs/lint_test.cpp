// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/lint.h"

#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

// The rules are tested in tests/plan.

TEST(LintMission, RefusesWhatIsNoArchive) {
  const FakeSurvey fake;
  EXPECT_THROW(LintMission(fake.root / "none.kmz"), Error);
  WriteFile(fake.root / "text.kmz", "this is no archive");
  EXPECT_THROW(LintMission(fake.root / "text.kmz"), Error);
}

}  // namespace
}  // namespace stucco
