// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/initial_pair.h"

#include <gtest/gtest.h>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

// Six photos from one place and what matching finds between them.
Scene Panorama(double noise_px) {
  return MakeScene({.num_photos = 6, .num_points = 300, .arc_rad = 0, .noise_px = noise_px});
}

TEST(ClassifyMotion, FindsRotationsOnly) {
  const Scene scene = Panorama(0.5);
  const auto pairs = Verified(scene, MatchesOf(scene, 0.1, 1));
  ASSERT_GE(pairs.size(), 10u);
  for (const VerifiedPair& pair : pairs) EXPECT_TRUE(pair.rotation_only);
}

TEST(ClassifyMotion, TakesNoTranslationForARotation) {
  for (const int planes : {1, 2}) {
    const Scene scene = MakeScene({.num_photos = 6, .num_planes = planes, .noise_px = 0.5});
    for (const VerifiedPair& pair : Verified(scene, MatchesOf(scene, 0.1, 1))) {
      EXPECT_FALSE(pair.rotation_only) << pair.pair.first << " " << pair.pair.second;
    }
  }
}

TEST(ClassifyMotion, SurvivesAFocalLengthThatIsAGuess) {
  Scene scene = Panorama(0.5);
  auto pairs = Verified(scene, MatchesOf(scene, 0, 1));
  for (const int i : {0, 1}) scene.cameras[0].intrinsics.params[i] *= 1.05;
  int rotations = 0;
  for (VerifiedPair& pair : pairs) {
    ClassifyMotion(scene, 4, pair);
    rotations += pair.rotation_only;
  }
  EXPECT_GE(rotations, 0.8 * pairs.size());
}

TEST(RotationGroups, FindsThePanorama) {
  const Scene scene = Panorama(0.3);
  const auto pairs = Verified(scene, MatchesOf(scene, 0, 1));
  const std::vector<std::vector<int>> expected = {{0, 1, 2, 3, 4, 5}};
  EXPECT_EQ(RotationGroups(scene, pairs), expected);
  EXPECT_EQ(RotationGroups(Blank(scene), pairs), expected);
}

VerifiedPair RotationPair(int first, int second) {
  VerifiedPair pair;
  pair.pair = {first, second, {}};
  pair.rotation_only = true;
  return pair;
}

TEST(RotationGroups, NeedsThreePhotosAndKeepsPlacesApart) {
  Scene scene;
  scene.photos.resize(9);
  scene.tracks_of_photo.resize(9);
  VerifiedPair moved = RotationPair(2, 4);
  moved.rotation_only = false;
  const std::vector<VerifiedPair> pairs = {RotationPair(5, 6), RotationPair(4, 5),
                                           RotationPair(0, 2), RotationPair(1, 2),
                                           RotationPair(7, 8), moved};
  const std::vector<std::vector<int>> expected = {{0, 1, 2}, {4, 5, 6}};
  EXPECT_EQ(RotationGroups(scene, pairs), expected);
  EXPECT_TRUE(RotationGroups(scene, {}).empty());
}

TEST(RotationGroups, PosesAtDifferentPlacesSpeakAgainstARotation) {
  const Scene truth = MakeScene({.num_photos = 4, .seen_share = 1});
  std::vector<VerifiedPair> pairs = Verified(truth, MatchesOf(truth, 0, 1));
  for (VerifiedPair& pair : pairs) pair.rotation_only = true;
  EXPECT_TRUE(RotationGroups(truth, pairs).empty());
  const std::vector<std::vector<int>> all = {{0, 1, 2, 3}};
  EXPECT_EQ(RotationGroups(Blank(truth), pairs), all);
}

TEST(FindInitialPairs, PrefersManyMatchesUnderAGoodAngle) {
  const Scene scene = MakeScene({.num_photos = 6, .arc_rad = 1.0, .noise_px = 0.3});
  const auto found = FindInitialPairs(scene, Verified(scene, MatchesOf(scene, 0.1, 1)), 4, 4);
  ASSERT_EQ(found.size(), 4u);
  for (const InitialPair& pair : found) {
    EXPECT_LT(pair.first, pair.second);
    EXPECT_GT(pair.relative.median_angle_rad, 0.1);
    const Pose expected =
        *scene.photos[pair.second].pose * scene.photos[pair.first].pose->Inverse();
    EXPECT_LT(pair.relative.second_from_first.rotation.angularDistance(expected.rotation), 0.02);
    EXPECT_GT(pair.relative.second_from_first.translation.dot(expected.translation.normalized()),
              0.99);
  }
}

TEST(FindInitialPairs, TakesNoRotations) {
  const Scene scene = Panorama(0.3);
  EXPECT_TRUE(FindInitialPairs(scene, Verified(scene, MatchesOf(scene, 0, 1)), 4, 8).empty());
  EXPECT_TRUE(FindInitialPairs(scene, {}, 4, 8).empty());
}

}  // namespace
}  // namespace stucco::test
