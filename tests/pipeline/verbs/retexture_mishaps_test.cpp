// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/engine/work_folder.h"
#include "survey/files.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/tiny_disk.h"
#include "tests/pipeline/verbs/retexture_sample.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const EpochPhoto& PhotoOf(const RetextureReport& report, const std::string& path) {
  return *std::ranges::find(report.epoch.photos, path, &EpochPhoto::path);
}

// In one test, because making the survey takes most of the time: whatever goes wrong, the survey
// and the epochs before are as they were, and the same command works when it is mended.
TEST_F(RetextureSample, MishapsLeaveTheSurveyAndItsEpochs) {
  const RetextureReport first = Run("same", "first");
  const auto survey = Contents(Survey());
  const auto epoch = Contents(Epoch("first"));
  const auto expect_untouched = [&](const char* after) {
    EXPECT_EQ(Contents(Survey()), survey) << after;
    EXPECT_EQ(Contents(Epoch("first")), epoch) << after;
  };

  // A truncated photo and the survey's own ones among new ones are left out by name.
  fs::copy(Photos("same"), Photos("mixed"));
  const fs::path own = *fs::directory_iterator(Photos("old"));
  fs::copy(own, Photos("mixed") / "again.jpg");
  const std::string whole = ReadFile(*fs::directory_iterator(Photos("same")));
  WriteFile(Photos("mixed") / "torn.jpg", whole.substr(0, whole.size() / 3));
  const RetextureReport mixed = Run("mixed", "mixed");
  EXPECT_THAT(PhotoOf(mixed, "again.jpg").why, HasSubstr("survey's own photo"));
  EXPECT_FALSE(PhotoOf(mixed, "torn.jpg").is_placed());
  EXPECT_THAT(PhotoOf(mixed, "torn.jpg").why, testing::Not(IsEmpty()));
  // The others make what they make alone, and an epoch does not begin at the one before.
  EXPECT_EQ(ReadFile(mixed.folder / "model.glb"), ReadFile(first.folder / "model.glb"));
  expect_untouched("a mixed set");

  // An epoch is no survey, and gets no epoch.
  EXPECT_THAT(RefusalOf(Epoch("first"), "same", "on-epoch").what(), HasSubstr(kSettingsFile));
  expect_untouched("an epoch on an epoch");

  // What a killed run left behind is cleared away.
  const fs::path left = WorkFolder(Survey()).Scratch() / "epochs/later-1";
  fs::create_directories(left / "textures");
  WriteFile(left / "textures/half.png", "half");
  EXPECT_THAT(Refusal("same", "first").what(), HasSubstr("is there already"));

  // The disk is full in the middle.
  {
    const fs::path scratch = WorkFolder(Survey()).Scratch();
    const TinyDisk disk(scratch);
    if (disk.mounted()) {
      const Error full = Refusal("same", "later");
      EXPECT_EQ(full.kind(), ErrorKind::kOutOfResource) << full.what();
      EXPECT_FALSE(fs::exists(Epoch("later")));
      expect_untouched("a full disk");
    }
  }
  const RetextureReport later = Run("same", "later");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(Contents(later.folder).size(), epoch.size());

  // The survey's photos are gone, and then what calibration had found in them, too.
  fs::rename(Photos("old"), Photos("away"));
  const RetextureReport without = Run("same", "without");
  EXPECT_EQ(ReadFile(without.folder / "model.glb"), ReadFile(first.folder / "model.glb"));
  const fs::path found = WorkFolder(Survey()).Units("calib");
  fs::rename(found, Photos("units"));
  const Error blind = Refusal("same", "blind");
  EXPECT_EQ(blind.kind(), ErrorKind::kBadInput);
  EXPECT_THAT(blind.what(), HasSubstr("photos of the survey are not there"));
  EXPECT_FALSE(fs::exists(Epoch("blind")));
  fs::rename(Photos("units"), found);
  fs::rename(Photos("away"), Photos("old"));
  expect_untouched("photos that were gone");
}

}  // namespace
}  // namespace stucco
