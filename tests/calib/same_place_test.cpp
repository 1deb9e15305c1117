// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/same_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Places = std::vector<int32_t>;

TEST(FindPlaces, GivesAWallKeypointThePlainOneAtItsPlace) {
  const std::vector<Keypoint> keypoints = {
      {10, 10, 2}, {50, 20, 2}, {50.6f, 20.5f, 3}, {30, 30, 2}, {10, 11.2f, 2}};
  EXPECT_EQ(FindPlaces(keypoints, 2, 1), Places({0, 1, 1, 3, 4}));
}

TEST(FindPlaces, TakesTheNearestAndOfEquallyNearOnesTheFirst) {
  const std::vector<Keypoint> keypoints = {{10, 10, 2},    {11, 10, 2},    {12, 10, 2},
                                           {10.8f, 10, 2}, {11.5f, 10, 2}, {10.5f, 10, 2}};
  EXPECT_EQ(FindPlaces(keypoints, 3, 1), Places({0, 1, 2, 1, 1, 0}));
}

TEST(FindPlaces, TellsBlobsOfAnotherSizeApart) {
  const std::vector<Keypoint> keypoints = {
      {10, 10, 2}, {10, 10, 4.1f}, {10, 10, 0.9f}, {10, 10, 4}};
  EXPECT_EQ(FindPlaces(keypoints, 1, 1), Places({0, 1, 2, 0}));
}

TEST(FindPlaces, OfThePhotoItselfOnlyOrientationsAreOnePlace) {
  const std::vector<Keypoint> keypoints = {{10, 10, 2}, {10, 10, 2}, {10.3f, 10, 2}};
  EXPECT_EQ(FindPlaces(keypoints, 3, 1), Places({0, 0, 2}));
}

TEST(FindPlaces, MakesOnePlaceOfWhatTwoWallsShow) {
  const std::vector<Keypoint> keypoints = {
      {90, 90, 2}, {10, 10, 2}, {10.7f, 10, 2}, {11.4f, 10, 2}};
  // The last is near the third only, which stands for nothing.
  EXPECT_EQ(FindPlaces(keypoints, 1, 1), Places({0, 1, 1, 3}));
}

TEST(FindPlaces, FindsWhatComparingAllFinds) {
  Random random(4);
  std::vector<Keypoint> keypoints;
  for (int i = 0; i < 600; ++i) {
    keypoints.push_back({static_cast<float>(random.Uniform(0, 40)),
                         static_cast<float>(random.Uniform(0, 40)),
                         static_cast<float>(random.Uniform(1, 4))});
  }
  const Places places = FindPlaces(keypoints, 300, 1);
  for (int i = 0; i < 600; ++i) {
    int expected = i;
    double nearest = i < 300 ? 0 : 1;
    for (int j = 0; j < i; ++j) {
      const double ratio = keypoints[i].scale / keypoints[j].scale;
      const double apart =
          std::hypot(keypoints[i].x - keypoints[j].x, keypoints[i].y - keypoints[j].y);
      if (places[j] != j || ratio > 2 || ratio < 0.5 || apart > nearest) continue;
      if (apart == nearest && expected != i) continue;
      nearest = apart;
      expected = j;
    }
    EXPECT_EQ(places[i], expected) << i;
  }
}

TEST(FindPlaces, NothingInNothing) {
  EXPECT_TRUE(FindPlaces({}, 0, 1).empty());
}

TEST(DropRepeated, KeepsTheFirstOfMatchesOfThePlaces) {
  std::vector<Match> matches = {{0, 0}, {1, 1}, {2, 2}, {3, 0}};
  DropRepeated({{0, 1, 0, 3}, {0, 1, 0}}, matches);
  EXPECT_EQ(matches, (std::vector<Match>{{0, 0}, {1, 1}, {3, 0}}));
}

TEST(JoinPlaces, JoinsWhatStandsForThePlacesOneToOne) {
  std::vector<Match> matches = {{0, 0}, {3, 1}, {2, 2}, {1, 3}, {4, 3}};
  JoinPlaces({{0, 1, 0, 3, 4}, {0, 1, 2, 3}}, matches);
  EXPECT_EQ(matches, (std::vector<Match>{{0, 0}, {3, 1}, {1, 3}}));
}

TEST(FindPlacesDeathTest, RequiresThePlainOnesAmongAll) {
  EXPECT_DEATH(FindPlaces({}, 1, 1), "num_plain");
}

}  // namespace
}  // namespace stucco::test
