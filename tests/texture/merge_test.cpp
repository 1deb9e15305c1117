// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr int kWidth = 40;
constexpr int kHeight = 10;

FacetPicture Plain(uint8_t grey, uint8_t label) {
  FacetPicture picture;
  picture.picture = {kWidth, kHeight, 3, std::vector<uint8_t>(3 * kWidth * kHeight, grey)};
  picture.labels.assign(kWidth * kHeight, label);
  return picture;
}

const std::vector<uint8_t> kInside(kWidth* kHeight, 1);

TEST(TexelsToTake, ReplacingTakesWhatIsPaintedAndFillingOnlyGaps) {
  FacetPicture before = Plain(10, 1);
  FacetPicture after = Plain(200, 3);
  before.labels[0] = 255;
  before.labels[1] = 0;
  after.labels[2] = 255;
  after.labels[1] = 2;
  const auto replaced = TexelsToTake(FacetChoice::kReplaced, before, after);
  const auto filled = TexelsToTake(FacetChoice::kFilled, before, after);
  EXPECT_THAT(std::vector<uint8_t>(replaced.begin(), replaced.begin() + 4),
              ElementsAre(1, 1, 0, 1));
  EXPECT_THAT(std::vector<uint8_t>(filled.begin(), filled.begin() + 4), ElementsAre(1, 1, 0, 0));
}

TEST(MergePictures, GoesOverWithinAFewTexelsOfTheTakenSide) {
  const FacetPicture before = Plain(10, 1);
  const FacetPicture after = Plain(210, 2);
  std::vector<uint8_t> take(kInside.size(), 0);
  for (size_t i = 0; i < take.size(); ++i) take[i] = i % kWidth >= 20;
  const FacetPicture merged = MergePictures(before, after, take, kInside, 4);
  EXPECT_EQ(*merged.picture.Pixel(19, 5), 10);  // the old side keeps its bytes
  EXPECT_EQ(*merged.picture.Pixel(39, 5), 210);
  EXPECT_GT(*merged.picture.Pixel(21, 5), 10);
  EXPECT_LT(*merged.picture.Pixel(21, 5), 110);
  EXPECT_EQ(merged.labels[5 * kWidth + 19], 5);  // after the four new photos
  EXPECT_EQ(merged.labels[5 * kWidth + 20], 2);
}

// A gable: outside of it there is no old picture to go over to.
TEST(MergePictures, GoesOverToNothingAtTheRimOfTheFacet) {
  const FacetPicture before = Plain(10, 1);
  const FacetPicture after = Plain(210, 2);
  std::vector<uint8_t> gable(kInside.size(), 0);
  for (size_t i = 0; i < gable.size(); ++i) {
    gable[i] = static_cast<int>(i % kWidth) <= 2 * static_cast<int>(i / kWidth) + 10;
  }
  const FacetPicture merged = MergePictures(before, after, gable, gable, 4);
  for (size_t i = 0; i < gable.size(); ++i) {
    if (gable[i] == 0) continue;
    EXPECT_EQ(merged.picture.data[3 * i], 210) << i;
  }
}

TEST(FillOutdated, TakesTextureFromWhatIsNew) {
  FacetPicture picture = Plain(200, 2);
  std::vector<uint8_t> hole(kInside.size(), 0), source = kInside;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const size_t i = static_cast<size_t>(y) * kWidth + x;
      if (x >= 18 && x < 22) {
        hole[i] = 1;
        source[i] = 0;
        picture.labels[i] = 5;
        std::fill_n(picture.picture.Pixel(x, y), 3, uint8_t{10});
      } else if (x >= 34) {
        source[i] = 0;  // an old part that stays
        std::fill_n(picture.picture.Pixel(x, y), 3, uint8_t{90});
      }
    }
  }
  FillOutdated(hole, source, picture);
  EXPECT_NEAR(*picture.picture.Pixel(20, 5), 200, 2);
  EXPECT_EQ(picture.labels[5 * kWidth + 20], 255);
  EXPECT_EQ(*picture.picture.Pixel(36, 5), 90);
  EXPECT_EQ(picture.labels[5 * kWidth + 36], 2);
}

TEST(MergePictures, TakingAllOrNothingIsOneOfThem) {
  const FacetPicture before = Plain(10, 1);
  const FacetPicture after = Plain(210, 2);
  const auto all = MergePictures(before, after, kInside, kInside, 2);
  EXPECT_EQ(all.picture.data, after.picture.data);
  EXPECT_EQ(all.labels, after.labels);
  const std::vector<uint8_t> none(kInside.size(), 0);
  const auto nothing = MergePictures(before, after, none, kInside, 2);
  EXPECT_EQ(nothing.picture.data, before.picture.data);
  EXPECT_THAT(nothing.labels, Each(3));
}

TEST(MergePictures, PhotosThatCannotBeNumberedAreNotNamed) {
  const std::vector<uint8_t> none(kInside.size(), 0);
  const auto merged = MergePictures(Plain(10, 200), Plain(210, 2), none, kInside, 60);
  EXPECT_THAT(merged.labels, Each(255));
}

TEST(Renumber, MostTexelsFirst) {
  std::vector<uint8_t> labels = {0, 7, 2, 7, 255, 7, 2, 4};
  EXPECT_THAT(Renumber(labels), ElementsAre(6, 1, 3));
  EXPECT_THAT(labels, ElementsAre(0, 1, 2, 1, 255, 1, 2, 3));
}

}  // namespace
}  // namespace stucco
