// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/photo_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PhotoIndex, FindsPhotosByTheEndOfTheirPath) {
  const RowOfPhotos photos;
  photos.AddPhoto("photos/other/c.jpg", 20, 10);
  const PhotoIndex index = photos.Index();
  EXPECT_EQ(index.Find("a.jpg"), "a.jpg");
  EXPECT_EQ(index.Find("./a.jpg"), "a.jpg");
  EXPECT_EQ(index.Find("E:\\work\\photos\\sub\\c.jpg"), "sub/c.jpg");
  EXPECT_EQ(index.Find("/mnt/other/c.jpg"), "other/c.jpg");
  EXPECT_EQ(index.Find("elsewhere/c.jpg"), std::nullopt);  // two have that name
  EXPECT_EQ(index.Find("z.jpg"), std::nullopt);
  EXPECT_EQ(index.SizeOf("other/c.jpg").width_px, 20);
}

TEST(PhotoIndex, FindsThePhotosOfSidecars) {
  const RowOfPhotos photos;
  const PhotoIndex index = photos.Index();
  EXPECT_EQ(index.FindBySidecar("sub/c.xmp"), "sub/c.jpg");
  EXPECT_EQ(index.FindBySidecar("c.xmp"), "sub/c.jpg");
  EXPECT_EQ(index.FindBySidecar("z.xmp"), std::nullopt);
}

TEST(PhotoIndex, RequiresEveryNameOnce) {
  const RowOfPhotos photos;
  const PhotoIndex index = photos.Index();
  EXPECT_THAT(index.Require({"b.jpg", "x/a.jpg"}), ElementsAre("b.jpg", "a.jpg"));
  EXPECT_THAT(RefusalOf([&] {
                index.Require({"a.jpg", "x.jpg", "y.jpg"});
              }).what(),
              HasSubstr("2 of 3 photos of the model are not in"));
  EXPECT_THAT(RefusalOf([&] {
                index.Require({"a.jpg", "x/a.jpg"});
              }).what(),
              HasSubstr("a.jpg more than once"));
}

}  // namespace
}  // namespace stucco
