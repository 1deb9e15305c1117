// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/photos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Photos, AreCountedAndMeasuredFromTheirHeaders) {
  FakeSurvey fake;  // four photos of 16 x 8
  WriteFile(fake.photos / "notes.md", "text");
  WriteFile(fake.photos / "torn.jpg", ReadFile(fake.photos / "p0.jpg").substr(0, 4));
  const PhotoFolder one = InspectPhotos(fake.photos, 1);
  EXPECT_EQ(one.photos, 4u);
  EXPECT_EQ(one.sizes.size(), 4u);
  EXPECT_EQ(one.other_files, 1u);
  EXPECT_NEAR(one.megapixels, 4 * 16 * 8 * 1e-6, 1e-12);
  ASSERT_EQ(one.problems.size(), 1u);
  EXPECT_EQ(one.problems[0].path, "torn.jpg");
  double bytes = 0;
  for (int i = 0; i < 4; ++i) {
    bytes += static_cast<double>(fs::file_size(fake.photos / ("p" + std::to_string(i) + ".jpg")));
  }
  EXPECT_EQ(one.bytes, bytes);
  EXPECT_EQ(InspectPhotos(fake.photos, 3).bytes, bytes);  // at any number of threads
}

TEST(Photos, AFolderThatIsNoneIsRefused) {
  const FakeSurvey fake;
  EXPECT_THROW(InspectPhotos(fake.root / "none", 1), Error);
  EXPECT_THROW(InspectPhotos(fake.photos / "p0.jpg", 1), Error);
  fs::create_directories(fake.root / "empty");
  EXPECT_EQ(InspectPhotos(fake.root / "empty", 1).photos, 0u);
}

}  // namespace
}  // namespace stucco
