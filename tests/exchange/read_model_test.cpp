// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/read_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/colmap_io.h"
#include "survey/georef.h"
#include "tests/exchange/made_model.h"
#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using testing::HasSubstr;

class RecognizeModelTest : public testing::Test {
 protected:
  RecognizedModel Recognize(const std::string& path) { return RecognizeModel(photos.root / path); }
  Error Refused(const std::string& path) {
    Error error = RefusalOf([&] { Recognize(path); });
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr(path));
    return error;
  }

  RowOfPhotos photos;
};

TEST_F(RecognizeModelTest, KnowsFilesByTheirContents) {
  photos.Write("1.txt", "# Bundle file v0.3\n");
  EXPECT_EQ(Recognize("1.txt").format, ModelFormat::kBundler);
  photos.Write("2.txt", "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<BlocksExchange version=\"3.2\">");
  EXPECT_EQ(Recognize("2.txt").format, ModelFormat::kBlocksExchange);
  photos.Write("3.txt", " [{\"cameras\": {");
  EXPECT_EQ(Recognize("3.txt").format, ModelFormat::kOpenSfm);
}

TEST_F(RecognizeModelTest, KnowsFoldersByWhatLiesInThem) {
  WriteColmapText(MadeModel(), photos.root / "colmap");
  EXPECT_EQ(Recognize("colmap").format, ModelFormat::kColmap);
  photos.Write("bundler/bundle/bundle.out", "# Bundle file v0.3\n");
  EXPECT_EQ(Recognize("bundler").path, photos.root / "bundler/bundle/bundle.out");
  photos.Write("odm/opensfm/reconstruction.json", "[{\"cameras\": {");
  EXPECT_EQ(Recognize("odm").format, ModelFormat::kOpenSfm);
  photos.Write("photos/sub/c.xmp",
               "<x xmlns:xcr=\"http://www.capturingreality.com/ns/xcr/1.1#\"/>");
  EXPECT_EQ(Recognize("photos").format, ModelFormat::kRealityCapture);
}

TEST_F(RecognizeModelTest, SaysWhatItIsInstead) {
  EXPECT_THAT(Refused("gone").what(), HasSubstr("is not there"));
  EXPECT_THAT(Refused("photos").what(), HasSubstr("holds no model"));
  EXPECT_THAT(Refused("photos/a.jpg").remedy(), HasSubstr("COLMAP folder"));
  photos.Write("cameras.xml", "<document version=\"2.0.0\"><chunk label=\"1\">");
  EXPECT_THAT(Refused("cameras.xml").what(), HasSubstr("a camera file of Metashape"));
  photos.Write("a.xmp", "<x xmlns:xcr=\"http://www.capturingreality.com/ns/xcr/1.1#\"/>");
  EXPECT_THAT(Refused("a.xmp").remedy(), HasSubstr("name the folder"));
  photos.Write("two/1.out", "# Bundle file v0.3\n");
  photos.Write("two/2.xml", "<BlocksExchange/>");
  EXPECT_THAT(Refused("two").remedy(), HasSubstr("name one of them"));
}

TEST(ReadModel, AColmapModelKeepsTheFrameThatLiesBesideIt) {
  const RowOfPhotos photos;
  WriteColmapText(MadeModel(), photos.root / "colmap");
  const RecognizedModel source{ModelFormat::kColmap, photos.root / "colmap"};
  EXPECT_FALSE(ReadModel(source, photos.Index()).georef);
  WriteGeoref(MadePlace(), photos.root / "colmap/georef.json");
  const ExchangedModel read = ReadModel(source, photos.Index());
  ASSERT_TRUE(read.georef);
  EXPECT_EQ(read.georef->origin_height_m, 43.21);
  EXPECT_EQ(read.format, "COLMAP");
  EXPECT_EQ(read.model.photos.size(), 3u);
}

}  // namespace
}  // namespace stucco
