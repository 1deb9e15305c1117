// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/contradictions.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// Photos that look down at the ground between the houses, and matches of points on it.
class Contradictions : public testing::Test {
 protected:
  Contradictions() {
    scene_.cameras.push_back({SiteCamera(), SiteCamera(), 0});
    for (int i = 0; i < 4; ++i) Take({-10.0 + 6 * i, -20, 25}, Vector3d::Zero());
  }

  // A photo at a place that its record misses by `off`.
  int Take(const Vector3d& place, const Vector3d& off) {
    truth_.push_back(SitePose(place, 0, -90));
    recorded_.emplace_back(SitePose(place + off, 0, -90));
    scene_.photos.emplace_back();
    return static_cast<int>(truth_.size()) - 1;
  }

  // `count` points that both photos show; in the second one everything is seen `repeat` further on.
  void Match(int first, int second, int count, const Vector3d& repeat) {
    VerifiedPair pair;
    pair.pair = {first, second, {}};
    while (static_cast<int>(pair.pair.matches.size()) < count) {
      const Vector3d point(random_.Uniform(-40, 40), random_.Uniform(-35, -5), 0);
      const auto a = SiteCamera().Project(truth_[first] * point);
      const auto b = SiteCamera().Project(truth_[second] * (point + repeat));
      if (!a || !b || !SiteCamera().Contains(*a) || !SiteCamera().Contains(*b)) continue;
      pair.pair.matches.push_back({Add(first, *a), Add(second, *b)});
    }
    pairs_.push_back(std::move(pair));
  }

  // What is left, and how many went.
  int Drop() {
    const Camera camera = SiteCamera();
    const Plan plan = TwoHouses();
    const ExpectedViews views =
        ExpectViews({plan, recorded_, std::vector<const Camera*>(recorded_.size(), &camera)}, {});
    return DropContradictions(views, scene_, pairs_);
  }

  Scene scene_;
  std::vector<Pose> truth_;
  std::vector<std::optional<Pose>> recorded_;
  std::vector<VerifiedPair> pairs_;

 private:
  int Add(int photo, const Eigen::Vector2d& pixel) {
    scene_.photos[photo].keypoints.push_back(pixel);
    return static_cast<int>(scene_.photos[photo].keypoints.size()) - 1;
  }
  Random random_{1};
};

TEST_F(Contradictions, LetsPairsStayWhoseRecordsAreMetresAndDegreesOff) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  recorded_[0] = SitePose({-8.5, -21, 24}, 3, -88);
  recorded_[2] = SitePose({2, -18.5, 25}, -2, -91);
  EXPECT_EQ(Drop(), 0);
  EXPECT_EQ(pairs_.size(), 2u);
}

TEST_F(Contradictions, TakesOutWhatMatchesSomewhereElse) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  Match(0, 3, 80, {18, 0, 0});  // a pattern of the ground that repeats after 18 m
  EXPECT_EQ(Drop(), 1);
  ASSERT_EQ(pairs_.size(), 2u);
  EXPECT_EQ(pairs_[0].pair.second, 1);
  EXPECT_EQ(pairs_[1].pair.first, 2);
}

TEST_F(Contradictions, BelievesAPhotoMoreThanARecordThatFitsNoneOfItsPairs) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  for (int i = 0; i < 3; ++i) Match(i, 3, 60, Vector3d::Zero());
  recorded_[3] = SitePose({60, 40, 25}, 120, -90);
  EXPECT_EQ(Drop(), 0);
  EXPECT_EQ(pairs_.size(), 5u);
}

TEST_F(Contradictions, BelievesARecordMoreThanTwoPairs) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  Match(1, 3, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  recorded_[3] = SitePose({60, 40, 25}, 120, -90);
  EXPECT_EQ(Drop(), 2);
}

TEST_F(Contradictions, CorrectsRecordsFromPhotosWhoseRecordsWereCorrected) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(0, 2, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  for (int i = 0; i < 3; ++i) Match(i, 3, 60, Vector3d::Zero());
  recorded_[3] = SitePose({60, 40, 25}, 120, -90);
  const int next = Take({12, -16, 25}, Vector3d::Zero());
  for (const int i : {1, 2, 3}) Match(i, next, 60, Vector3d::Zero());
  recorded_[next] = SitePose({-30, 30, 25}, -70, -90);
  EXPECT_EQ(Drop(), 0);
  EXPECT_EQ(pairs_.size(), 9u);
}

TEST_F(Contradictions, BelievesAPhotoMoreThanARecordThatMostPairsSpeakAgainst) {
  for (int i = 0; i < 3; ++i) Match(i, 3, 60, Vector3d::Zero());
  Match(0, 1, 60, Vector3d::Zero());
  Match(1, 2, 60, Vector3d::Zero());
  recorded_[3] = SitePose({60, 40, 25}, 120, -90);
  const int beside = Take({60, 40, 25}, Vector3d::Zero());
  // Where the record says it is, one neighbour happens to fit.
  VerifiedPair chance;
  chance.pair = {3, beside, {}};
  for (int i = 0; i < 20; ++i) {
    const Vector3d point(55 + 0.5 * i, 35 + 0.5 * i, 0);
    scene_.photos[3].keypoints.push_back(*SiteCamera().Project(*recorded_[3] * point));
    scene_.photos[beside].keypoints.push_back(*SiteCamera().Project(truth_[beside] * point));
    chance.pair.matches.push_back({static_cast<int>(scene_.photos[3].keypoints.size()) - 1, i});
  }
  pairs_.push_back(chance);
  EXPECT_EQ(Drop(), 1);
  EXPECT_EQ(pairs_.size(), 5u);
  EXPECT_EQ(pairs_.back().pair.second, 2);
}

// Two flights above the same ground, the records of the second one off by `off`.
class TwoFlights : public Contradictions {
 protected:
  explicit TwoFlights(const Vector3d& off = Vector3d::Zero()) {
    first_ = {0, 1, 2, 3, Take({14, -20, 25}, Vector3d::Zero())};
    for (int i = 0; i < 5; ++i) second_.push_back(Take({-10.0 + 6 * i, -17, 25}, off));
    for (int i = 0; i < 4; ++i) {
      Match(first_[i], first_[i + 1], 60, Vector3d::Zero());
      Match(second_[i], second_[i + 1], 60, Vector3d::Zero());
    }
  }
  std::vector<int> first_;
  std::vector<int> second_;
};

class TwoFlightsApart : public TwoFlights {
 protected:
  TwoFlightsApart() : TwoFlights({0, 25, 0}) {}
};

TEST_F(TwoFlightsApart, StayTiedByPairsThatSayTheSame) {
  for (int i = 1; i < 4; ++i) Match(first_[i], second_[i], 60, Vector3d::Zero());
  EXPECT_EQ(Drop(), 0);
  // A photo whose one pair speaks against its record is not believed.
  const int alone = Take({-10, -17, 25}, {0, 25, 0});
  Match(second_[0], alone, 20, Vector3d::Zero());
  Match(0, alone, 60, Vector3d::Zero());
  EXPECT_EQ(Drop(), 2);
}

TEST_F(TwoFlightsApart, LoseAPairThatSaysSomethingElse) {
  for (int i = 0; i < 4; ++i) Match(first_[i], second_[i], 60, Vector3d::Zero());
  Match(first_[4], second_[3], 60, {-20, 0, 0});
  EXPECT_EQ(Drop(), 1);
  EXPECT_EQ(pairs_.size(), 12u);
}

TEST_F(TwoFlights, AreNotTiedByPairsThatRepeatDifferently) {
  Match(first_[0], second_[0], 60, {18, 0, 0});
  Match(first_[1], second_[1], 60, {-18, 0, 0});
  Match(first_[2], second_[2], 60, {26, 0, 0});
  Match(first_[3], second_[3], 60, {-26, 0, 0});
  EXPECT_EQ(Drop(), 4);
  EXPECT_EQ(pairs_.size(), 8u);
}

TEST_F(TwoFlights, AreNotTiedByAMinorityThatAgrees) {
  for (int i = 0; i < 3; ++i) Match(first_[i], second_[i], 60, {18, 0, 0});
  Match(first_[3], second_[3], 60, {-18, 0, 0});
  Match(first_[4], second_[4], 60, {-18, 0, 0});
  Match(first_[2], second_[1], 60, {26, 0, 0});
  EXPECT_EQ(Drop(), 6);
}

TEST_F(TwoFlights, KeepARecordThatWrongPairsContradictDifferently) {
  const int beside = Take({14, -17, 25}, Vector3d::Zero());
  Match(first_[4], beside, 60, Vector3d::Zero());
  Match(first_[3], beside, 60, {18, 0, 0});
  Match(first_[2], beside, 60, {26, 0, 0});
  Match(second_[4], beside, 60, {18, 0, 0});
  Match(second_[3], beside, 60, {26, 0, 0});
  EXPECT_EQ(Drop(), 4);
  EXPECT_EQ(pairs_.size(), 9u);
  EXPECT_EQ(pairs_.back().pair.second, beside);
}

TEST_F(Contradictions, SaysNothingWhereNoRecordIsBelieved) {
  for (int i = 0; i < 3; ++i) {
    Match(i, i + 1, 60, Vector3d::Zero());
    recorded_[i] = SitePose({40.0 - 20 * i, 30, 25}, 90.0 * i, -90);
  }
  EXPECT_EQ(Drop(), 0);
}

TEST_F(Contradictions, SaysNothingWithAGuessedFocalLength) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  Match(0, 3, 80, {18, 0, 0});
  scene_.cameras[0].focal_sigma_ratio = 0.5;
  EXPECT_EQ(Drop(), 0);
  scene_.cameras[0].focal_sigma_ratio = 0.1;
  EXPECT_EQ(Drop(), 1);
}

TEST_F(Contradictions, SaysNothingWithoutARecordOrWithTooFewMatches) {
  Match(0, 1, 60, Vector3d::Zero());
  Match(2, 3, 60, Vector3d::Zero());
  Match(0, 3, 5, {18, 0, 0});
  EXPECT_EQ(Drop(), 0);
  Match(1, 2, 60, {-18, 0, 0});
  recorded_[1].reset();
  EXPECT_EQ(Drop(), 0);
}

TEST_F(Contradictions, AllowsForThingsThatStandInFrontOfTheGround) {
  Match(0, 1, 60, Vector3d::Zero());
  // Tree tops 8 m above the ground.
  VerifiedPair pair;
  pair.pair = {0, 2, {}};
  for (int i = 0; i < 40; ++i) {
    const Vector3d point(-6 + 0.2 * i, -25 + 0.3 * i, 8);
    for (const int photo : {0, 2}) {
      scene_.photos[photo].keypoints.push_back(*SiteCamera().Project(truth_[photo] * point));
    }
    pair.pair.matches.push_back({static_cast<int>(scene_.photos[0].keypoints.size()) - 1,
                                 static_cast<int>(scene_.photos[2].keypoints.size()) - 1});
  }
  pairs_.push_back(pair);
  Match(1, 2, 60, Vector3d::Zero());
  EXPECT_EQ(Drop(), 0);
}

}  // namespace
}  // namespace stucco::test
