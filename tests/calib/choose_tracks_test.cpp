// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/choose_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "calib/adjust/adjust.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

std::vector<int> ObservationsOf(const Scene& scene, const std::vector<int>& tracks) {
  std::vector<int> count(scene.photos.size(), 0);
  for (const int track : tracks) {
    for (const SceneElement& e : scene.tracks[track].elements) count[e.photo] += e.used;
  }
  return count;
}

TEST(ChooseTracks, GivesEveryPhotoItsShare) {
  const Scene scene = MakeScene({.num_photos = 12, .num_points = 6000});
  const std::vector<int> chosen = ChooseTracks(scene, 200);
  EXPECT_LT(chosen.size(), scene.tracks.size() / 2);
  EXPECT_TRUE(std::ranges::is_sorted(chosen));
  for (const int count : ObservationsOf(scene, chosen)) EXPECT_GT(count, 80);
}

TEST(ChooseTracks, TakesAllWhereThatIsLittle) {
  const Scene scene = MakeScene({.num_photos = 6, .num_points = 60});
  EXPECT_EQ(ChooseTracks(scene, 400).size(), scene.tracks.size());
}

TEST(ChooseTracks, LeavesOutTracksWithoutPoints) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 60});
  scene.tracks[3].position.reset();
  const std::vector<int> chosen = ChooseTracks(scene, 400);
  EXPECT_FALSE(std::ranges::binary_search(chosen, 3));
}

TEST(ChooseTracks, TakesThoseThatMostPhotosSee) {
  const Scene scene = MakeScene({.num_photos = 12, .num_points = 6000, .seen_share = 0.5});
  const auto length = [&](const std::vector<int>& tracks) {
    double sum = 0;
    for (const int t : tracks) sum += static_cast<double>(scene.tracks[t].elements.size());
    return sum / static_cast<double>(tracks.size());
  };
  std::vector<int> all(scene.tracks.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  EXPECT_GT(length(ChooseTracks(scene, 100)), length(all));
}

TEST(Adjust, LeavesTracksAloneThatTakeNoPart) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 100, .noise_px = 0.5});
  const Scene before = scene;
  AdjustOptions options;
  for (int track = 0; track < 20; ++track) options.tracks.push_back(track);
  Adjust(options, scene);
  EXPECT_NE(*scene.tracks[3].position, *before.tracks[3].position);
  EXPECT_EQ(*scene.tracks[30].position, *before.tracks[30].position);
}

}  // namespace
}  // namespace stucco::test
