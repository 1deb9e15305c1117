// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/match_photos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "calib/matching/choose_pairs.h"
#include "calib/scene/tracks.h"
#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"
#include "tests/survey/stage_support.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::Not;
using testing::Pair;

// Photos of the site's walls, their features made of points that are known.
class MatchPhotos : public testing::Test {
 protected:
  MatchPhotos() {
    captures_.cameras.push_back({"key", "Made", SiteCamera(), "option"});
    context_.progress = &listener_;
    context_.units = &units_;
    context_.threads = 2;
    options_.max_image_px = 1000;
  }

  int AddPhoto(const Pose& pose) {
    poses_.push_back(pose);
    CapturedPhoto photo;
    photo.hash = "photo " + std::to_string(poses_.size());
    photo.usable = true;
    photo.width_px = SiteCamera().width_px;
    photo.height_px = SiteCamera().height_px;
    photo.camera = 0;
    captures_.photos.push_back(photo);
    features_.plain.emplace_back();
    return static_cast<int>(poses_.size()) - 1;
  }

  // The photo's keypoints of points `first` up to `end`; equal numbers are equal points.
  Features See(int photo, int first, int end) const {
    Features features;
    for (int i = first; i < end; ++i) {
      Random random(1000 + i);
      const Vector3d point(random.Uniform(0, 20), random.Uniform(-1, 1), random.Uniform(0, 12));
      std::array<uint8_t, 128> descriptor;
      for (uint8_t& value : descriptor) value = static_cast<uint8_t>(random.Uniform(0, 120));
      const auto pixel = SiteCamera().Project(poses_[photo] * point);
      if (!pixel || !SiteCamera().Contains(*pixel)) continue;
      features.keypoints.push_back(
          {static_cast<float>(pixel->x()), static_cast<float>(pixel->y()), 2});
      features.colors.push_back({});
      features.descriptors.push_back(descriptor);
    }
    return features;
  }

  void SeePlain(int photo, int first, int end) { features_.plain[photo] = See(photo, first, end); }

  // On a rectified wall, at 5 m along it and in height: everything within reach.
  void SeeOnWall(int photo, int wall, int first, int end) {
    WallRun& run = features_.walls[{photo, wall}];
    run.features = See(photo, first, end);
    run.places.assign(run.features.size(), {5, 5, 0.1f});
    guidance_.walls[{photo, wall}].along_m.from_m = wall;  // in its key
    size_t begin = features_.plain[photo].size();
    for (auto& [key, each] : features_.walls) {
      if (key.first != photo) continue;
      each.begin = begin;
      begin += each.features.size();
    }
  }

  PhotoSet Set() {
    photos_.clear();
    for (const CapturedPhoto& photo : captures_.photos) photos_.push_back(&photo);
    repeating_.wall_of.resize(photos_.size());
    return {captures_, photos_, guidance_};
  }

  std::vector<VerifiedPair> Matched() {
    return MatchAll(options_, Set(), features_, repeating_, context_).verified;
  }

  // What joins what: (photo, pixel) to (photo, pixel).
  using Joined = std::vector<std::tuple<int, int, float, float, float, float>>;
  Joined Joins(const std::vector<VerifiedPair>& pairs) const {
    Joined joined;
    for (const VerifiedPair& each : pairs) {
      const Features first = features_.AllOf(each.pair.first);
      const Features second = features_.AllOf(each.pair.second);
      for (const Match& match : each.pair.matches) {
        const Keypoint& a = first.keypoints.at(match.first);
        const Keypoint& b = second.keypoints.at(match.second);
        joined.emplace_back(each.pair.first, each.pair.second, a.x, a.y, b.x, b.y);
      }
    }
    return joined;
  }

  CalibOptions options_;
  Captures captures_;
  Guidance guidance_;
  DetectedFeatures features_;
  OnRepeatingWalls repeating_;
  std::vector<Pose> poses_;
  MemoryUnits units_;
  Listener listener_;
  StageContext context_;

 private:
  std::vector<const CapturedPhoto*> photos_;
};

TEST_F(MatchPhotos, JoinsWhatIsFoundInPhotosAndOnTheirWalls) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  SeePlain(a, 0, 60);
  SeePlain(b, 0, 60);
  const size_t plain = Joins(Matched()).size();
  EXPECT_GT(plain, 40u);
  SeeOnWall(a, 0, 100, 160);
  SeeOnWall(b, 0, 100, 160);
  guidance_.wall_pairs = {{a, b, 0}};
  EXPECT_GT(Joins(Matched()).size(), plain + 40);
}

TEST_F(MatchPhotos, LeavesWallsOutThatRepeatThemselves) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  SeePlain(a, 0, 60);
  SeePlain(b, 0, 60);
  SeeOnWall(a, 0, 100, 160);
  SeeOnWall(b, 0, 100, 160);
  guidance_.wall_pairs = {{a, b, 0}};
  const size_t all = Joins(Matched()).size();
  repeating_.period_m[0] = 3;
  const size_t plain = Joins(Matched()).size();
  EXPECT_LT(plain, all - 40);
  // The first twenty of one photo lie on it.
  repeating_.wall_of = {std::vector<int>(features_.plain[a].size(), -1), {}};
  std::fill_n(repeating_.wall_of[0].begin(), 20, 0);
  EXPECT_LE(Joins(Matched()).size(), plain - 15);
  repeating_.wall_of[0].assign(features_.plain[a].size(), 0);
  EXPECT_TRUE(Matched().empty());
}

TEST_F(MatchPhotos, CountsAPointOnceThatIsFoundInThePhotoAndOnItsWall) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  SeePlain(a, 0, 60);
  SeePlain(b, 0, 60);
  const size_t plain = Joins(Matched()).size();
  SeeOnWall(a, 0, 30, 60);
  SeeOnWall(b, 0, 30, 60);
  guidance_.wall_pairs = {{a, b, 0}};
  EXPECT_EQ(Joins(Matched()).size(), plain);
}

// The tracks that the matches give, as numbers of (photo, keypoint).
std::vector<SceneTrack> Tracks(const DetectedFeatures& features,
                               const std::vector<VerifiedPair>& pairs) {
  std::vector<size_t> num_keypoints;
  for (size_t i = 0; i < features.plain.size(); ++i) {
    num_keypoints.push_back(features.AllOf(static_cast<int>(i)).size());
  }
  std::vector<PhotoPair> matches;
  for (const VerifiedPair& pair : pairs) matches.push_back(pair.pair);
  return TracksFrom(num_keypoints, matches);
}

std::ptrdiff_t NumOfThree(const std::vector<SceneTrack>& tracks) {
  return std::ranges::count_if(tracks,
                               [](const SceneTrack& track) { return track.elements.size() == 3; });
}

TEST_F(MatchPhotos, JoinsWhatAPhotoAndItsWallShowToOneTrack) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  const int c = AddPhoto(SitePose({10, -15, 6}, 0, 0));
  // The first two photos match as they are, the third only on the wall.
  SeePlain(a, 0, 60);
  SeePlain(b, 0, 60);
  SeePlain(c, 300, 310);
  SeeOnWall(b, 0, 0, 60);
  SeeOnWall(c, 0, 0, 60);
  guidance_.wall_pairs = {{b, c, 0}};
  const auto pairs = Matched();
  EXPECT_EQ(pairs.size(), 2u);
  const auto tracks = Tracks(features_, pairs);
  EXPECT_GT(NumOfThree(tracks), 40);
  for (const SceneTrack& track : tracks) {
    for (const SceneElement& element : track.elements) {
      if (element.photo != b) continue;
      EXPECT_LT(element.keypoint, static_cast<int>(features_.plain[b].size()));
    }
  }
}

TEST_F(MatchPhotos, JoinsWhatSeveralWallsShowToOneTrack) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  const int c = AddPhoto(SitePose({10, -15, 6}, 0, 0));
  for (const int photo : {a, b}) SeeOnWall(photo, 0, 0, 60);
  for (const int photo : {b, c}) SeeOnWall(photo, 1, 0, 60);
  guidance_.wall_pairs = {{a, b, 0}, {b, c, 1}};
  EXPECT_GT(NumOfThree(Tracks(features_, Matched())), 40);
}

TEST_F(MatchPhotos, ReadsDescriptorsAgainThatWereNotKept) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  for (const int photo : {a, b}) {
    SeePlain(photo, 0, 60);
    SeeOnWall(photo, 0, 100, 160);
  }
  guidance_.wall_pairs = {{a, b, 0}};
  const Joined kept = Joins(Matched());
  EXPECT_GT(kept.size(), 80u);
  units_.Clear();
  for (const int photo : {a, b}) {
    Features& plain = features_.plain[photo];
    units_.Save("features", FeaturesKey(options_, captures_.photos[photo]), Serialize(plain));
    plain.descriptors.clear();
    Features& on_wall = features_.walls.at({photo, 0}).features;
    units_.Save("features", WallKey(options_, Set(), photo, 0), Serialize(on_wall));
    on_wall.descriptors.clear();
  }
  EXPECT_EQ(Joins(Matched()), kept);
}

TEST_F(MatchPhotos, GivesMemoryBackThatDescriptorsMayNotTake) {
  const int photo = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  SeePlain(photo, 0, 60);
  SeeOnWall(photo, 0, 100, 160);
  units_.Save("features", FeaturesKey(options_, captures_.photos[photo]),
              Serialize(features_.plain[photo]));
  units_.Save("features", WallKey(options_, Set(), photo, 0),
              Serialize(features_.walls.at({photo, 0}).features));
  context_.memory_limit_bytes = 1000;
  const DetectedFeatures none = DetectAll(options_, Set(), context_);
  EXPECT_GT(none.plain[photo].size(), 40u);
  EXPECT_EQ(none.plain[photo].descriptors.capacity(), 0u);
  EXPECT_EQ(none.walls.at({photo, 0}).features.descriptors.capacity(), 0u);
  context_.memory_limit_bytes = 1000000;
  DetectedFeatures all = DetectAll(options_, Set(), context_);
  EXPECT_EQ(all.plain[photo].descriptors.size(), all.plain[photo].size());
  DropDescriptors(all);
  EXPECT_EQ(all.plain[photo].descriptors.capacity(), 0u);
  EXPECT_EQ(all.walls.at({photo, 0}).features.descriptors.capacity(), 0u);
}

TEST_F(MatchPhotos, GivesWithCheckpointsWhatItGivesWithout) {
  const int a = AddPhoto(SitePose({6, -15, 6}, 5, 0));
  const int b = AddPhoto(SitePose({13, -15, 6}, -5, 0));
  for (const int photo : {a, b}) {
    SeePlain(photo, 0, 60);
    SeeOnWall(photo, 5, 100, 160);
  }
  guidance_.wall_pairs = {{a, b, 5}};
  const Joined before = Joins(Matched());
  // One more photo: now photo a has another wall, whose keypoints come before those of wall 5.
  const int c = AddPhoto(SitePose({10, -20, 20}, 0, -30));
  SeePlain(c, 0, 30);
  for (const int photo : {a, c}) SeeOnWall(photo, 2, 200, 260);
  guidance_.wall_pairs = {{a, b, 5}, {a, c, 2}};
  const Joined with = Joins(Matched());
  for (const auto& joined : before) EXPECT_THAT(with, Contains(joined));
  context_.units = &NoUnits();
  EXPECT_EQ(Joins(Matched()), with);
  context_.threads = 1;
  EXPECT_EQ(Joins(Matched()), with);
}

// 24 photos in two rows along a wall; those that stand above each other show the same part of it.
class MatchByPlan : public MatchPhotos {
 protected:
  MatchByPlan() {
    for (int i = 0; i < kPhotos; ++i) {
      const int column = i % kColumns;
      AddPhoto(SitePose({10.0 + (i < kColumns ? 2 : -2), -15, 6}, i < kColumns ? -8 : 8, 0));
      SeePlain(i, 100 * column, 100 * column + 60);
      captures_.photos[i].position = GeoPosition{50, 14 + 0.0001 * column, 300, true, 1, 1, false};
    }
    options_.exhaustive_below = 4;
    options_.neighbours = 1;
  }
  static constexpr int kColumns = 12;
  static constexpr int kPhotos = 2 * kColumns;
};

TEST_F(MatchByPlan, TakesThePairsOfThePlan) {
  for (int i = 0; i < kColumns; ++i) guidance_.pairs.emplace_back(i, i + kColumns);
  EXPECT_EQ(Matched().size(), static_cast<size_t>(kColumns));
  EXPECT_TRUE(listener_.warnings.empty());
}

TEST_F(MatchByPlan, WarnsAndLooksElsewhereWhenThePhotosShowSomethingElse) {
  for (int i = 0; i < kPhotos; ++i) guidance_.pairs.emplace_back(std::minmax(i, (i + 5) % kPhotos));
  std::ranges::sort(guidance_.pairs);
  EXPECT_EQ(Matched().size(), static_cast<size_t>(kColumns));
  ASSERT_EQ(listener_.warnings.size(), 1u);
  EXPECT_THAT(listener_.warnings[0], testing::HasSubstr("do not show what the plan says"));
}

TEST_F(MatchByPlan, KeepsTheNearestOfPhotosThatThePlanSaysLittleOf) {
  options_.neighbours = 4;
  for (int i = 1; i < kColumns; ++i) {
    for (int j = 1; j < 5; ++j)
      guidance_.pairs.emplace_back(std::minmax(i, kColumns + (i + j) % 12));
  }
  std::ranges::sort(guidance_.pairs);
  std::vector<const CapturedPhoto*> photos;
  for (const CapturedPhoto& photo : captures_.photos) photos.push_back(&photo);
  const std::vector<Features> looks(kPhotos);  // no appearance to go by
  const PairChoice choice = ChoosePairs(
      options_, {captures_, photos, guidance_}, [&](int photo) { return looks[photo]; }, 2);
  EXPECT_TRUE(choice.by_plan);
  EXPECT_TRUE(std::ranges::is_sorted(choice.pairs));
  EXPECT_THAT(choice.pairs, Contains(Pair(0, kColumns)));  // the plan says nothing of photo 0
  EXPECT_THAT(choice.pairs, Not(Contains(Pair(6, 7))));
  EXPECT_THAT(choice.otherwise, Contains(Pair(6, 7)));
}

}  // namespace
}  // namespace stucco::test
