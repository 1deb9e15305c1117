// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/calib/made_parts.h"

namespace stucco::test {
namespace {

Scene TwoHalves() {
  return Joined(MakeScene({.num_photos = 5, .num_points = 200}),
                MakeScene({.num_photos = 7, .num_points = 200, .seed = 2}), {200, 0, 0});
}

// Lets photo 0 see this many points of the other half: those that photo 5 and another see.
void Tie(int count, Scene& scene) {
  for (SceneTrack& track : scene.tracks) {
    if (count == 0) return;
    if (track.elements.front().photo != 5) continue;
    scene.photos[0].keypoints.push_back({1, 1});
    scene.tracks_of_photo[0].push_back(static_cast<int>(&track - scene.tracks.data()));
    const int keypoint = static_cast<int>(scene.photos[0].keypoints.size()) - 1;
    track.elements.insert(track.elements.begin(), {0, keypoint, true});
    --count;
  }
}

TEST(TiedGroups, HalvesThatShareNothingAreTwoTheLargerFirst) {
  const auto groups = TiedGroups(TwoHalves(), 15);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0], (std::vector<int>{5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(groups[1], (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(TiedGroups, EnoughPointsInCommonMakeThemOne) {
  Scene scene = TwoHalves();
  Tie(14, scene);
  EXPECT_EQ(TiedGroups(scene, 15).size(), 2u);
  Tie(1, scene);
  EXPECT_EQ(TiedGroups(scene, 15).size(), 1u);
}

// No pair of photos shares enough with the last, but what the others see together does.
TEST(TiedGroups, PointsOfSeveralPhotosCountTogether) {
  Scene scene = MakeScene({.num_photos = 8, .num_points = 300});
  std::vector<int> shared(8, 0);
  for (SceneTrack& track : scene.tracks) {
    const auto last = std::ranges::find(track.elements, 7, &SceneElement::photo);
    if (last == track.elements.end()) continue;
    const size_t other = track.elements.size() - 2;  // the photo before it
    if (shared[track.elements[other].photo]++ < 6) {
      track.elements = {track.elements[other], *last};
    } else {
      last->used = false;
    }
  }
  const int together = std::accumulate(shared.begin(), shared.end(), 0,
                                       [](int sum, int n) { return sum + std::min(n, 6); });
  ASSERT_GE(together, 10);
  EXPECT_EQ(TiedGroups(scene, 10).size(), 1u);
  EXPECT_EQ(TiedGroups(scene, together + 1).size(), 2u);
}

TEST(TiedGroups, PhotosWithoutAPoseAreInNone) {
  Scene scene = TwoHalves();
  TakePoses({3}, scene);
  const auto groups = TiedGroups(scene, 15);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[1], (std::vector<int>{0, 1, 2, 4}));
  EXPECT_TRUE(TiedGroups(Scene{}, 15).empty());
}

TEST(SceneOf, HoldsThesePhotosAlone) {
  const Scene scene = TwoHalves();
  const Scene part = SceneOf(scene, {0, 1, 2, 3, 4});
  EXPECT_TRUE(IsConsistent(part));
  ASSERT_EQ(part.photos.size(), scene.photos.size());
  EXPECT_EQ(NumRegistered(part), 5);
  EXPECT_TRUE(part.photos[5].keypoints.empty());
  for (int photo = 0; photo < 5; ++photo) {
    EXPECT_EQ(NumUsedObservations(part, photo), NumUsedObservations(scene, photo));
  }
}

TEST(SceneOf, DropsPointsThatFewerThanTwoSee) {
  const Scene scene = MakeScene({.num_photos = 6, .num_points = 200});
  const Scene part = SceneOf(scene, {0, 5});
  EXPECT_TRUE(IsConsistent(part));
  for (const SceneTrack& track : part.tracks) {
    ASSERT_EQ(track.elements.size(), 2u);
    EXPECT_TRUE(track.position);
  }
  EXPECT_EQ(NumRegistered(SceneOf(scene, {})), 0);
}

TEST(TakePoses, TakesWhatThePhotosObserved) {
  Scene scene = MakeScene({.num_photos = 3, .num_points = 200});
  TakePoses({0, 1}, scene);
  EXPECT_EQ(NumRegistered(scene), 1);
  for (const SceneTrack& track : scene.tracks) {
    EXPECT_FALSE(track.position);  // one photo sees no point
    EXPECT_TRUE(std::ranges::none_of(track.elements, &SceneElement::used));
  }
}

}  // namespace
}  // namespace stucco::test
