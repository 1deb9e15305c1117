// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/summarize_photos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calib/parts/parts.h"
#include "tests/calib/made_parts.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

using testing::HasSubstr;

// Eight photos tied to each other and five in a model apart; the last of the eight has no pose.
struct PhotosCase {
  Captures captures;
  std::vector<int> capture_of_photo;
  Scene scene;
  SceneParts parts;
  std::map<int, std::string> unregistered = {{7, "it overlaps with no other photo"}};
  PriorResiduals priors;
  SceneSigmas sigmas;
  std::vector<PoseRecord> records;
  RecordErrors errors;

  std::vector<int> off_together;
  std::vector<int> ambiguous;

  SummaryInput Input() const {
    return {captures, capture_of_photo, scene,  unregistered, priors,   {},
            nullptr,  sigmas,           &parts, off_together, ambiguous};
  }
  std::vector<CalibratedPhoto> Photos() const {
    return SummarizePhotos(Input(), ToReconstruction(scene, PhotoIds(Input())));
  }
};

PhotosCase MakePhotosCase() {
  PhotosCase c;
  const Scene whole =
      Joined(MakeScene({.num_photos = 8, .num_points = 350, .noise_px = 0.4}),
             MakeScene({.num_photos = 5, .num_points = 350, .noise_px = 0.4}), {100, 0, 0});
  c.scene = whole;
  c.records = MakeRecords(whole, {.position_sigma_m = 0.5});
  c.errors = MeasureRecordErrors(c.records, whole);
  TakePoses({7, 8, 9, 10, 11, 12}, c.scene);
  ScenePart& part = c.parts.others.emplace_back();
  part.scene = SceneOf(whole, {8, 9, 10, 11, 12});
  part.sigmas = EstimateSigmas({}, part.scene);
  part.model = 1;
  part.why = "nothing says where they are";
  c.parts.part_of_photo = {0, 0, 0, 0, 0, 0, 0, -1, 1, 1, 1, 1, 1};
  c.sigmas = EstimateSigmas({}, c.scene);
  c.priors.distance_m.assign(13, -1);
  c.capture_of_photo.resize(13);
  std::iota(c.capture_of_photo.begin(), c.capture_of_photo.end(), 0);
  return c;
}

TEST(SummarizePhotos, HasThePhotosOfAllModelsWithTheirParts) {
  const auto photos = MakePhotosCase().Photos();
  ASSERT_EQ(photos.size(), 12u);
  for (size_t i = 0; i < photos.size(); ++i) {
    EXPECT_EQ(photos[i].part, i < 7 ? 0 : 1);
    EXPECT_EQ(photos[i].state, PhotoState::kTied) << photos[i].why;
    EXPECT_TRUE(photos[i].why.empty());
    EXPECT_GT(photos[i].position_sigma, 0);
    EXPECT_GT(photos[i].picture_sigma_px, 0);
    EXPECT_LT(photos[i].picture_sigma_px, 5);
    EXPECT_GT(photos[i].observations, 50);
    EXPECT_TRUE(photos[i].center.empty());
  }
}

TEST(SummarizePhotos, SaysWhyAPhotoIsWeak) {
  PhotosCase c = MakePhotosCase();
  c.sigmas.poses[3].position *= 7;
  c.sigmas.poses[4].position = -1;
  const auto photos = c.Photos();
  EXPECT_EQ(photos[3].state, PhotoState::kWeak);
  EXPECT_THAT(photos[3].why, HasSubstr("times less sure"));
  EXPECT_EQ(photos[4].state, PhotoState::kWeak);
  EXPECT_THAT(photos[4].why, HasSubstr("could not be computed"));
  EXPECT_EQ(photos[5].state, PhotoState::kTied);
}

TEST(SummarizePhotos, DoesNotTrustPhotosThatAreOffTheirRecordsTogether) {
  PhotosCase c = MakePhotosCase();
  c.off_together = {2, 5};
  const auto photos = c.Photos();
  for (const int i : {2, 5}) {
    EXPECT_EQ(photos[i].state, PhotoState::kWeak);
    EXPECT_THAT(photos[i].why, HasSubstr("off their records"));
  }
  EXPECT_EQ(photos[3].state, PhotoState::kTied);
}

// Photos of a part are held against those of their own part.
TEST(SummarizePhotos, APartInAnotherScaleIsNotWeak) {
  PhotosCase c = MakePhotosCase();
  for (PoseSigma& sigma : c.parts.others[0].sigmas.poses) sigma.position *= 1000;
  for (const CalibratedPhoto& photo : c.Photos()) EXPECT_EQ(photo.state, PhotoState::kTied);
}

TEST(SummarizeParts, CountsPhotosAndPoints) {
  const PhotosCase c = MakePhotosCase();
  const auto parts = SummarizeParts(c.Input());
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].model, "sparse/0");
  EXPECT_EQ(parts[0].placed_by, "photos");
  EXPECT_EQ(parts[0].photos, 7);
  EXPECT_GT(parts[0].points, 100);
  EXPECT_EQ(parts[1].model, "sparse/1");
  EXPECT_EQ(parts[1].placed_by, "nothing");
  EXPECT_EQ(parts[1].photos, 5);
  EXPECT_EQ(parts[1].position_sigma_m, -1);
  EXPECT_EQ(parts[1].why, "nothing says where they are");
}

TEST(SummarizeRecordOnly, TellsWhatCouldBeInSeveralPlaces) {
  PhotosCase c = MakePhotosCase();
  c.ambiguous = {7};
  const auto photos = SummarizeRecordOnly(c.Input(), c.records, c.errors);
  ASSERT_EQ(photos.size(), 1u);
  EXPECT_EQ(photos[0].state, PhotoState::kAmbiguous);
  EXPECT_FALSE(IsInModel(photos[0].state));
}

TEST(SummarizeRecordOnly, PlacesWhatHasNoPoseWhereItsRecordSays) {
  const PhotosCase c = MakePhotosCase();
  const auto photos = SummarizeRecordOnly(c.Input(), c.records, c.errors);
  ASSERT_EQ(photos.size(), 1u);
  const CalibratedPhoto& photo = photos[0];
  EXPECT_EQ(photo.path, c.scene.photos[7].name);
  EXPECT_EQ(photo.state, PhotoState::kRecordOnly);
  EXPECT_FALSE(IsInModel(photo.state));
  EXPECT_EQ(photo.part, -1);
  EXPECT_EQ(photo.why, "it overlaps with no other photo");
  ASSERT_EQ(photo.center.size(), 3u);
  const Eigen::Vector3d recorded = c.records[7].position->position;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(photo.center[axis], recorded[axis], 1e-6);
  ASSERT_EQ(photo.rotation.size(), 4u);
  const Eigen::Quaterniond rotation(photo.rotation[0], photo.rotation[1], photo.rotation[2],
                                    photo.rotation[3]);
  EXPECT_LT(rotation.angularDistance(*c.records[7].gimbal), 0.01);
  EXPECT_NEAR(photo.position_sigma, 0.5 * std::sqrt(3), 0.4);
  EXPECT_GT(photo.rotation_sigma_deg, 0);
}

TEST(SummarizeRecordOnly, NeedsPositionAndAngles) {
  PhotosCase c = MakePhotosCase();
  c.records[7].gimbal.reset();
  EXPECT_TRUE(SummarizeRecordOnly(c.Input(), c.records, c.errors).empty());
}

}  // namespace
}  // namespace stucco::test
