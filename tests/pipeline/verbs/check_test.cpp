// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CheckTest : public testing::Test {
 protected:
  CheckResult Check() {
    return stucco::Check(fake.survey, fake.table, LoadSettings(fake.survey, fake.table, {}),
                         {"ingest", "calib"});
  }
  void RemovePhotos() {
    for (const std::string& file : FilesBelow(fake.photos)) {
      fs::remove(fake.photos / file);
    }
  }

  FakeSurvey fake;
};

TEST_F(CheckTest, CountsGoodPhotos) {
  fake.AddPhoto("sub/more.JPG", 3);
  WriteFile(fake.photos / "notes.md", "text");
  const CheckResult result = Check();
  EXPECT_TRUE(result.ok());
  EXPECT_TRUE(result.problems.empty());
  EXPECT_EQ(result.photos.photos, 5u);
  EXPECT_EQ(result.photos.other_files, 1u);
  EXPECT_NEAR(result.photos.megapixels, 5 * 16 * 8 * 1e-6, 1e-9);
  EXPECT_GT(result.free_disk_mb, 0);
}

TEST_F(CheckTest, NamesEveryBadPictureAndGoesOn) {
  WriteFile(fake.photos / "empty.jpg", "");
  WriteFile(fake.photos / "text.jpg", "hello");
  WriteFile(fake.photos / "screen.png", "\x89PNG\r\n\x1a\n");
  const CheckResult result = Check();
  EXPECT_TRUE(result.ok());
  EXPECT_TRUE(result.problems.empty());
  ASSERT_EQ(result.photos.problems.size(), 3u);
  EXPECT_EQ(result.photos.problems[0].path, "empty.jpg");
  EXPECT_THAT(result.photos.problems[0].why, HasSubstr("empty.jpg"));
}

TEST_F(CheckTest, SeesWhatIngestSees) {
  WriteFile(fake.photos / "p0.dng", "raw");  // beside p0.jpg
  WriteFile(fake.photos / "p0.thm", ReadFile(fake.photos / "p0.jpg"));
  WriteFile(fake.photos / "line\nbreak.jpg", ReadFile(fake.photos / "p0.jpg"));
  const CheckResult result = Check();
  EXPECT_EQ(result.photos.photos, 4u);
  EXPECT_EQ(result.photos.other_files, 2u);
  ASSERT_EQ(result.photos.problems.size(), 1u);
  EXPECT_THAT(result.photos.problems[0].why, HasSubstr("line?break.jpg: the file's name"));
}

TEST_F(CheckTest, RefusesAFolderWithoutEnoughPhotos) {
  RemovePhotos();
  EXPECT_THAT(Check().problems.at(0).what, HasSubstr("is empty"));
  WriteFile(fake.photos / "a.txt", "text");
  EXPECT_THAT(Check().problems.at(0).what, HasSubstr("none of the 1 files"));
  fake.AddPhoto("only.jpg", 1);
  EXPECT_THAT(Check().problems.at(0).what, HasSubstr("only one usable photo"));
  EXPECT_FALSE(Check().ok());
  fs::remove_all(fake.photos);
  EXPECT_THAT(Check().problems.at(0).what, HasSubstr("is not there"));
  EXPECT_THROW(ThrowIfFatal(Check()), Error);
}

TEST_F(CheckTest, RefusesASurveyAmongItsPhotos) {
  WriteFile(fake.survey / "survey.toml", "photos = \"..\"\n");
  EXPECT_THAT(Check().problems.at(0).what, HasSubstr("inside the photo folder"));
}

TEST_F(CheckTest, RefusesPhotosWhereAStageWouldReplaceThem) {
  for (const std::string folder : {"calib", "dense/photos", ".stucco/photos"}) {
    fs::create_directories(fake.survey / folder);
    fs::copy(fake.photos, fake.survey / folder);
    WriteFile(fake.survey / "survey.toml", "photos = \"" + folder + "\"\n");
    EXPECT_THAT(Check().problems.at(0).what, HasSubstr("which a run replaces"));
    const auto before = fake.Outputs();
    EXPECT_THROW(fake.Run(), Error);
    EXPECT_EQ(fake.Outputs(), before);
  }
}

TEST_F(CheckTest, SaysWhenDiskOrMemoryWillNotDo) {
  fake.table[1].cost.disk_mb_per_megapixel = 1e15;
  fake.table[1].cost.memory_mb = 1e9;
  const CheckResult result = Check();
  ASSERT_EQ(result.problems.size(), 2u);
  EXPECT_TRUE(result.problems[0].fatal);
  EXPECT_EQ(result.problems[0].kind, ErrorKind::kOutOfResource);
  EXPECT_THAT(result.problems[1].what, HasSubstr("memory"));
  EXPECT_FALSE(result.problems[1].fatal);
  // A stage that is already there needs no more room.
  fs::create_directories(fake.survey / "calib");
  EXPECT_TRUE(Check().ok());
}

TEST_F(CheckTest, EstimatesGrowWithPhotosAndShrinkWithThreads) {
  fake.table[1].cost.cpu_s_per_photo = 10;
  fake.table[1].cost.cpu_s_per_pair = 1;
  WriteFile(fake.survey / "survey.toml", "photos = \"../photos\"\n[run]\nthreads = 1\n");
  EXPECT_NEAR(Check().needs.at(1).wall_s, 4 * 10 + 6, 1e-9);
  WriteFile(fake.survey / "survey.toml", "photos = \"../photos\"\n[run]\nthreads = 2\n");
  EXPECT_LT(Check().needs.at(1).wall_s, 30);
}

TEST_F(CheckTest, CachesStayWithinTheirShareOfTheMemoryLimit) {
  fake.table[1].cost.memory_mb = 100;
  fake.table[1].cost.cached_mb_per_megapixel = 1e9;
  fake.table[1].cost.cached_share = 0.5;
  WriteFile(fake.survey / "survey.toml", "photos = \"../photos\"\n[run]\nmemory_limit_gb = 2.0\n");
  EXPECT_NEAR(Check().needs.at(1).memory_mb, 100 + 1024, 1e-9);
  fake.table[1].cost.cached_mb_per_megapixel = 1e-6;
  EXPECT_NEAR(Check().needs.at(1).memory_mb, 100, 1e-3);
}

TEST_F(CheckTest, WorkOfThreadsStaysWithinItsShareOfTheMemoryLimitOrIsThatOfOne) {
  const auto memory_mb = [&](int threads, double of_thread) {
    fake.table[1].cost.thread_mb_per_largest_megapixel = of_thread;
    WriteFile(fake.survey / "survey.toml",
              fmt::format("photos = \"../photos\"\n[run]\nmemory_limit_gb = 2.0\nthreads = {}\n",
                          threads));
    return Check().needs.at(1).memory_mb;
  };
  const double one = memory_mb(1, 1);
  EXPECT_GT(one, 0);
  EXPECT_NEAR(memory_mb(3, 1), 3 * one, 1e-9);
  EXPECT_NEAR(memory_mb(3, 400 / one), 512, 1e-9);
  EXPECT_NEAR(memory_mb(3, 600 / one), 600, 1e-9);
}

TEST_F(CheckTest, EstimatesFollowTheSizeThatAStageReducesPhotosTo) {
  int side_px = 0;
  fake.table[1].cost.cpu_s_per_megapixel = 1e6;
  fake.table[1].bind = [&side_px] {
    BoundStage bound{OptionTable("calib"), nullptr};
    bound.options.Add("max_image_px", side_px, 0, 100, "Longer side.");
    return bound;
  };
  const std::string settings = "photos = \"../photos\"\n[run]\nthreads = 1\n[calib]\n";
  WriteFile(fake.survey / "survey.toml", settings + "max_image_px = 16\n");
  EXPECT_NEAR(Check().needs.at(1).wall_s, 4 * 16 * 8, 1e-9);
  WriteFile(fake.survey / "survey.toml", settings + "max_image_px = 8\n");
  EXPECT_NEAR(Check().needs.at(1).wall_s, 4 * 8 * 4, 1e-9);
}

TEST_F(CheckTest, StopsARunBeforeItBegins) {
  RemovePhotos();
  try {
    fake.Run();
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(e.what(), HasSubstr("is empty"));
  }
  EXPECT_TRUE(fake.Outputs().empty());
}

}  // namespace
}  // namespace stucco
