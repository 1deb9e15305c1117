// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/blocks_exchange.h"
#include "exchange/brown_lens.h"
#include "survey/files.h"
#include "tests/exchange/made_model.h"
#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

constexpr double kRelative = 1e-9;

void ExpectSameCamera(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  // The reader may know a smaller model that is the same lens.
  const BrownLens lens_a = LensWithNames(a);
  const BrownLens lens_b = LensWithNames(b);
  const auto same = [](double x, double y) {
    EXPECT_NEAR(x, y, kRelative * std::max(std::abs(x), 1e-3));
  };
  same(lens_a.fx, lens_b.fx);
  same(lens_a.fy, lens_b.fy);
  same(lens_a.cx, lens_b.cx);
  same(lens_a.cy, lens_b.cy);
  same(lens_a.k1, lens_b.k1);
  same(lens_a.k2, lens_b.k2);
  same(lens_a.k3, lens_b.k3);
  same(lens_a.p1, lens_b.p1);
  same(lens_a.p2, lens_b.p2);
}

// `shift` is between the origins of the frames.
void ExpectSame(const Reconstruction& a, const Reconstruction& b, const Eigen::Vector3d& shift) {
  ASSERT_EQ(a.photos.size(), b.photos.size());
  for (const auto& [id, photo] : a.photos) {
    const RegisteredImage& other = b.photos.at(id);
    EXPECT_EQ(photo.name, other.name);
    ExpectSameCamera(a.cameras.at(photo.camera), b.cameras.at(other.camera));
    EXPECT_LT(photo.cam_from_world.rotation.angularDistance(other.cam_from_world.rotation),
              kRelative);
    const Eigen::Vector3d centre = photo.cam_from_world.Center() + shift;
    EXPECT_LT((centre - other.cam_from_world.Center()).norm(), kRelative * centre.norm());
    ASSERT_EQ(photo.observations.size(), other.observations.size());
    for (size_t i = 0; i < photo.observations.size(); ++i) {
      EXPECT_LT((photo.observations[i].pixel - other.observations[i].pixel).norm(),
                kRelative * 100);
    }
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (const auto& [id, point] : a.points) {
    const TrackPoint& other = b.points.at(id);
    EXPECT_LT((point.position + shift - other.position).norm(), kRelative * point.position.norm());
    EXPECT_EQ(point.rgb, other.rgb);
    EXPECT_EQ(point.track, other.track);
  }
}

TEST(RoundTrip, BlocksExchangeGivesTheSameModelInTheSamePlace) {
  const RowOfPhotos photos;
  const Reconstruction model = MadeModel();
  const Georef place = MadePlace();
  const auto folder = photos.root / "photos";
  WriteBlocksExchange({model, place, folder}, photos.root / "block.xml");
  const ExchangedModel read = ReadBlocksExchange(photos.root / "block.xml", photos.Index());
  ASSERT_TRUE(read.georef);
  EXPECT_EQ(read.georef->origin_latitude_deg, place.origin_latitude_deg);
  EXPECT_EQ(read.georef->origin_longitude_deg, place.origin_longitude_deg);
  EXPECT_EQ(read.georef->origin_height_m, 0);
  ExpectSame(model, read.model, {0, 0, place.origin_height_m});
  EXPECT_EQ(FindProblem(read.model), std::nullopt);
}

TEST(RoundTrip, BlocksExchangeOfAFrameOfItsOwnHasNoCoordinateSystem) {
  const RowOfPhotos photos;
  const Reconstruction model = MadeModel();
  const Georef nowhere;
  const auto folder = photos.root / "photos";
  WriteBlocksExchange({model, nowhere, folder}, photos.root / "block.xml");
  EXPECT_THAT(ReadFile(photos.root / "block.xml"),
              testing::AllOf(testing::Not(testing::HasSubstr("SRS")),
                             testing::HasSubstr("<ImagePath>photos/sub/c.jpg</ImagePath>")));
  const ExchangedModel read = ReadBlocksExchange(photos.root / "block.xml", photos.Index());
  EXPECT_FALSE(read.georef);
  ExpectSame(model, read.model, Eigen::Vector3d::Zero());
}

TEST(RoundTrip, PathsAreFromTheFolderOfTheFile) {
  const Reconstruction model = MadeModel();
  const Georef nowhere;
  const std::filesystem::path photos = "/survey/photos";
  const ModelToWrite what{model, nowhere, photos};
  const RegisteredImage& photo = model.photos.at(PhotoId{3});
  EXPECT_EQ(PathFrom("/survey", what, photo), "photos/sub/c.jpg");
  EXPECT_EQ(PathFrom("/survey/out/", what, photo), "../photos/sub/c.jpg");
  EXPECT_EQ(PathFrom("", what, photo), PathFrom(std::filesystem::current_path(), what, photo));
}

TEST(RoundTrip, ALensThatTheFormatDoesNotKnowIsRefused) {
  const RowOfPhotos photos;
  Reconstruction model = MadeModel();
  model.cameras.at(CameraId{1}).params.back() = 0.1;
  const Georef nowhere;
  const auto folder = photos.root / "photos";
  const Error error = RefusalOf([&] {
    WriteBlocksExchange({model, nowhere, folder}, photos.root / "block.xml");
  });
  EXPECT_THAT(error.what(), testing::HasSubstr("camera 1 (FULL_OPENCV) has k4, k5 or k6"));
  EXPECT_FALSE(std::filesystem::exists(photos.root / "block.xml"));
}

}  // namespace
}  // namespace stucco
