// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/page_pictures.h"

#include <gtest/gtest.h>

#include "survey/files.h"
#include "tests/evaluate/made_pictures.h"

namespace stucco::evaluate {
namespace {

TEST(PictureStem, IsAFileNameWhateverTheIdHolds) {
  EXPECT_EQ(PictureStem(12, "B0001/F03"), "pictures/0012-B0001_F03");
  EXPECT_EQ(PictureStem(3, "../../etc\xff\n"), "pictures/0003-______etc__");
  EXPECT_LT(PictureStem(0, std::string(5000, 'x')).size(), 100u);
}

TEST(RemovePagePictures, TakesOursAndLeavesOthers) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "remove_pictures";
  std::filesystem::remove_all(folder);
  RemovePagePictures(folder);  // nothing there
  const PicturePair pair{Plain(20, 20, 9, 9, 9), Plain(20, 20, 9, 9, 9), {}};
  const PagePictures names = WritePagePictures(pair, Flip(pair), folder, PictureStem(7, "B1/F2"));
  WriteFile(folder / "pictures/holiday-truth.jpg", "mine");
  RemovePagePictures(folder);
  EXPECT_FALSE(std::filesystem::exists(folder / names.truth));
  EXPECT_FALSE(std::filesystem::exists(folder / names.error));
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/holiday-truth.jpg"));
}

TEST(WritePagePictures, WritesThreePicturesGreyOutsideTheMask) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "page_pictures";
  const Image truth = Plain(2800, 40, 200, 30, 30);
  std::vector<uint8_t> mask(size_t{2800} * 40, 1);
  for (int y = 0; y < 40; ++y) std::fill_n(mask.begin() + y * 2800, 1400, uint8_t{0});
  const PicturePair pair{truth, Plain(2800, 40, 30, 30, 200), mask};
  const PagePictures names = WritePagePictures(pair, Flip(pair), folder, PictureStem(1, "a/b"));
  const Image shown = ReadImage(folder / names.truth);
  EXPECT_EQ(shown.width_px, 1400);
  EXPECT_EQ(shown.height_px, 20);
  EXPECT_NEAR(shown.Pixel(300, 10)[0], 0x80, 2);
  EXPECT_NEAR(shown.Pixel(1100, 10)[0], 200, 4);
  EXPECT_NEAR(ReadImage(folder / names.result).Pixel(1100, 10)[2], 200, 4);
  const Image error = ReadImage(folder / names.error);
  EXPECT_NEAR(error.Pixel(300, 10)[1], 0x80, 2);
  EXPECT_GT(error.Pixel(1100, 10)[0], 200);
}

}  // namespace
}  // namespace stucco::evaluate
