// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::LookFrom;
using test::MakeProxy;
using test::MakeWall;

class MeasuredWall : public ::testing::Test {
 protected:
  RasterView Measure(const SurveyPhoto& photo, const Proxy& proxy) const {
    const OcclusionScene scene(proxy);
    const std::vector<SurveyPhoto> photos = {photo};
    return MeasureView({photos, &scene, {}, {}}, 0, wall_, {raster_, inside_, 1}, {78, 0.02, 0.2});
  }
  RasterView Measure(const SurveyPhoto& photo) const { return Measure(photo, MakeProxy({wall_})); }
  static double Share(const RasterView& view) {
    return static_cast<double>(
               std::count_if(view.texels.begin(), view.texels.end(),
                             [](const TexelView& t) { return t.sight != Sight::kNot; })) /
           static_cast<double>(view.texels.size());
  }

  Facet wall_ = MakeWall(4, 3);
  TexelGrid raster_ = MakeGrid(wall_, Eigen::Vector3d::UnitZ(), 0.1, 1000);
  std::vector<uint16_t> inside_ = std::vector<uint16_t>(raster_.size(), 1);
};

TEST_F(MeasuredWall, SeenFrontallyHasTheExactNumbers) {
  const RasterView view = Measure(LookFrom("a", {2, -5, 1.5}, {2, 0, 1.5}, {1000, 800, 500}));
  EXPECT_DOUBLE_EQ(Share(view), 1);
  const TexelView& middle = view.texels[15 * raster_.width + 20];
  EXPECT_NEAR(middle.footprint, 0.01, 1e-4);  // 5 m / 500 px
  EXPECT_NEAR(middle.resolution, 10, 0.1);    // texels of 10 cm
  EXPECT_NEAR(middle.cos_angle, 1, 1e-3);
  EXPECT_EQ(middle.border, 0);
}

TEST_F(MeasuredWall, IsNotSeenFromBehindOrAtGrazingAngles) {
  EXPECT_EQ(Share(Measure(LookFrom("a", {2, 5, 1.5}, {2, 0, 1.5}, {1000, 800, 500}))), 0);
  EXPECT_EQ(Share(Measure(LookFrom("a", {-20, -1, 1.5}, {2, 0, 1.5}, {1000, 800, 500}))), 0);
}

TEST_F(MeasuredWall, IsSeenOnlyInsideThePicture) {
  const double share = Share(Measure(LookFrom("a", {4, -5, 1.5}, {4, 0, 1.5}, {400, 800, 500})));
  EXPECT_NEAR(share, 0.5, 0.03);
}

TEST_F(MeasuredWall, IsHiddenByAnotherFacet) {
  Facet screen = MakeWall(2, 3);
  for (auto& vertex : screen.outer) vertex.y() -= 0.5;
  const RasterView view = Measure(LookFrom("a", {2, -50, 1.5}, {2, 0, 1.5}, {1000, 800, 5000}),
                                  MakeProxy({wall_, screen}));
  EXPECT_NEAR(Share(view), 0.5, 0.03);
  EXPECT_EQ(view.texels[15 * raster_.width + 5].sight, Sight::kNot);
  EXPECT_EQ(view.texels[15 * raster_.width + 35].sight, Sight::kFree);
}

TEST_F(MeasuredWall, CountsAsBehindWherePointsStandInFront) {
  SightedPoints points;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) points.positions.push_back({1.7 + 0.01 * i, -1, 1.2 + 0.01 * j});
  }
  const std::vector<SurveyPhoto> photos = {
      LookFrom("a", {2, -5, 1.5}, {2, 0, 1.5}, {1000, 800, 500})};
  const std::vector<NearestPoints> nearest = {SplatNearest(photos[0], points, 200)};
  const OcclusionScene scene(MakeProxy({wall_}));
  const RasterView view = MeasureView({photos, &scene, nearest, points.positions}, 0, wall_,
                                      {raster_, inside_, 1}, {78, 0.02, 0.2});
  EXPECT_EQ(view.texels[15 * raster_.width + 20].sight, Sight::kBehind);
  EXPECT_EQ(view.texels[15 * raster_.width + 35].sight, Sight::kFree);
}

TEST(ViewCost, PrefersFrontalFineSharpViewsInsideThePicture) {
  TexelView good;
  good.sight = Sight::kFree;
  good.resolution = 1;
  good.cos_angle = 1;
  EXPECT_NEAR(ViewCost(good, 0.01, 0.01, 1), 0, 1e-6);
  TexelView worse = good;
  worse.cos_angle = 0.5f;
  EXPECT_GT(ViewCost(worse, 0.01, 0.01, 1), 0.1);
  worse = good;
  worse.resolution = 0.5f;
  EXPECT_GT(ViewCost(worse, 0.01, 0.01, 1), 0.15);
  worse = good;
  worse.border = 1;
  EXPECT_GT(ViewCost(worse, 0.01, 0.01, 1), 0.05);
  EXPECT_GT(ViewCost(good, 0.01, 0.01, 0.5), 0.05);
  // A coarser raster has more photo pixels a texel; the cost is that of the picture's texels.
  TexelView coarse = good;
  coarse.resolution = 4;
  EXPECT_NEAR(ViewCost(coarse, 0.04, 0.01, 1), 0, 1e-6);
}

// Three photos on a row of 10 texels: one all over but poor, one good on the left, one good on the
// right and sharing the left's place.
TEST(RankCandidates, KeepsCoverageWithFewPhotos) {
  const std::vector<uint16_t> inside(10, 1);
  std::vector<RasterView> views(4);
  std::vector<std::vector<float>> costs(4, std::vector<float>(10, 0));
  for (int v = 0; v < 4; ++v) {
    views[v].photo = 10 + v;
    views[v].texels.resize(10);
    for (int i = 0; i < 10; ++i) {
      const bool sees = v == 0 || (v == 1 && i < 6) || (v == 2 && i < 5) || (v == 3 && i == 9);
      views[v].texels[i].sight = sees ? Sight::kFree : Sight::kNot;
      costs[v][i] = v == 0 ? 0.6f : 0.1f;
    }
  }
  const auto two = RankCandidates(views, inside, costs, 2);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].photo, 11);  // 6 x 0.9 beats 10 x 0.4
  EXPECT_EQ(two[1].photo, 10);  // not 12, which adds nothing to 11
  EXPECT_NEAR(two[1].seen, 1, 1e-9);
  EXPECT_EQ(RankCandidates(views, inside, costs, 10).size(), 4u);
  EXPECT_TRUE(RankCandidates({}, inside, {}, 10).empty());
}

// Twenty photos that each show a twentieth, and twenty worse ones of the same places.
TEST(RankCandidates, TakesMoreThanWishedWhereNobodyElseSees) {
  const std::vector<uint16_t> inside(200, 1);
  std::vector<RasterView> views(40);
  std::vector<std::vector<float>> costs;
  for (int v = 0; v < 40; ++v) {
    views[v].photo = v;
    views[v].texels.resize(200);
    for (int i = 0; i < 10; ++i) views[v].texels[10 * (v % 20) + i].sight = Sight::kFree;
    costs.push_back(std::vector<float>(200, v < 20 ? 0.2f : 0.4f));
  }
  const auto ranked = RankCandidates(views, inside, costs, 16);
  ASSERT_EQ(ranked.size(), 20u);
  for (const Candidate& candidate : ranked) EXPECT_LT(candidate.photo, 20);
  EXPECT_EQ(RankCandidates(views, inside, costs, 24).size(), 24u);
}

TEST(RankCandidates, NeverTakesMoreThanLabelsCanSay) {
  const std::vector<uint16_t> inside(300, 1);
  std::vector<RasterView> views(300);
  for (int v = 0; v < 300; ++v) {
    views[v].photo = v;
    views[v].texels.resize(300);
    views[v].texels[v].sight = Sight::kFree;
  }
  const std::vector<std::vector<float>> costs(300, std::vector<float>(300, 0.1f));
  EXPECT_EQ(RankCandidates(views, inside, costs, 16).size(), 254u);
}

TEST(FinestTexel, IsTheLowQuartileOfTheBestViews) {
  std::vector<RasterView> views(2);
  for (auto& view : views) view.texels.resize(100);
  for (int i = 0; i < 100; ++i) {
    views[0].texels[i].sight = Sight::kFree;
    views[0].texels[i].resolution = 2;  // 0.1 / 2 = 0.05
    if (i < 60) views[1].texels[i].sight = Sight::kFree;
    views[1].texels[i].resolution = 8.1f;
  }
  EXPECT_NEAR(FinestTexel(views, 0.1), 0.012, 1e-9);
  EXPECT_EQ(FinestTexel({}, 0.1), 0);
}

}  // namespace
}  // namespace stucco
