// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/hash_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "pipeline/engine/work_folder.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

TEST(HashCache, NothingIsHashedTwice) {
  FakeSurvey fake;
  fake.Run();
  std::this_thread::sleep_for(std::chrono::milliseconds(60));  // past the age of young stamps
  fake.Run();
  HashCache hashes(WorkFolder(fake.survey).Hashes());
  for (const std::string& photo : FilesBelow(fake.photos)) {
    EXPECT_TRUE(hashes.Remembers(fake.photos / photo)) << photo;
    EXPECT_EQ(hashes.Hash(fake.photos / photo), HashFile(fake.photos / photo));
  }
}

}  // namespace
}  // namespace stucco
