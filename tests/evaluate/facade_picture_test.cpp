// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/facade_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate/picture/tone.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/evaluate/made_pictures.h"

namespace stucco::evaluate {
namespace {

// Columns of light 0, 1, 2 ... on a plane of 0.1 m texels.
FacadePicture Ramp(int width, int height) {
  FacadePicture picture;
  picture.plane.metres_per_texel = 0.1;
  picture.plane.width_px = width;
  picture.plane.height_px = height;
  for (int i = 0; i < width * height; ++i) {
    picture.rgb.insert(picture.rgb.end(), 3, static_cast<float>(i % width));
    picture.known.push_back(1);
  }
  return picture;
}

TEST(Coarsened, TakesMeansOverBrokenNumbersOfTexels) {
  const FacadePicture coarse = Coarsened(Ramp(5, 5), 2.5);
  EXPECT_EQ(coarse.plane.width_px, 2);
  EXPECT_EQ(coarse.plane.height_px, 2);
  EXPECT_DOUBLE_EQ(coarse.plane.metres_per_texel, 0.25);
  // (0 + 1 + 2 / 2) / 2.5 and (2 / 2 + 3 + 4) / 2.5.
  EXPECT_FLOAT_EQ(coarse.rgb[0], 0.8f);
  EXPECT_FLOAT_EQ(coarse.rgb[3], 3.2f);
  EXPECT_EQ(CountKnown(coarse), 4u);
}

TEST(Coarsened, KnowsOnlyWhatIsKnownAsAWhole) {
  FacadePicture picture = Ramp(6, 4);
  picture.known[0] = 0;
  const FacadePicture coarse = Coarsened(picture, 2);
  EXPECT_EQ(coarse.known, (std::vector<uint8_t>{0, 1, 1, 1, 1, 1}));
}

TEST(Coarsened, LeavesFinerTexelsAndKeepsOneOfTinyPictures) {
  EXPECT_EQ(Coarsened(Ramp(5, 4), 0.3).rgb, Ramp(5, 4).rgb);
  const FacadePicture tiny = Coarsened(Ramp(2, 1), 16);
  EXPECT_EQ(tiny.plane.width_px, 1);
  EXPECT_FLOAT_EQ(tiny.rgb[0], 0.5f);
}

TEST(KeepInside, FollowsTheOutlineAndItsHoles) {
  FacadePicture picture = Ramp(10, 10);  // x 0 to 1, z 0 to -1
  Facet facet;
  facet.outer = {{0, 3, 0}, {0, 3, -1}, {0.5, 3, -1}, {0.5, 3, 0}};
  facet.holes = {{{0.1, 3, -0.1}, {0.3, 3, -0.1}, {0.3, 3, -0.4}, {0.1, 3, -0.4}}};
  KeepInside(facet, picture);
  EXPECT_EQ(CountKnown(picture), 50u - 6u);
  EXPECT_EQ(picture.known[11], 0);
  EXPECT_EQ(picture.known[5], 0);
  EXPECT_EQ(picture.known[4], 1);
}

TEST(Cropped, MovesTheOrigin) {
  FacadePicture picture = Ramp(6, 5);
  std::fill(picture.known.begin(), picture.known.end(), uint8_t{0});
  picture.known[6 + 2] = 1;
  picture.known[3 * 6 + 4] = 1;
  const FacadePicture cropped = Cropped(picture);
  EXPECT_EQ(cropped.plane.width_px, 3);
  EXPECT_EQ(cropped.plane.height_px, 3);
  EXPECT_TRUE(cropped.plane.origin.isApprox(Eigen::Vector3d(0.2, 0, -0.1)));
  EXPECT_EQ(cropped.rgb[0], 2);
  EXPECT_EQ(CountKnown(cropped), 2u);
  std::fill(picture.known.begin(), picture.known.end(), uint8_t{0});
  EXPECT_EQ(Cropped(picture).plane.width_px, 0);
  EXPECT_EQ(CountKnown(Cropped(picture)), 0u);
}

TEST(Middle, LimitsBothSides) {
  const FacadePicture middle = Middle(Ramp(7, 2), 3);
  EXPECT_EQ(middle.plane.width_px, 3);
  EXPECT_EQ(middle.plane.height_px, 2);
  EXPECT_EQ(middle.rgb[0], 2);
  EXPECT_EQ(middle.known.size(), 6u);
  EXPECT_TRUE(middle.plane.origin.isApprox(Eigen::Vector3d(0.2, 0, 0)));
  EXPECT_EQ(Middle(Ramp(7, 2), 100).rgb, Ramp(7, 2).rgb);
}

TEST(ReadFacadePicture, KnowsWhatPhotosPaintedInTheScenesFrame) {
  const std::filesystem::path folder = testing::TempDir();
  WriteImage(Plain(3, 1, 10, 128, 255), folder / "wall.png");
  WriteImage({3, 1, 1, {0, 7, 255}}, folder / "labels.png");
  TexturedFacet facet;
  facet.image = "wall.png";
  facet.label_image = "labels.png";
  facet.width_px = 3;
  facet.height_px = 1;
  facet.metres_per_texel = 0.02;
  facet.origin = {1, 2, 3};
  facet.v_axis = {0, 0, -1};
  Similarity truth_from_world;
  truth_from_world.scale = 2;
  truth_from_world.rotation = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ());
  const FacadePicture picture = ReadFacadePicture(facet, folder, truth_from_world);
  EXPECT_EQ(picture.known, (std::vector<uint8_t>{0, 1, 0}));
  EXPECT_EQ(picture.rgb[1], LightOfCode(128));
  EXPECT_TRUE(picture.plane.origin.isApprox(Eigen::Vector3d(-4, 2, 6)));
  EXPECT_TRUE(picture.plane.u_axis.isApprox(Eigen::Vector3d(0, 1, 0)));
  EXPECT_DOUBLE_EQ(picture.plane.metres_per_texel, 0.04);
  facet.label_image.clear();
  EXPECT_EQ(CountKnown(ReadFacadePicture(facet, folder, {})), 3u);
}

TEST(ReadFacadePicture, RefusesWhatIsNotAsSaid) {
  const std::filesystem::path folder = testing::TempDir();
  WriteImage(Plain(3, 2, 10, 10, 10), folder / "other.png");
  TexturedFacet facet;
  facet.image = "other.png";
  facet.width_px = 3;
  facet.height_px = 1;
  EXPECT_THROW(ReadFacadePicture(facet, folder, {}), Error);
  facet.height_px = 2;
  facet.label_image = "other.png";  // three channels
  EXPECT_THROW(ReadFacadePicture(facet, folder, {}), Error);
  facet.image = "missing.png";
  EXPECT_THROW(ReadFacadePicture(facet, folder, {}), Error);
}

}  // namespace
}  // namespace stucco::evaluate
