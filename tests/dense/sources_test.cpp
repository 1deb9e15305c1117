// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tests/dense/made_views.h"

namespace stucco::test {
namespace {

// Points on a wall ten metres before cameras at the given places, all looking along +z.
Reconstruction WallSeenFrom(const std::vector<Eigen::Vector3d>& places, int points) {
  Reconstruction r;
  Camera camera = SmallCamera();
  r.cameras[camera.id] = camera;
  for (uint32_t i = 0; i < places.size(); ++i) {
    RegisteredImage& photo = r.photos[PhotoId{i + 1}];
    photo.id = PhotoId{i + 1};
    photo.camera = camera.id;
    photo.name = std::to_string(i) + ".jpg";
    photo.cam_from_world.translation = -places[i];
  }
  for (int k = 0; k < points; ++k) {
    TrackPoint point;
    point.id = PointId{static_cast<uint64_t>(k) + 1};
    point.position = {(k % 10) * 0.3 - 1.5, (k / 10) * 0.2 - 1, 10 + 0.1 * (k % 7)};
    for (auto& [id, photo] : r.photos) {
      const auto pixel = camera.Project(photo.cam_from_world * point.position);
      if (!pixel || !camera.Contains(*pixel)) continue;
      point.track.push_back({id, static_cast<uint32_t>(photo.observations.size())});
      photo.observations.push_back({*pixel, point.id});
    }
    r.points[point.id] = point;
  }
  EXPECT_FALSE(FindProblem(r));
  return r;
}

SourceLimits Limits(int sources, int max_image_px) {
  return {.sources = sources, .neighbours = 24, .max_image_px = max_image_px};
}

TEST(ChooseSources, PrefersGoodAngles) {
  // From photo 1: half a degree, about ten degrees, about three degrees.
  const Reconstruction r = WallSeenFrom({{0, 0, 0}, {0.09, 0, 0}, {1.75, 0, 0}, {0.52, 0, 0}}, 60);
  const auto choices = ChooseSources(r, Limits(6, 200));
  ASSERT_TRUE(choices.contains(PhotoId{1}));
  EXPECT_EQ(choices.at(PhotoId{1}).sources, (std::vector<PhotoId>{PhotoId{3}, PhotoId{4}}));
}

TEST(ChooseSources, PrefersTheSameScale) {
  const Reconstruction r = WallSeenFrom({{0, 0, 0}, {1.5, 0, -15}, {-1.5, 0, 0}}, 60);
  const auto choices = ChooseSources(r, Limits(6, 200));
  ASSERT_GE(choices.at(PhotoId{1}).sources.size(), 1u);
  EXPECT_EQ(choices.at(PhotoId{1}).sources[0], PhotoId{3});
}

// Photos see the left half of a far wall, with many points. What is near has few of them, on the
// right half of the picture, and only the last photo sees them with the first.
Reconstruction WallAndSomethingNear(uint64_t near_points) {
  Reconstruction r =
      WallSeenFrom({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0.8, 0.6, 0}}, 400);
  const Camera& camera = r.cameras.begin()->second;
  std::set<PointId> gone;
  for (auto& [id, point] : r.points) {
    // Of the wall only the left half is tracked; by the last photo hardly any of it.
    std::erase_if(point.track, [&](const TrackElement& element) {
      return element.photo == PhotoId{6} && id.value % 8 != 0;
    });
    if (point.position.x() > 0) gone.insert(id);
  }
  for (const PointId id : gone) r.points.erase(id);
  for (uint64_t k = 0; k < near_points; ++k) {
    TrackPoint point;
    point.id = PointId{1000 + k};
    point.position = {0.1 + 0.12 * static_cast<double>(k % 6),
                      -0.3 + 0.45 * static_cast<double>(k / 6), 3};
    point.track = {{PhotoId{1}, 0}, {PhotoId{6}, 0}};
    r.points[point.id] = point;
  }
  for (auto& [id, photo] : r.photos) photo.observations.clear();
  for (auto& [id, point] : r.points) {
    for (TrackElement& element : point.track) {
      RegisteredImage& photo = r.photos.at(element.photo);
      element.observation = static_cast<uint32_t>(photo.observations.size());
      photo.observations.push_back(
          {*camera.Project(photo.cam_from_world * point.position), point.id});
    }
  }
  EXPECT_FALSE(FindProblem(r));
  return r;
}

TEST(ChooseSources, TakesWhatShowsAPartWithFewPoints) {
  const SourceChoice choice =
      ChooseSources(WallAndSomethingNear(24), Limits(2, 200)).at(PhotoId{1});
  EXPECT_EQ(std::count(choice.sources.begin(), choice.sources.end(), PhotoId{6}), 1);
}

TEST(ChooseSources, BoundsHoldWhatIsNearWithFewPoints) {
  const Reconstruction r = WallAndSomethingNear(1);
  EXPECT_LT(ChooseSources(r, Limits(2, 200)).at(PhotoId{1}).min_depth, 3);
}

TEST(ChooseSources, TakesNoMoreThanAsked) {
  const Reconstruction r =
      WallSeenFrom({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 60);
  for (const auto& [id, choice] : ChooseSources(r, Limits(2, 200))) {
    EXPECT_EQ(choice.sources.size(), 2u);
    EXPECT_EQ(std::count(choice.sources.begin(), choice.sources.end(), id), 0);
  }
}

TEST(ChooseSources, NeighboursGoOnWhereSourcesEnd) {
  const Reconstruction r = WallSeenFrom({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 60);
  for (const auto& [id, choice] : ChooseSources(r, {.sources = 1, .neighbours = 3})) {
    ASSERT_EQ(choice.sources.size(), 1u);
    ASSERT_EQ(choice.neighbours.size(), 3u);
    EXPECT_EQ(choice.neighbours[0], choice.sources[0]);
  }
}

TEST(ChooseSources, NothingForPhotosWithoutPartners) {
  EXPECT_TRUE(ChooseSources({}, Limits(6, 200)).empty());
  // One photo; two from one place; two that share too few points.
  EXPECT_TRUE(ChooseSources(WallSeenFrom({{0, 0, 0}}, 60), Limits(6, 200)).empty());
  EXPECT_TRUE(ChooseSources(WallSeenFrom({{0, 0, 0}, {0.01, 0, 0}}, 60), Limits(6, 200)).empty());
  EXPECT_TRUE(ChooseSources(WallSeenFrom({{0, 0, 0}, {1, 0, 0}}, 9), Limits(6, 200)).empty());
  EXPECT_EQ(ChooseSources(WallSeenFrom({{0, 0, 0}, {1, 0, 0}}, 30), Limits(6, 200)).size(), 2u);
}

TEST(ChooseSources, BoundsDepthsWithAMargin) {
  const auto choices = ChooseSources(WallSeenFrom({{0, 0, 0}, {1, 0, 0}}, 60), Limits(6, 200));
  const SourceChoice& choice = choices.at(PhotoId{1});
  EXPECT_LT(choice.min_depth, 9);
  EXPECT_GT(choice.min_depth, 5);
  EXPECT_GT(choice.max_depth, 11);
  EXPECT_LT(choice.max_depth, 20);
}

TEST(ChooseSources, SeedsAreInPixelsOfTheReducedPhoto) {
  const Reconstruction r = WallSeenFrom({{0, 0, 0}, {1, 0, 0}}, 60);
  const SourceChoice choice = ChooseSources(r, Limits(6, 100)).at(PhotoId{2});
  const RegisteredImage& photo = r.photos.at(PhotoId{2});
  ASSERT_EQ(choice.seeds.size(), photo.observations.size());
  for (size_t i = 0; i < choice.seeds.size(); ++i) {
    // Half the size, and the middle of the first pixel at 0 instead of 0.5.
    EXPECT_NEAR(choice.seeds[i].x, photo.observations[i].pixel.x() / 2 - 0.5, 1e-3);
    EXPECT_NEAR(choice.seeds[i].y, photo.observations[i].pixel.y() / 2 - 0.5, 1e-3);
    const Eigen::Vector3d& p = r.points.at(photo.observations[i].point).position;
    EXPECT_NEAR(choice.seeds[i].depth, p.z(), 1e-4);
  }
}

}  // namespace
}  // namespace stucco::test
