// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/photos/resample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "survey/error.h"
#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::LookFrom;
using test::MakeWall;
using test::Psnr;
using test::Render;
using test::TemporaryFolder;
using test::WallPicture;
using test::WallScene;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

PhotoPyramid PyramidOf(const SurveyPhoto& photo) {
  Image image = Render(photo, WallScene(4, 3));
  const int width = image.width_px;
  const int height = image.height_px;
  return BuildPyramid(std::move(image), width, height);
}

Image AsImage(const SampledTile& tile, int width, int height) {
  Image image;
  image.width_px = width;
  image.height_px = height;
  for (float value : tile.rgb) image.data.push_back(static_cast<uint8_t>(value + 0.5f));
  return image;
}

double PsnrOf(const SurveyPhoto& photo, double texel) {
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, texel, 8192);
  const SampledTile tile =
      SamplePhoto(photo, PyramidOf(photo), grid, {0, 0, grid.width, grid.height});
  for (uint8_t valid : tile.valid) EXPECT_EQ(valid, 1);
  return Psnr(AsImage(tile, grid.width, grid.height), WallPicture(grid));
}

TEST(SamplePhoto, RectifiesAFrontalPhoto) {
  EXPECT_GT(PsnrOf(LookFrom("a", {2, -4, 1.5}, {2, 0, 1.5}, {900, 680, 800}), 0.01), 30);
}

TEST(SamplePhoto, RectifiesAnObliquePhoto) {
  EXPECT_GT(PsnrOf(LookFrom("a", {5, -4, 3.5}, {2, 0, 1.5}, {1200, 900, 800}), 0.01), 27);
}

TEST(SamplePhoto, UndoesLensDistortion) {
  SurveyPhoto photo = LookFrom("a", {2.2, -4, 1.6}, {2, 0, 1.5}, {1000, 800, 800});
  photo.camera.model = CameraModel::kOpenCv;
  photo.camera.params = {800, 805, 498, 403, -0.12, 0.05, 0.002, -0.001};
  EXPECT_GT(PsnrOf(photo, 0.01), 29);
}

TEST(SamplePhoto, AveragesPhotoPixelsSmallerThanTexels) {
  EXPECT_GT(PsnrOf(LookFrom("a", {2, -4, 1.5}, {2, 0, 1.5}, {900, 680, 800}), 0.04), 30);
  EXPECT_GT(PsnrOf(LookFrom("a", {5, -4, 3.5}, {2, 0, 1.5}, {1200, 900, 800}), 0.05), 29);
}

TEST(SamplePhoto, AveragesAFineCheckerboardToGrey) {
  const SurveyPhoto photo = LookFrom("a", {2, -4, 1.5}, {2, 0, 1.5}, {640, 480, 400});
  Image image;
  image.width_px = 640;
  image.height_px = 480;
  for (int i = 0; i < 640 * 480; ++i) {
    image.data.insert(image.data.end(), 3, (i % 640 + i / 640) % 2 == 0 ? 255 : 0);
  }
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, 0.05, 8192);  // 5 pixels a texel
  const SampledTile tile = SamplePhoto(photo, BuildPyramid(std::move(image), 640, 480), grid,
                                       {0, 0, grid.width, grid.height});
  for (float value : tile.rgb) EXPECT_NEAR(value, 127.5, 2);
}

TEST(SamplePhoto, LeavesOutWhatThePhotoDoesNotShow) {
  const SurveyPhoto photo = LookFrom("a", {0, -4, 1.5}, {0, 0, 1.5}, {900, 800, 800});
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, 0.01, 8192);
  const SampledTile tile =
      SamplePhoto(photo, PyramidOf(photo), grid, {0, 0, grid.width, grid.height});
  // 450 px right of the axis are 2.25 m on the wall.
  for (int x = 0; x < grid.width; ++x) {
    EXPECT_EQ(tile.valid[150 * grid.width + x], x < 224 || (x == 224 && tile.valid[x])) << x;
  }
}

TEST(SamplePhoto, TilesFitTogether) {
  const SurveyPhoto photo = LookFrom("a", {5, -4, 3.5}, {2, 0, 1.5}, {600, 450, 400});
  const PhotoPyramid pyramid = PyramidOf(photo);
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, 0.02, 8192);
  const SampledTile whole = SamplePhoto(photo, pyramid, grid, {0, 0, grid.width, grid.height});
  const Tile part{64, 32, 48, 48};
  const SampledTile piece = SamplePhoto(photo, pyramid, grid, part);
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const size_t i = static_cast<size_t>(y + part.y) * grid.width + x + part.x;
      EXPECT_FLOAT_EQ(piece.rgb[3 * (y * part.width + x)], whole.rgb[3 * i]);
    }
  }
}

TEST(SamplePhoto, FollowsAShift) {
  const SurveyPhoto photo = LookFrom("a", {2, -4, 1.5}, {2, 0, 1.5}, {900, 680, 800});
  const PhotoPyramid pyramid = PyramidOf(photo);
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, 0.01, 8192);
  GridShift shift;
  shift.terms[0] = 3;
  shift.terms[1] = -2;
  const SampledTile moved = SamplePhoto(photo, pyramid, grid, {100, 100, 64, 64}, shift);
  const SampledTile plain = SamplePhoto(photo, pyramid, grid, {103, 98, 64, 64});
  for (size_t i = 0; i < moved.rgb.size(); ++i) EXPECT_NEAR(moved.rgb[i], plain.rgb[i], 2);
}

TEST(GridShift, IsAHomographyToFirstOrder) {
  GridShift shift;
  shift.center = {100, 50};
  shift.radius = 100;
  shift.terms << 1, 2, 3, 4, 5, 6, 7, 8;
  const Eigen::Vector2d at = shift.At({150, 75});  // q = (0.5, 0.25)
  const double bend = 7 * 0.5 + 8 * 0.25;
  EXPECT_NEAR(at.x(), 1 + 3 * 0.5 + 4 * 0.25 + 0.5 * bend, 1e-12);
  EXPECT_NEAR(at.y(), 2 + 5 * 0.5 + 6 * 0.25 + 0.25 * bend, 1e-12);
}

TEST(PhotoCache, DecodesOnceAndForgetsTheOldest) {
  const TemporaryFolder folder;
  Image image;
  image.width_px = 200;
  image.height_px = 100;
  image.data.assign(60000, 90);
  for (const char* name : {"a.jpg", "b.jpg", "c.jpg"}) WriteImage(image, folder.path() / name);
  PhotoCache cache(folder.path(), 170000);  // two photos with their halvings
  const auto a = cache.Get("a.jpg", 0);
  EXPECT_EQ(a->levels.size(), 3u);
  EXPECT_EQ(a->levels[1].width_px, 100);
  EXPECT_EQ(cache.Get("a.jpg", 0), a);
  cache.Get("b.jpg", 0);
  cache.Get("c.jpg", 0);
  EXPECT_LE(cache.bytes(), 170000u);
  EXPECT_NE(cache.Get("a.jpg", 0), a);
  EXPECT_EQ(cache.Get("a.jpg", 50)->levels[0].width_px, 50);
  EXPECT_EQ(cache.Get("a.jpg", 50)->full_width_px, 200);
  EXPECT_THROW(cache.Get("missing.jpg", 0), Error);
  PhotoCache prepared(folder.path(), 170000, [](const std::string& name, Image& photo) {
    photo.Pixel(0, 0)[0] = name == "b.jpg" ? 250 : 0;
  });
  EXPECT_EQ(prepared.Get("b.jpg", 0)->levels[0].Pixel(0, 0)[0], 250);
  EXPECT_GT(prepared.Get("b.jpg", 0)->levels[1].Pixel(0, 0)[0], 100);
}

}  // namespace
}  // namespace stucco
