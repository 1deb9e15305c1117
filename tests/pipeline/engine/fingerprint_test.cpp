// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/fingerprint.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/work_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// Cancelled after so many photos.
class Hashing : public Progress {
 public:
  explicit Hashing(size_t limit) : limit_(limit) {}
  void Begin(std::string_view step, size_t total) override {
    steps += std::string(step) + " " + std::to_string(total) + "; ";
  }
  void Advance(size_t units) override { done += units; }
  void Warn(std::string_view) override {}
  void Note(std::string_view) override {}
  bool Cancelled() const override { return done >= limit_; }

  std::string steps;
  size_t done = 0;

 private:
  size_t limit_;
};

TEST(Fingerprint, HashingPhotosIsShownCancelledAndKept) {
  FakeSurvey fake;
  WriteFile(fake.photos / "flight.mp4", "200 GB");
  WriteFile(fake.photos / "p0.dng", "raw");
  WriteFile(fake.photos / "alone.dng", "raw");
  std::this_thread::sleep_for(std::chrono::milliseconds(60));  // past the age of young stamps
  const SurveyPaths paths{fake.survey, fake.photos};
  const BoundStage bound = fake.table[0].bind();
  fs::create_directories(WorkFolder(fake.survey).root);
  const auto take = [&](Progress& progress, HashCache& hashes) {
    return TakeFingerprint(fake.table[0], bound, {paths, {}, 1, hashes, progress});
  };
  {
    HashCache hashes(WorkFolder(fake.survey).Hashes());
    hashes.SaveEvery(std::chrono::seconds(0));
    Hashing stopped(3);
    EXPECT_THROW(take(stopped, hashes), Error);
    EXPECT_EQ(stopped.steps, "hashing photos 4; ");
  }
  HashCache hashes(WorkFolder(fake.survey).Hashes());
  Hashing rest(99);
  const Fingerprint fingerprint = take(rest, hashes);
  EXPECT_EQ(rest.steps, "hashing photos 1; ");
  EXPECT_EQ(fingerprint.inputs.size(), 5u);
  EXPECT_EQ(fingerprint.inputs.at("photos/alone.dng"), kUnreadInput);
  EXPECT_EQ(fingerprint.inputs.count("photos/flight.mp4"), 0u);
  Hashing nothing(0);
  EXPECT_EQ(take(nothing, hashes), fingerprint);
  EXPECT_EQ(nothing.steps, "");
}

// A file that an option names is an input, wherever it lies.
TEST(Fingerprint, ContentOfAFileThatAnOptionNamesCounts) {
  FakeSurvey fake;
  const SurveyPaths paths{fake.survey, fake.photos};
  fs::create_directories(WorkFolder(fake.survey).root);
  Stage stage;
  stage.name = "calib";
  std::string named;
  BoundStage bound{OptionTable("calib"), {}};
  bound.options.Add("ground_control", named, {}, "A file.").is_input_file = true;
  const auto take = [&] {
    HashCache hashes(WorkFolder(fake.survey).Hashes());
    Hashing progress(99);
    return TakeFingerprint(stage, bound, {paths, {}, 1, hashes, progress}).inputs;
  };
  EXPECT_TRUE(take().empty());
  named = "points.txt";
  EXPECT_EQ(take().at("points.txt"), kMissingInput);
  WriteFile(fake.survey / "points.txt", "one");
  const auto before = take();
  WriteFile(fake.survey / "points.txt", "other");
  EXPECT_NE(take(), before);
}

}  // namespace
}  // namespace stucco
