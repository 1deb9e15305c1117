// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/paint.h"

#include <gtest/gtest.h>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

constexpr uint64_t kMegabyte = 1'000'000;

uint64_t Bytes(const Facet& facet, int candidates, int photo_side_px) {
  const std::vector<SurveyPhoto> photos = {
      test::LookFrom("a", {2, -5, 1}, {2, 0, 1}, {photo_side_px, photo_side_px, 500})};
  PaintScene scene;
  scene.sights.photos = photos;
  FacetLook look;
  look.texel = 0.01;
  look.candidates.assign(candidates, {0, 1.0 / std::max(1, candidates), 1});
  return PaintingBytes(facet, look, scene, {});
}

TEST(PaintingBytes, CountsThePictureThePhotoAndTheCandidates) {
  const Facet wall = test::MakeWall(4, 3);
  EXPECT_EQ(Bytes(wall, 0, 100), 0U);
  EXPECT_LT(Bytes(wall, 2, 100), 20 * kMegabyte);
  EXPECT_GT(Bytes(wall, 2, 5000), 100 * kMegabyte);  // 25 megapixels and their halvings
  EXPECT_GT(Bytes(wall, 100, 100), Bytes(wall, 2, 100));
  EXPECT_GT(Bytes(test::MakeWall(40, 30), 2, 100), 24 * 12 * kMegabyte);
}

// The more photos, the coarser the rasters of a large facet: what they hold stays bounded.
TEST(PaintingBytes, IsBounded) {
  const Facet wall = test::MakeWall(80, 80);
  const uint64_t picture = 24 * 64 * kMegabyte;
  EXPECT_LT(Bytes(wall, 254, 5000), picture + 1300 * kMegabyte);
}

}  // namespace
}  // namespace stucco
