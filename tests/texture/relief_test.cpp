// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/grid/relief.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/survey/temporary_folder.h"
#include "texture/grid/relief_file.h"

namespace stucco::test {
namespace {

namespace fs = std::filesystem;

// Four by three cells of half a metre; one of them stands out by 0.6 m, one lies back by 0.2 m.
Relief Made() {
  Relief relief;
  relief.cell = 0.5;
  relief.width = 4;
  relief.height = 3;
  relief.step = 0.1;
  relief.highest = 0.6f;
  relief.heights.assign(12, 0);
  relief.heights[1 * 4 + 2] = 0.6f;
  relief.heights[2 * 4 + 0] = -0.2f;
  return relief;
}

TEST(Relief, HasTheHeightOfTheCell) {
  const Relief relief = Made();
  EXPECT_FLOAT_EQ(relief.HeightAt(1.2, 0.7), 0.6);
  EXPECT_FLOAT_EQ(relief.HeightAt(1.6, 0.7), 0);
  EXPECT_FLOAT_EQ(relief.HeightAt(-9, 99), -0.2);  // the nearest
}

TEST(Relief, IsLevelWhereNothingChanges) {
  const Relief relief = Made();
  EXPECT_TRUE(relief.IsLevel({0.1, 0.1}, {1.9, 0.4}));
  EXPECT_TRUE(relief.IsLevel({1.1, 0.6}, {1.4, 0.9}));
  EXPECT_FALSE(relief.IsLevel({0.9, 0.6}, {1.4, 0.9}));
}

TEST(Relief, HidesWhatLiesBehindIt) {
  const Relief relief = Made();
  const Eigen::Vector3d left(0.2, 0.7, 0);
  EXPECT_TRUE(relief.Hides(left, {5, 0.7, 2}));              // past the cell that stands out
  EXPECT_FALSE(relief.Hides(left, {-5, 0.7, 2}));            // away from it
  EXPECT_FALSE(relief.Hides(left, {0.2, 0.7, 9}));           // straight before
  EXPECT_FALSE(relief.Hides(left, {1.9, 0.7, 9}));           // steeply over it
  EXPECT_FALSE(relief.Hides({1.2, 0.7, 0.6}, {5, 0.7, 2}));  // on top of it
  EXPECT_TRUE(relief.Hides(left, {5, 0.7, -1}));             // from behind the facet
}

TEST(ReliefFiles, AreReadAsWritten) {
  const TemporaryFolder folder;
  const Relief relief = Made();
  const ReliefFiles files = EncodeRelief(relief);
  fs::create_directories(folder.path() / kReliefFolder);
  WriteFile(folder.path() / kReliefFolder / "wall.png", files.png);
  WriteFile(folder.path() / kReliefFolder / "wall.json", files.json);
  const auto read = ReadRelief(folder.path(), "wall");
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->cell, relief.cell);
  EXPECT_EQ(read->step, relief.step);
  EXPECT_EQ(read->width, 4);
  EXPECT_EQ(read->height, 3);
  EXPECT_NEAR(read->highest, 0.6, 1e-6);
  for (size_t i = 0; i < relief.heights.size(); ++i) {
    EXPECT_NEAR(read->heights[i], relief.heights[i], 1e-6) << i;
  }
  EXPECT_EQ(ReadRelief(folder.path(), "roof"), nullptr);
}

TEST(ReliefFiles, AreRefusedWhenDamaged) {
  const TemporaryFolder folder;
  const ReliefFiles files = EncodeRelief(Made());
  const fs::path picture = folder.path() / kReliefFolder / "wall.png";
  const fs::path description = folder.path() / kReliefFolder / "wall.json";
  fs::create_directories(picture.parent_path());
  WriteFile(description, files.json);
  for (const size_t bytes : {size_t{0}, size_t{20}}) {
    WriteFile(picture, files.png.substr(0, bytes));
    try {
      ReadRelief(folder.path(), "wall");
      ADD_FAILURE() << "took " << bytes << " bytes for a picture";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("wall.png"));
    }
  }
  WriteFile(picture, files.png);
  WriteFile(description, "{");
  EXPECT_THROW(ReadRelief(folder.path(), "wall"), Error);
}

}  // namespace
}  // namespace stucco::test
