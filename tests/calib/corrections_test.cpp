// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/corrections.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// A photo and points that it shows.
class Corrections : public testing::Test {
 protected:
  Corrections() {
    scene_.cameras.push_back({SiteCamera(), SiteCamera(), 0});
    scene_.photos.emplace_back();
    Random random(1);
    while (sightings_.size() < 80) {
      const Vector3d point(random.Uniform(-20, 20), random.Uniform(-15, 15), random.Uniform(0, 6));
      const auto pixel = SiteCamera().Project(truth_ * point);
      if (!pixel || !SiteCamera().Contains(*pixel)) continue;
      scene_.photos[0].keypoints.push_back(*pixel);
      sightings_.push_back({static_cast<int>(sightings_.size()), point});
    }
  }

  Scene scene_;
  Pose truth_ = SitePose({1, 2, 30}, 20, -80);
  std::vector<RecordSighting> sightings_;
};

TEST_F(Corrections, FindsTheMotionFromTheRecordToTheTruth) {
  const Pose recorded = SitePose({12, -7, 33}, 95, -60);
  const auto found = ProposeCorrection(scene_, 0, recorded, sightings_);
  ASSERT_TRUE(found);
  EXPECT_LT((found->recorded - Vector3d(12, -7, 33)).norm(), 1e-9);
  EXPECT_LT((found->Moved() - Vector3d(1, 2, 30)).norm(), 1e-3);
  const Pose corrected = recorded * found->moved_from_recorded.Inverse();
  EXPECT_LT(corrected.rotation.angularDistance(truth_.rotation), 1e-4);
}

TEST_F(Corrections, ToleratesPointsThatAreOffByAMetre) {
  Random random(2);
  for (RecordSighting& sighting : sightings_) sighting.point += random.Vector(1);
  const auto found = ProposeCorrection(scene_, 0, truth_, sightings_);
  ASSERT_TRUE(found);
  EXPECT_LT((found->Moved() - Vector3d(1, 2, 30)).norm(), 2);
}

TEST_F(Corrections, NothingWherePointsAgreeOnNoPose) {
  Random random(3);
  for (RecordSighting& sighting : sightings_) sighting.point = random.Vector(20);
  EXPECT_FALSE(ProposeCorrection(scene_, 0, truth_, sightings_));
  sightings_.resize(5);
  EXPECT_FALSE(ProposeCorrection(scene_, 0, truth_, sightings_));
  EXPECT_FALSE(ProposeCorrection(scene_, 0, truth_, {}));
}

TEST(LargestAgreement, CountsThoseThatSayTheSame) {
  const auto shift = [](double x, double turn_rad) {
    Correction correction;
    correction.moved_from_recorded = {
        Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ())), {x, 0, 0}};
    return correction;
  };
  const std::vector<Correction> corrections = {shift(20, 0), shift(3, 0.1), shift(0, 0),
                                               shift(-4, 0), shift(0, 1.5)};
  const Agreement found = LargestAgreement(corrections);
  EXPECT_EQ(found.center, 2);
  EXPECT_EQ(found.count, 3);
  EXPECT_EQ(LargestAgreement({}).count, 0);
}

TEST(LargestAgreement, ATurnThatMovesFarPlacesDifferentlyIsNotTheSame) {
  Correction a;
  Correction b;
  b.moved_from_recorded.rotation = Eigen::AngleAxisd(0.15, Vector3d::UnitZ());
  EXPECT_EQ(LargestAgreement(std::vector{a, b}).count, 2);
  b.recorded = {100, 0, 0};
  EXPECT_EQ(LargestAgreement(std::vector{a, b}).count, 1);
}

}  // namespace
}  // namespace stucco::test
