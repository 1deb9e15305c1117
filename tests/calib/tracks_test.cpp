// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Node = std::pair<int, int>;

std::vector<std::vector<Node>> Nodes(const std::vector<SceneTrack>& tracks) {
  std::vector<std::vector<Node>> result;
  for (const SceneTrack& track : tracks) {
    result.emplace_back();
    for (const SceneElement& e : track.elements) result.back().emplace_back(e.photo, e.keypoint);
  }
  return result;
}

TEST(BuildTracks, JoinsMatchesAcrossPhotos) {
  const auto tracks = TracksFrom({3, 3, 3}, {{0, 1, {{0, 2}, {1, 1}}}, {1, 2, {{2, 0}}}});
  const std::vector<std::vector<Node>> expected = {{{0, 0}, {1, 2}, {2, 0}}, {{0, 1}, {1, 1}}};
  EXPECT_EQ(Nodes(tracks), expected);
  for (const SceneTrack& track : tracks) EXPECT_FALSE(track.position);
}

TEST(BuildTracks, RefusesTwoKeypointsOfOnePhoto) {
  // 0.0 - 1.0 - 2.0, and a wrong match 2.0 - 0.1 of a weaker pair would close the ring.
  const auto tracks =
      TracksFrom({2, 2, 2}, {{0, 2, {{1, 0}}}, {0, 1, {{0, 0}, {1, 1}}}, {1, 2, {{0, 0}, {1, 1}}}});
  const std::vector<std::vector<Node>> expected = {{{0, 0}, {1, 0}, {2, 0}},
                                                   {{0, 1}, {1, 1}, {2, 1}}};
  EXPECT_EQ(Nodes(tracks), expected);
}

TEST(BuildTracks, StrongPairsDecideConflicts) {
  // Photo 2's keypoint 0 is claimed by 0.0 (one match) and, through 1.0, by 0.1 (many matches).
  const auto tracks = TracksFrom(
      {4, 4, 4}, {{0, 2, {{0, 0}}}, {0, 1, {{1, 0}, {2, 2}, {3, 3}}}, {1, 2, {{0, 0}, {2, 2}}}});
  const std::vector<std::vector<Node>> expected = {
      {{0, 1}, {1, 0}, {2, 0}}, {{0, 2}, {1, 2}, {2, 2}}, {{0, 3}, {1, 3}}};
  EXPECT_EQ(Nodes(tracks), expected);
}

TEST(BuildTracks, DoesNotDependOnTheOrderOfPairsOfDifferentSize) {
  const Scene truth = MakeScene({.num_points = 80});
  std::vector<PhotoPair> pairs = MatchesOf(truth, 0, 1);
  const auto forward = Nodes(TracksFrom(std::vector<size_t>(8, 200), pairs));
  std::reverse(pairs.begin(), pairs.end());
  EXPECT_EQ(Nodes(TracksFrom(std::vector<size_t>(8, 200), pairs)), forward);
}

TEST(BuildTracks, FindsTheTracksOfCleanMatches) {
  const Scene truth = MakeScene({.num_points = 80});
  std::vector<size_t> counts;
  for (const ScenePhoto& photo : truth.photos) counts.push_back(photo.keypoints.size());
  auto expected = Nodes(truth.tracks);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(Nodes(TracksFrom(counts, MatchesOf(truth, 0, 1))), expected);
}

TEST(BuildTracks, NeverHoldsAPhotoTwiceWhateverTheMatches) {
  const Scene truth = MakeScene({.num_points = 150});
  std::vector<size_t> counts;
  for (const ScenePhoto& photo : truth.photos) counts.push_back(photo.keypoints.size());
  std::set<Node> taken;
  for (const auto& track : Nodes(TracksFrom(counts, MatchesOf(truth, 0.3, 3)))) {
    EXPECT_GE(track.size(), 2u);
    EXPECT_TRUE(std::is_sorted(track.begin(), track.end()));
    std::set<int> photos;
    for (const Node& node : track) {
      EXPECT_TRUE(photos.insert(node.first).second);
      EXPECT_TRUE(taken.insert(node).second);
    }
  }
}

TEST(BuildTracks, NothingFromNothing) {
  EXPECT_TRUE(TracksFrom({}, {}).empty());
  EXPECT_TRUE(TracksFrom({5, 5}, {}).empty());
  EXPECT_TRUE(TracksFrom({5, 5}, {{0, 1, {}}}).empty());
}

TEST(IndexTracks, FindsTheTrackOfEveryKeypoint) {
  Scene scene = MakeScene({.num_points = 50});
  scene.tracks.erase(scene.tracks.begin());
  IndexTracks(scene);
  size_t without = 0;
  for (size_t p = 0; p < scene.photos.size(); ++p) {
    ASSERT_EQ(scene.tracks_of_photo[p].size(), scene.photos[p].keypoints.size());
    for (size_t k = 0; k < scene.tracks_of_photo[p].size(); ++k) {
      const int track = scene.tracks_of_photo[p][k];
      if (track < 0) {
        ++without;
        continue;
      }
      const auto& elements = scene.tracks[track].elements;
      EXPECT_TRUE(std::any_of(elements.begin(), elements.end(), [&](const SceneElement& e) {
        return e.photo == static_cast<int>(p) && e.keypoint == static_cast<int>(k);
      }));
    }
  }
  EXPECT_GE(without, 2u);
  EXPECT_LE(without, scene.photos.size());
}

TEST(BuildTracksDeathTest, RequiresKeypointsThatThereAre) {
  EXPECT_DEATH(TracksFrom({2, 2}, {{0, 1, {{2, 0}}}}), "keypoint");
}

}  // namespace
}  // namespace stucco::test
