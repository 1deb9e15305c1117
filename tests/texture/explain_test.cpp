// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "survey/files.h"
#include "tests/texture/wall_survey.h"

namespace stucco {
namespace {

constexpr int kPictureWidth = 30;
constexpr int kPictureHeight = 20;

RasterPicture Plain(float grey) {
  RasterPicture picture;
  picture.sight.assign(kPictureWidth * kPictureHeight, Sight::kFree);
  picture.cost.assign(kPictureWidth * kPictureHeight, 0);
  picture.rgb.assign(3 * kPictureWidth * kPictureHeight, grey);
  return picture;
}

// Two grey candidates: the first paints the left two thirds, the second the rest; something stands
// before the second's left half, and the first looks past the top row.
PaintRecord MadeRecord() {
  PaintRecord record;
  record.raster.grid.width = kPictureWidth;
  record.raster.grid.height = kPictureHeight;
  record.raster.inside.assign(kPictureWidth * kPictureHeight, 1);
  record.photos = {1, 0};
  record.pictures = {Plain(100), Plain(200)};
  for (int i = 0; i < kPictureWidth * kPictureHeight; ++i) {
    record.owner.push_back(i % kPictureWidth < 20 ? 0 : 1);
    if (i % kPictureWidth < 15) record.pictures[1].sight[i] = Sight::kBehind;
    if (i < kPictureWidth) record.pictures[0].sight[i] = Sight::kBeyond;
  }
  return record;
}

std::array<int, 3> At(const Image& image, int x, int y) {
  const uint8_t* pixel = image.Pixel(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

TEST(CandidateSheet, ShowsWhatStandsBeforeAFacetAndWhatIsBeyond) {
  const std::vector<SurveyPhoto> photos = {
      test::LookFrom("a.jpg", {0, -5, 0}, {0, 0, 0}, {40, 30, 50}),
      test::LookFrom("b.jpg", {1, -5, 0}, {0, 0, 0}, {40, 30, 50})};
  const Image sheet = CandidateSheet(MadeRecord(), photos);
  // Cells of 316 x 334 pixels; pictures of 300 x 200 that begin at (8, 8).
  ASSERT_EQ(sheet.width_px, 4 * 316);
  ASSERT_EQ(sheet.height_px, 334);
  EXPECT_EQ(At(sheet, 150, 150), (std::array{100, 100, 100}));
  EXPECT_GT(At(sheet, 150, 10)[2], At(sheet, 150, 10)[0] + 50);         // beyond
  EXPECT_GT(At(sheet, 316 + 60, 100)[0], At(sheet, 316 + 60, 100)[1]);  // behind
  EXPECT_EQ(At(sheet, 316 + 250, 100), (std::array{200, 200, 200}));
  EXPECT_EQ(At(sheet, 2 * 316 + 100, 100), (std::array{255, 255, 255}));  // no third candidate
}

TEST(OwnerMap, GivesEachPhotoAColourAndDrawsTheSeam) {
  PaintRecord record = MadeRecord();
  for (int y = 0; y < kPictureHeight; ++y) record.owner[y * kPictureWidth] = -1;
  const Image map = OwnerMap(record);
  ASSERT_EQ(map.width_px, 1600);
  const double scale = 1600.0 / kPictureWidth;
  const auto at = [&](double x, double y) {
    return At(map, static_cast<int>(x * scale), static_cast<int>(y * scale));
  };
  EXPECT_EQ(at(0.5, 10.5), (std::array{255, 255, 255}));
  EXPECT_EQ(at(20.5, 10.5), (std::array{0, 0, 0}));
  EXPECT_EQ(at(5.5, 10.5), at(18.5, 3.5));
  EXPECT_NE(at(5.5, 10.5), at(25.5, 10.5));
}

TEST(ReliefMap, TellsBeforeFromBehind) {
  PaintedFacet painted;
  EXPECT_TRUE(ReliefMap(painted).data.empty());
  painted.grid.relief =
      std::make_shared<Relief>(Relief{0.1, 4, 2, 0.05, 0.6, {0, 0.6f, 0.3f, -0.6f, 0, 0, 0, 0}});
  const Image map = ReliefMap(painted);
  ASSERT_EQ(map.width_px, 1600);
  EXPECT_EQ(At(map, 200, 200), (std::array{255, 255, 255}));
  EXPECT_EQ(At(map, 600, 200), (std::array{255, 0, 0}));
  EXPECT_EQ(At(map, 1000, 200), (std::array{255, 100, 100}));
  EXPECT_EQ(At(map, 1400, 200), (std::array{0, 0, 255}));
}

// The pictures that explain a facet are left also where the facet itself comes from a checkpoint,
// and change nothing in what is painted.
TEST(RunTexture, LeavesExplanationsWhenAsked) {
  test::WallSurvey survey;
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5});
  survey.Add("b.jpg", {3.5, -4.5, 2}, {2, 0, 1.5}, 0.7);
  TextureOptions options;
  const TextureSet plain = survey.Run(options, "plain");
  options.debug = true;
  const TextureSet explained = survey.Run(options, "explained");
  const std::filesystem::path folder = survey.Out("explained") / "debug";
  EXPECT_FALSE(std::filesystem::exists(survey.Out("plain") / "debug"));
  ASSERT_EQ(explained.facets.size(), 1u);
  EXPECT_EQ(ReadFile(survey.Out("plain") / plain.facets[0].image),
            ReadFile(survey.Out("explained") / explained.facets[0].image));
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    names.insert(entry.path().filename().string());
    EXPECT_GT(ReadImage(entry.path()).width_px, 0);
  }
  EXPECT_TRUE(names.contains("candidates.jpg"));
  EXPECT_TRUE(names.contains("owners.png"));
  EXPECT_TRUE(names.contains("light.jpg"));
}

}  // namespace
}  // namespace stucco
