// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/hidden_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "calib/scene/tracks.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// Three photos of a wall at y = 0, 20 m wide and 10 m high, from 15 m before it.
class HiddenPoints : public ::testing::Test {
 protected:
  HiddenPoints() {
    const Camera camera = MadeCamera();
    scene_.cameras = {{camera, camera, 0.1}};
    for (const double x : {-4.0, 0.0, 4.0}) {
      ScenePhoto photo;
      photo.pose = LookAt({x, -15, 5}, {0, 0, 5});
      scene_.photos.push_back(photo);
    }
    Random random(3);
    for (int i = 0; i < 300; ++i) Show({random.Uniform(-10, 10), 0, random.Uniform(0, 10)});
  }

  // Adds a point that all photos see which have it in their pictures; returns its track.
  size_t Show(const Vector3d& point) {
    SceneTrack track{{}, point};
    for (int i = 0; i < 3; ++i) {
      const auto pixel = scene_.CameraOf(i).Project(*scene_.photos[i].pose * point);
      if (!pixel || !scene_.CameraOf(i).Contains(*pixel)) continue;
      track.elements.push_back({i, static_cast<int>(scene_.photos[i].keypoints.size()), true});
      scene_.photos[i].keypoints.push_back(*pixel);
    }
    scene_.tracks.push_back(track);
    return scene_.tracks.size() - 1;
  }

  int Drop(int threads = 2) {
    IndexTracks(scene_);
    return DropHiddenPoints(threads, scene_);
  }

  Scene scene_;
};

TEST_F(HiddenPoints, AreTakenAway) {
  const size_t behind = Show({1, 80, 7});
  const size_t just_behind = Show({1, 4, 5});  // as a room behind its window
  EXPECT_EQ(Drop(), 1);
  EXPECT_FALSE(scene_.tracks[behind].position);
  for (const SceneElement& e : scene_.tracks[behind].elements) EXPECT_FALSE(e.used);
  EXPECT_TRUE(scene_.tracks[just_behind].position);
}

TEST_F(HiddenPoints, AreNotThoseSeenPastAnEdge) {
  // Above the wall, and in a gateway that takes a fifth of its length.
  std::erase_if(scene_.tracks, [](const SceneTrack& track) {
    return std::abs(track.position->x()) < 2 && track.position->z() < 6;
  });
  Random random(4);
  const size_t begin = scene_.tracks.size();
  for (int i = 0; i < 60; ++i) Show({random.Uniform(-60, 60), 90, random.Uniform(45, 50)});
  for (int i = 0; i < 60; ++i) Show({random.Uniform(-5, 5), 40, random.Uniform(-5, 6)});
  const size_t shown = scene_.tracks.size() - begin;
  EXPECT_LT(Drop(), static_cast<int>(shown) / 10);  // single ones close to the edges
}

TEST_F(HiddenPoints, CountWhereHalfOfThePhotosSaySo) {
  // Behind the wall for the first photo alone, which sees nothing else there.
  Vector3d behind(2, 80, 6);
  const size_t track = Show(behind);
  for (SceneTrack& other : scene_.tracks) {
    if (other.position->y() != 0) continue;
    std::erase_if(other.elements, [](const SceneElement& e) { return e.photo > 0; });
  }
  EXPECT_EQ(Drop(), 0);
  EXPECT_TRUE(scene_.tracks[track].position);
}

TEST_F(HiddenPoints, AreTheSameWithAnyNumberOfThreads) {
  for (int i = 0; i < 20; ++i) Show({0.4 * i - 4, 60.0 + i, 6});
  IndexTracks(scene_);
  Scene other = scene_;
  EXPECT_EQ(DropHiddenPoints(1, scene_), DropHiddenPoints(3, other));
  for (size_t t = 0; t < scene_.tracks.size(); ++t) {
    EXPECT_EQ(scene_.tracks[t].position.has_value(), other.tracks[t].position.has_value());
  }
}

}  // namespace
}  // namespace stucco::test
