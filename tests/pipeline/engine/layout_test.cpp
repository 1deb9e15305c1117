// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Layout, InsideIsByWholeNames) {
  EXPECT_TRUE(IsInside("/a/b", "/a/b"));
  EXPECT_TRUE(IsInside("/a/b/c", "/a/b"));
  EXPECT_FALSE(IsInside("/a/bc", "/a/b"));
  EXPECT_FALSE(IsInside("/a", "/a/b"));
}

TEST(Layout, RealPathsFollowLinksAsFarAsThereIsAnything) {
  const FakeSurvey fake;
  fs::create_directory_symlink(fake.photos, fake.root / "link");
  const fs::path photos = fs::canonical(fake.photos);
  EXPECT_EQ(RealPath(fake.root / "link/../link/new/x.jpg"), photos / "new/x.jpg");
  fs::create_directory_symlink(fake.root / "loop", fake.root / "loop");
  EXPECT_EQ(RealPath(fake.root / "loop/x").filename(), "x");  // no exception
}

TEST(Layout, PhotosAndWhatARunReplacesAreApart) {
  const FakeSurvey fake;
  const auto refusal = [&](const fs::path& survey, const fs::path& photos) {
    try {
      RequireApart(survey, photos, fake.table);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(fake.survey, fake.photos), "");
  EXPECT_EQ(refusal(fake.survey, fake.survey / "photos"), "");
  EXPECT_THAT(refusal(fake.photos / "s", fake.photos), HasSubstr("inside the photo folder"));
  EXPECT_THAT(refusal(fake.survey, fake.survey / "dense/x"), HasSubstr("which a run replaces"));
  EXPECT_THAT(refusal(fake.survey, fake.survey / ".stucco"), HasSubstr("which a run replaces"));
}

}  // namespace
}  // namespace stucco
