// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/take_apart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/parts/parts.h"
#include "tests/calib/made_parts.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

using testing::HasSubstr;

// A survey that was calibrated, of which the photos from `second_` on share nothing with the
// others.
class TakeApartTest : public testing::Test {
 protected:
  TakeApartTest() {
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
  }

  void Survey(Scene truth, int second) {
    truth_ = std::move(truth);
    second_ = second;
    scene_ = truth_;
    scene_.cameras[0].focal_sigma_ratio = 0.01;
    captured_.resize(truth_.photos.size());
    for (size_t i = 0; i < captured_.size(); ++i) captured_[i].path = truth_.photos[i].name;
    records_.assign(truth_.photos.size(), {});
  }

  void Halves(double distance_m, int num_second = 8) {
    Survey(
        Joined(MakeScene({.num_photos = 9, .num_points = 350, .noise_px = 0.4}),
               MakeScene({.num_photos = num_second, .num_points = 350, .noise_px = 0.4, .seed = 2}),
               {distance_m, 0, 0}),
        9);
  }

  void Record(double sigma_m) {
    records_ = MakeRecords(truth_, {.position_sigma_m = sigma_m});
    for (PoseRecord& record : records_) {
      record.position->sigma_horizontal_m = record.position->sigma_vertical_m = sigma_m;
    }
    errors_ = MeasureRecordErrors(records_, truth_);
    ApplyRecords(records_, *errors_, scene_);
  }

  // Only the first half is in the scene.
  void WithoutSecond() {
    std::vector<int> photos;
    for (int i = second_; i < static_cast<int>(scene_.photos.size()); ++i) photos.push_back(i);
    TakePoses(photos, scene_);
  }

  SceneParts Take() {
    std::vector<const CapturedPhoto*> captures;
    for (const CapturedPhoto& photo : captured_) captures.push_back(&photo);
    const auto pairs = Verified(truth_, MatchesOf(truth_, 0, 1));
    sigmas_.poses.assign(scene_.photos.size(), {});
    return TakeApart(
        {mapper_, pairs, captures, plan_, records_, errors_ ? &*errors_ : nullptr, context_},
        sigmas_, scene_);
  }

  Scene truth_;
  Scene scene_;
  int second_ = 0;
  std::vector<CapturedPhoto> captured_;
  std::vector<PoseRecord> records_;
  std::optional<RecordErrors> errors_;
  std::optional<Plan> plan_;
  MapperOptions mapper_;
  StageContext context_;
  SceneSigmas sigmas_;
};

TEST_F(TakeApartTest, ASurveyInOnePieceStaysAsItIs) {
  Survey(MakeScene({.num_photos = 8, .num_points = 350, .noise_px = 0.4}), 8);
  const SceneParts parts = Take();
  EXPECT_TRUE(parts.others.empty());
  EXPECT_TRUE(parts.taken.empty());
  EXPECT_EQ(parts.part_of_photo, std::vector<int>(8, 0));
  EXPECT_EQ(NumRegistered(scene_), 8);
}

TEST_F(TakeApartTest, HousesFarApartStayInOneModelByTheirRecords) {
  Halves(200);
  Record(0.5);
  const Scene before = scene_;
  const SceneParts parts = Take();
  ASSERT_EQ(parts.others.size(), 1u);
  const ScenePart& part = parts.others[0];
  EXPECT_EQ(part.model, 0);
  ASSERT_TRUE(part.place);
  EXPECT_NEAR(part.place->position_sigma_m, 0.5 * std::sqrt(3.0 / 8), 0.15);
  EXPECT_EQ(part.place->shared_surface, 0);
  EXPECT_EQ(NumRegistered(scene_), 17);
  EXPECT_TRUE(IsConsistent(scene_));
  for (int i = 0; i < 17; ++i) {
    EXPECT_EQ(parts.part_of_photo[i], i < 9 ? 0 : 1);
    EXPECT_EQ(NumUsedObservations(scene_, i), NumUsedObservations(before, i)) << i;
    // Within its part each pose is good to centimetres, wherever the part is.
    EXPECT_GT(sigmas_.poses[i].position, 0);
    EXPECT_LT(sigmas_.poses[i].position, 0.1);
  }
  EXPECT_THAT(part.why, HasSubstr("8 photos"));
  EXPECT_THAT(part.why, HasSubstr("would join them"));
  EXPECT_TRUE(WhyApart(parts).empty());
}

TEST_F(TakeApartTest, TheSameWallsWouldComeOutDoubleAndAreApart) {
  Survey(Unmatched(MakeScene({.num_photos = 17, .num_points = 600, .noise_px = 0.4}), 9), 9);
  Record(0.5);
  const SceneParts parts = Take();
  ASSERT_EQ(parts.others.size(), 1u);
  const ScenePart& part = parts.others[0];
  EXPECT_EQ(part.model, 1);
  ASSERT_TRUE(part.place);
  EXPECT_GT(part.place->shared_surface, 0.5);
  EXPECT_EQ(NumRegistered(scene_), 9);
  EXPECT_EQ(NumRegistered(part.scene), 8);
  EXPECT_TRUE(IsConsistent(scene_));
  EXPECT_THAT(part.why, HasSubstr("calib/sparse/1"));
  const auto why = WhyApart(parts);
  EXPECT_EQ(why.size(), 8u);
  EXPECT_THAT(why.at(9), HasSubstr("calib/sparse/1"));
}

TEST_F(TakeApartTest, WhatRecordsPlaceBetterThanAPixelIsOne) {
  Survey(Unmatched(MakeScene({.num_photos = 17, .num_points = 600, .noise_px = 0.4}), 9), 9);
  records_ = MakeRecords(truth_, {.position_sigma_m = 0.01, .attitude_sigma_rad = 0.0005});
  for (PoseRecord& record : records_) {
    record.position->sigma_horizontal_m = record.position->sigma_vertical_m = 0.01;
  }
  errors_ = MeasureRecordErrors(records_, truth_);
  // What measuring eight photos of two flights can tell is less than what they were made with.
  for (FlightErrors& flight : errors_->flights) {
    flight.sigma_horizontal_m = flight.sigma_vertical_m = 0.01;
  }
  errors_->sigma_attitude_rad = 0.0005;
  ApplyRecords(records_, *errors_, scene_);
  const SceneParts parts = Take();
  ASSERT_EQ(parts.others.size(), 1u);
  EXPECT_EQ(parts.others[0].model, 0);
  EXPECT_LT(parts.others[0].place->surface_sigma_px, 1);
  EXPECT_EQ(NumRegistered(scene_), 17);
}

TEST_F(TakeApartTest, WithoutRecordsAHalfIsAModelOfItsOwn) {
  Halves(200);
  WithoutSecond();
  const SceneParts parts = Take();
  ASSERT_EQ(parts.others.size(), 1u);
  const ScenePart& part = parts.others[0];
  EXPECT_EQ(part.model, 1);
  EXPECT_FALSE(part.place);
  EXPECT_EQ(NumRegistered(part.scene), 8);
  EXPECT_LT(ComparePoses(part.scene, truth_).position_m, 0.05);
  EXPECT_EQ(part.scene.cameras[0].intrinsics.params, scene_.cameras[0].intrinsics.params);
  EXPECT_EQ(NumRegistered(scene_), 9);
  EXPECT_THAT(part.why, HasSubstr("frame and scale of its own"));
  for (int i = 9; i < 17; ++i) EXPECT_EQ(parts.part_of_photo[i], 1);
}

TEST_F(TakeApartTest, PositionsPlaceAHalfThatGrewByItself) {
  Halves(200);
  Record(0.1);
  errors_.reset();  // angles and positions took no part
  for (size_t i = 0; i < records_.size(); ++i) scene_.photos[i].prior = records_[i].position;
  WithoutSecond();
  const SceneParts parts = Take();
  ASSERT_EQ(parts.others.size(), 1u);
  EXPECT_EQ(parts.others[0].model, 0);
  ASSERT_EQ(NumRegistered(scene_), 17);
  double worst = 0;
  for (int i = 9; i < 17; ++i) {
    worst =
        std::max(worst, (scene_.photos[i].pose->Center() - truth_.photos[i].pose->Center()).norm());
  }
  EXPECT_LT(worst, 0.4);
  EXPECT_GT(parts.others[0].place->position_sigma_m, 0.02);
}

TEST_F(TakeApartTest, ThreePhotosAreNoPart) {
  Halves(200, 3);
  Record(0.5);
  const SceneParts parts = Take();
  EXPECT_TRUE(parts.others.empty());
  EXPECT_EQ(NumRegistered(scene_), 9);
  EXPECT_EQ(parts.taken.size(), 3u);
  EXPECT_THAT(parts.taken.at(10), HasSubstr("only 3 photos hang together"));
  EXPECT_EQ(parts.part_of_photo[10], -1);
}

TEST_F(TakeApartTest, ThreePhotosWithoutRecordsAreNoneEither) {
  Halves(200, 3);
  WithoutSecond();
  const SceneParts parts = Take();
  EXPECT_TRUE(parts.others.empty());
  EXPECT_EQ(NumRegistered(scene_), 9);
}

// Its points move by more in its picture than matches may be off.
TEST_F(TakeApartTest, APhotoThatCouldBeElsewhereLosesItsPose) {
  Survey(MakeScene({.num_photos = 9, .num_points = 350, .noise_px = 0.4}), 9);
  sigmas_ = EstimateSigmas({}, scene_);
  sigmas_.poses[8].picture_px =
      std::max(mapper_.max_error_sigmas, 5 * sigmas_.poses[4].picture_px) + 1;
  const std::vector<VerifiedPair> no_pairs;
  std::vector<const CapturedPhoto*> captures;
  for (const CapturedPhoto& photo : captured_) captures.push_back(&photo);
  const SceneParts parts =
      TakeApart({mapper_, no_pairs, captures, plan_, records_, nullptr, context_}, sigmas_, scene_);
  EXPECT_EQ(NumRegistered(scene_), 8);
  EXPECT_FALSE(scene_.photos[8].pose);
  EXPECT_THAT(parts.taken.at(8), HasSubstr("does not hold it"));
  EXPECT_EQ(parts.part_of_photo[8], -1);
}

}  // namespace
}  // namespace stucco::test
