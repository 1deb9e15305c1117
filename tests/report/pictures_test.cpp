// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/report/made_survey.h"

namespace stucco {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Pictures : public testing::Test {
 protected:
  Pictures() {
    WriteSurvey(made_, folder_.path());
    row_.texture = &made_.textures.facets[0];
  }

  FacetPictures Make(int picture_px = 300) {
    return MakeFacetPictures(row_, folder_.path() / "texture", picture_px);
  }

  test::TemporaryFolder folder_;
  MadeSurvey made_ = MakeSurvey();
  FacetRow row_;
};

TEST_F(Pictures, AreEmbeddedAtTheirSize) {
  const FacetPictures pictures = Make();
  EXPECT_THAT(pictures.problem, IsEmpty());
  EXPECT_THAT(pictures.texture.uri, StartsWith("data:image/jpeg;base64,/9j/"));
  EXPECT_THAT(pictures.labels.uri, StartsWith("data:image/png;base64,iVBOR"));
  EXPECT_EQ(std::max(pictures.texture.width_px, pictures.texture.height_px), 300);
  EXPECT_EQ(std::max(pictures.thumbnail.width_px, pictures.thumbnail.height_px), 176);
  EXPECT_LT(pictures.thumbnail.uri.size(), 20000U);
}

TEST_F(Pictures, AreReadByAsManyThreadsAsFitIntoMemory) {
  made_.textures.facets[0].width_px = 8192;
  made_.textures.facets[0].height_px = 8192;
  FacetRow unpainted;
  const std::vector<FacetRow> rows = {unpainted, row_, unpainted};
  const uint64_t gigabyte = uint64_t{1} << 30;
  EXPECT_EQ(PictureThreads(rows, 16, 64 * gigabyte), 16);
  EXPECT_EQ(PictureThreads(rows, 16, gigabyte), 2);  // 7 bytes for each of 64 M texels
  EXPECT_EQ(PictureThreads(rows, 16, 1), 1);
  EXPECT_EQ(PictureThreads({unpainted}, 16, gigabyte), 16);
  EXPECT_EQ(PictureThreads({}, 0, 0), 1);
}

TEST_F(Pictures, SharesAreThoseOfTheLabelMap) {
  const auto shares = Make().photo_shares;
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_NEAR(shares[0] + shares[1] + shares[2], 1, 1e-12);
  EXPECT_NEAR(shares[1], 1 / 3.0, 0.02);
}

TEST_F(Pictures, MissingOnesAreNamed) {
  const auto texture = folder_.path() / "texture";
  std::filesystem::remove(texture / row_.texture->image);
  FacetPictures pictures = Make();
  EXPECT_EQ(pictures.problem, "texture/" + row_.texture->image + " is missing");
  EXPECT_THAT(pictures.texture.uri, IsEmpty());
  EXPECT_THAT(pictures.thumbnail.uri, IsEmpty());
  std::ofstream(texture / row_.texture->image) << "not a picture";
  pictures = Make();
  EXPECT_THAT(pictures.problem, HasSubstr("cannot be read"));
}

TEST_F(Pictures, WithoutLabelMapThereIsStillAPicture) {
  std::filesystem::remove(folder_.path() / "texture" / row_.texture->label_image);
  const FacetPictures pictures = Make();
  EXPECT_THAT(pictures.problem, HasSubstr("labels/"));
  EXPECT_THAT(pictures.texture.uri, StartsWith("data:"));
  EXPECT_THAT(pictures.labels.uri, IsEmpty());
  EXPECT_THAT(pictures.photo_shares, IsEmpty());
}

TEST_F(Pictures, AnUnpaintedFacadeHasNoneAndNoProblem) {
  row_.texture = nullptr;
  EXPECT_THAT(Make().problem, IsEmpty());
  TexturedFacet unpainted;
  row_.texture = &unpainted;
  EXPECT_THAT(Make().problem, IsEmpty());
  EXPECT_THAT(Make().texture.uri, IsEmpty());
}

TEST(LabelColor, RepeatsAfterTwelve) {
  EXPECT_EQ(LabelColor(0), "#4477aa");
  EXPECT_NE(LabelColor(0), LabelColor(1));
  EXPECT_EQ(LabelColor(12), LabelColor(0));
}

TEST(PictureSide, ShrinksWithTheNumberOfFacades) {
  EXPECT_EQ(PictureSide_px(900, 1), 900);
  EXPECT_EQ(PictureSide_px(900, 60), 900);
  EXPECT_LT(PictureSide_px(900, 500), 400);
  EXPECT_EQ(PictureSide_px(900, 100000), 240);
  EXPECT_EQ(PictureSide_px(100, 100000), 100);
}

}  // namespace
}  // namespace stucco
