// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/select.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace stucco {
namespace {

constexpr int kSide = 40;

TexelGrid Raster() {
  TexelGrid raster;
  raster.width = kSide;
  raster.height = kSide;
  return raster;
}

// A picture of a smooth wall, all free, at the same cost everywhere.
RasterPicture Wall(float cost) {
  RasterPicture picture;
  picture.sight.assign(kSide * kSide, Sight::kFree);
  picture.cost.assign(kSide * kSide, cost);
  for (int i = 0; i < kSide * kSide; ++i) {
    picture.rgb.insert(picture.rgb.end(), 3, 100.0f + static_cast<float>(i % kSide));
  }
  return picture;
}

template <typename Fn>
void ForSquare(int x0, int y0, int x1, int y1, Fn&& fn) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) fn(static_cast<size_t>(y) * kSide + x);
  }
}

std::vector<int> Select(const std::vector<RasterPicture>& pictures, SelectOptions options = {}) {
  const std::vector<uint16_t> inside(kSide * kSide, 1);
  return SelectPictures(pictures, {Raster(), inside, 1}, options);
}

std::vector<std::vector<float>> DisagreementOf(const std::vector<RasterPicture>& pictures) {
  return Disagreement(pictures, FindConsensus(pictures, Raster()), Raster());
}

TEST(Disagreement, FindsTheOneThatShowsSomethingElse) {
  std::vector<RasterPicture> pictures = {Wall(0.1f), Wall(0.1f), Wall(0.1f)};
  ForSquare(10, 10, 20, 20, [&](size_t i) { pictures[1].rgb[3 * i] = 230; });
  const auto disagreement = DisagreementOf(pictures);
  EXPECT_GT(disagreement[1][15 * kSide + 15], 0.7f);
  EXPECT_EQ(disagreement[0][15 * kSide + 15], 0);
  EXPECT_EQ(disagreement[1][30 * kSide + 30], 0);
}

TEST(Disagreement, OfTwoIsNobodysFault) {
  std::vector<RasterPicture> pictures = {Wall(0.1f), Wall(0.1f)};
  ForSquare(10, 10, 20, 20, [&](size_t i) { pictures[1].rgb[3 * i] = 230; });
  for (const auto& costs : DisagreementOf(pictures)) {
    EXPECT_EQ(*std::max_element(costs.begin(), costs.end()), 0);
  }
}

// A dark square 3 texels before the wall, as a camera sees it whose line of sight goes `across`
// texels to the right for each that it comes nearer.
RasterPicture WithRelief(float cost, double across) {
  constexpr int kHeight = 3;
  RasterPicture picture = Wall(cost);
  const auto shift = static_cast<int>(-kHeight * across);
  ForSquare(15 + shift, 15, 23 + shift, 23,
            [&](size_t i) { std::fill_n(&picture.rgb[3 * i], 3, 20.0f); });
  picture.camera = {kSide / 2 + 1e4 * across, kSide / 2, 1e4};
  return picture;
}

TEST(Disagreement, ReliefIsNoReasonToOutvoteWhoLooksStraight) {
  const std::vector<RasterPicture> pictures = {WithRelief(0.0f, 0), WithRelief(0.5f, 2),
                                               WithRelief(0.5f, 2), WithRelief(0.5f, 2)};
  const size_t middle = size_t{19} * kSide + 19;
  EXPECT_GT(DisagreementOf(pictures)[0][middle], 0.7f);
  const Consensus consensus = FindConsensus(pictures, Raster());
  const auto forgiven = [&](double relief) {
    std::vector<std::vector<float>> disagreement = DisagreementOf(pictures);
    ForgiveRelief(pictures, consensus, Raster(), relief, disagreement);
    return disagreement[0][middle];
  };
  EXPECT_LT(forgiven(4), 0.1f);
  EXPECT_GT(forgiven(1), 0.7f);
  SelectOptions options;
  options.relief = 4;
  const std::vector<int> owner = Select(pictures, options);
  EXPECT_EQ(std::count(owner.begin(), owner.end(), 0), kSide * kSide);
}

TEST(Disagreement, WhatStandsFarBeforeTheWallIsNoRelief) {
  std::vector<RasterPicture> pictures = {WithRelief(0.0f, 0), WithRelief(0.5f, 2),
                                         WithRelief(0.5f, 2), WithRelief(0.5f, 2)};
  // A leaf that one photo alone shows.
  ForSquare(30, 5, 36, 11, [&](size_t i) { pictures[0].rgb[3 * i + 1] = 220; });
  std::vector<std::vector<float>> disagreement = DisagreementOf(pictures);
  ForgiveRelief(pictures, FindConsensus(pictures, Raster()), Raster(), 4, disagreement);
  EXPECT_GT(disagreement[0][size_t{8} * kSide + 33], 0.7f);
}

TEST(Haze, IsTheContrastThatIsMissing) {
  std::vector<RasterPicture> pictures = {Wall(0.1f), Wall(0.1f), Wall(0.1f)};
  for (float& value : pictures[1].rgb) value = 55 + 0.5f * value;
  const Consensus consensus = FindConsensus(pictures, Raster());
  const auto disagreement = DisagreementOf(pictures);
  EXPECT_NEAR(Haze(pictures[0], consensus, disagreement[0]), 0, 1e-3);
  EXPECT_NEAR(Haze(pictures[1], consensus, disagreement[1]), 0.5, 1e-3);
  for (float& value : pictures[2].rgb) value *= 1.1f;
  EXPECT_EQ(Haze(pictures[2], consensus, disagreement[2]), 0);
  pictures[1].sight.assign(kSide * kSide, Sight::kNot);
  EXPECT_EQ(Haze(pictures[1], consensus, disagreement[1]), 0);
}

TEST(SelectPictures, TakesTheBestPhotoAlone) {
  const auto owner = Select({Wall(0.3f), Wall(0.2f), Wall(0.25f)});
  EXPECT_EQ(owner, std::vector<int>(kSide * kSide, 1));
}

TEST(SelectPictures, PaintsAnOccluderFromAnotherPhoto) {
  // The best photo has a car in it, known by its colour in the one case, by points in the other.
  std::vector<RasterPicture> pictures = {Wall(0.1f), Wall(0.2f), Wall(0.2f)};
  ForSquare(12, 12, 24, 24, [&](size_t i) {
    pictures[0].rgb[3 * i] = 240;
    pictures[0].rgb[3 * i + 1] = 20;
  });
  const auto by_colour = Select(pictures);
  ForSquare(12, 12, 24, 24, [&](size_t i) { EXPECT_NE(by_colour[i], 0); });
  EXPECT_EQ(by_colour[0], 0);

  pictures = {Wall(0.1f), Wall(0.2f)};
  ForSquare(12, 12, 24, 24, [&](size_t i) { pictures[0].sight[i] = Sight::kBehind; });
  const auto by_points = Select(pictures);
  ForSquare(12, 12, 24, 24, [&](size_t i) { EXPECT_EQ(by_points[i], 1); });
}

TEST(SelectPictures, PaintsWhatIsBehindPointsEverywhereAllTheSame) {
  std::vector<RasterPicture> pictures = {Wall(0.1f)};
  ForSquare(12, 12, 24, 24, [&](size_t i) { pictures[0].sight[i] = Sight::kBehind; });
  EXPECT_EQ(Select(pictures), std::vector<int>(kSide * kSide, 0));
}

TEST(SelectPictures, LeavesUnseenTexelsWithoutOwner) {
  std::vector<RasterPicture> pictures = {Wall(0.1f), Wall(0.1f)};
  for (auto& picture : pictures) {
    ForSquare(0, 0, 8, kSide, [&](size_t i) { picture.sight[i] = Sight::kNot; });
  }
  const auto owner = Select(pictures);
  EXPECT_EQ(owner[0], -1);
  EXPECT_GE(owner[20], 0);
}

TEST(SelectPictures, CrossesBetweenPhotosWhereTheyAgree) {
  // One photo sees the left, one the right; in the overlap they agree in a single column of cells.
  std::vector<RasterPicture> pictures = {Wall(0.1f), Wall(0.1f)};
  ForSquare(32, 0, kSide, kSide, [&](size_t i) { pictures[0].sight[i] = Sight::kNot; });
  ForSquare(0, 0, 8, kSide, [&](size_t i) { pictures[1].sight[i] = Sight::kNot; });
  ForSquare(8, 0, 32, kSide, [&](size_t i) {
    const auto x = static_cast<int>(i % kSide);
    if (x < 18 || x >= 22) pictures[1].rgb[3 * i + 1] += 60;
  });
  const auto owner = Select(pictures);
  for (int y = 0; y < kSide; ++y) {
    EXPECT_EQ(owner[y * kSide + 15], 0);
    EXPECT_EQ(owner[y * kSide + 24], 1);
  }
}

TEST(MergeSmallRegions, RemovesIslandsThatTheirSurroundingsCanPaint) {
  LabelProblem problem;
  problem.width = 10;
  problem.height = 10;
  problem.labels = 2;
  problem.data.assign(200, 0.1f);
  Labels labels(100, 0);
  labels[33] = labels[34] = 1;
  labels[77] = 1;
  problem.data[77 * 2] = LabelProblem::kForbidden;  // only photo 1 sees this one
  MergeSmallRegions(problem, 5, labels);
  EXPECT_EQ(labels[33], 0);
  EXPECT_EQ(labels[34], 0);
  EXPECT_EQ(labels[77], 1);
  const Labels before = labels;
  MergeSmallRegions(problem, 0, labels);
  EXPECT_EQ(labels, before);
}

}  // namespace
}  // namespace stucco
