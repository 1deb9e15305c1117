// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::LookFrom;
using test::MakeWall;

SurveyPhoto KnownLens(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  SurveyPhoto photo = LookFrom("a", from, to, {640, 480, 600});
  photo.safe_radius_squared = SafeRadiusSquared(photo.camera);
  return photo;
}

TEST(PhotosThatMaySee, LeavesOutWhatCannot) {
  const Facet wall = MakeWall(4, 3);
  std::vector<SurveyPhoto> photos = {
      KnownLens({2, -5, 1.5}, {2, 0, 1.5}),                        // in front
      KnownLens({2, 5, 1.5}, {2, 0, 1.5}),                         // behind
      KnownLens({2, -5, 1.5}, {2, -9, 1.5}),                       // looks away
      KnownLens({-60, -5, 1.5}, {2, 0, 1.5}),                      // too oblique
      LookFrom("b", {2, -5, 1.5}, {2, -9, 1.5}, {640, 480, 600}),  // a lens that nobody knows
      KnownLens({7.5, -5, 1.5}, {7.5, 0, 1.5})};                   // the sphere at its very border
  EXPECT_EQ(PhotosThatMaySee(wall, photos, 78), (std::vector<int>{0, 4, 5}));
  EXPECT_EQ(PhotosThatMaySee(wall, photos, 89), (std::vector<int>{0, 3, 4, 5}));
}

TEST(PhotosThatMaySee, KeepsEveryPhotoThatSeesSomething) {
  const Facet wall = MakeWall(4, 3);
  const OcclusionScene nothing(test::MakeProxy({wall}));
  const TexelGrid grid = MakeGrid(wall, Eigen::Vector3d::UnitZ(), 0.25, 100);
  const FacetRaster raster{grid, std::vector<uint16_t>(grid.size(), 1), 1};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-12, 12);
  std::vector<SurveyPhoto> photos;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d from(place(random), place(random), place(random));
    const Eigen::Vector3d to(place(random) / 3, place(random) / 6, place(random) / 3);
    photos.push_back(KnownLens(from, to));
  }
  const std::vector<int> possible = PhotosThatMaySee(wall, photos, 78);
  EXPECT_LT(possible.size(), 300U);
  int seeing = 0;
  for (int p = 0; p < 400; ++p) {
    const RasterView view =
        MeasureView({photos, &nothing, {}, {}}, p, wall, raster, {78, 0.02, 0.2});
    const bool sees = std::any_of(view.texels.begin(), view.texels.end(),
                                  [](const TexelView& t) { return t.sight != Sight::kNot; });
    seeing += sees;
    EXPECT_TRUE(!sees || std::binary_search(possible.begin(), possible.end(), p)) << p;
  }
  EXPECT_GT(seeing, 20);
}

TEST(LookRaster, HasTexelsOnThinAndOnLongFacets) {
  const std::vector<SurveyPhoto> photos = {KnownLens({20, -8, 1}, {20, 0, 1})};
  PaintScene scene;
  scene.sights.photos = photos;
  const std::vector<int> all = {0};
  const auto texels_on = [&](const Facet& facet) {
    const std::vector<uint8_t> mask = RasterizeFacet(facet, LookRaster(facet, scene, all));
    return std::count(mask.begin(), mask.end(), 1);
  };
  EXPECT_GT(texels_on(MakeWall(4, 3)), 900);
  EXPECT_LT(texels_on(MakeWall(4, 3)), 1200);
  EXPECT_GT(texels_on(MakeWall(300, 1)), 900);
  // The photo shows 6.4 m of the height: at least four texels.
  const TexelGrid large = LookRaster(MakeWall(300, 100), scene, all);
  EXPECT_LE(large.texel, 1.6);
  EXPECT_LE(large.size(), 20000U);
}

TEST(LookRaster, IsBoundedWithManyPhotos) {
  const std::vector<SurveyPhoto> photos(1, KnownLens({20, -1, 1}, {20, 0, 1}));
  PaintScene scene;
  scene.sights.photos = photos;
  const std::vector<int> all(100000, 0);
  EXPECT_LT(LookRaster(MakeWall(300, 100), scene, all).size(), 1200U);
}

TEST(LimitsFor, GrowWithTheTypicalDistance) {
  Facet wall = MakeWall(4, 3);
  const std::vector<SurveyPhoto> photos = {KnownLens({2, -10, 1.5}, {2, 0, 1.5}),
                                           KnownLens({2, -10, 1.5}, {2, -50, 1.5}),
                                           KnownLens({2, -90, 1.5}, {2, -99, 1.5})};
  ViewLimits limits = LimitsFor(wall, photos, 70);
  EXPECT_EQ(limits.max_angle_deg, 70);
  EXPECT_NEAR(limits.tolerance, 0.03, 1e-9);  // of the photo that shows it, 10 m away
  EXPECT_NEAR(limits.clearance, 0.2, 1e-9);
  wall.rms = 0.1;
  limits = LimitsFor(wall, photos, 70);
  EXPECT_NEAR(limits.tolerance, 0.2, 1e-9);
  EXPECT_NEAR(limits.clearance, 0.4, 1e-9);
}

}  // namespace
}  // namespace stucco
