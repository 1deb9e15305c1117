// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

TEST(Units, KeepBytesUnderAnyKey) {
  const FakeSurvey fake;
  int heard = 0;
  DiskUnits units(fake.root / "units", [&](auto, auto, size_t) { ++heard; });
  const std::string bytes("\0\n\xff bytes", 9);
  const std::string long_key(5000, 'k');
  for (const std::string key : {"plain-1.2_x", "a/../../b", "", ".hidden", long_key.c_str()}) {
    EXPECT_FALSE(units.Load("kind", key)) << key;
    units.Save("kind", key, bytes);
    EXPECT_EQ(units.Load("kind", key), bytes) << key;
  }
  units.Save("kind", "empty", "");
  EXPECT_EQ(units.Load("kind", "empty"), "");
  EXPECT_EQ(heard, 6);
  EXPECT_EQ(units.counts().at("kind").computed, 6);
  EXPECT_EQ(units.counts().at("kind").reused, 0);
  EXPECT_EQ(FilesBelow(fake.root / "units").size(), 6u);
  EXPECT_TRUE(fs::exists(fake.root / "units/kind/plain-1.2_x"));
}

TEST(Units, DamageInAnyByteIsAbsence) {
  const FakeSurvey fake;
  const fs::path path = fake.root / "units/kind/key";
  DiskUnits(fake.root / "units", nullptr).Save("kind", "key", "some bytes");
  const std::string good = ReadFile(path);
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] ^= 4;
    WriteFile(path, bad);
    EXPECT_FALSE(DiskUnits(fake.root / "units", nullptr).Load("kind", "key")) << i;
    WriteFile(path, good.substr(0, i));
    EXPECT_FALSE(DiskUnits(fake.root / "units", nullptr).Load("kind", "key")) << i;
  }
  WriteFile(path, good);
  EXPECT_EQ(DiskUnits(fake.root / "units", nullptr).Load("kind", "key"), "some bytes");
}

TEST(Units, OnlyUsedOnesStay) {
  const FakeSurvey fake;
  {
    DiskUnits units(fake.root / "units", nullptr);
    units.Save("a", "1", "x");
    units.Save("a", "2", "x");
    units.Save("b", "3", "x");
  }
  DiskUnits units(fake.root / "units", nullptr);
  units.Load("a", "2");
  units.Save("c", "4", "x");
  units.DeleteUntouched();
  EXPECT_THAT(FilesBelow(fake.root / "units"), ElementsAre("a/2", "c/4"));
}

}  // namespace
}  // namespace stucco
