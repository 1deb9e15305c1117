// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/wall_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/features/descriptors.h"
#include "calib/features/matches.h"
#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// Smooth blobs of many sizes at random places, grey, drawn once with 1 cm a pixel.
class Pattern {
 public:
  Pattern() : values_(static_cast<size_t>(kColumns) * kRows, 128.0f) {
    Random random(7);
    for (int i = 0; i < 2500; ++i) {
      const double u = random.Uniform(0, kColumns);
      const double v = random.Uniform(0, kRows);
      Add(u, v, 3 * std::pow(10, random.Uniform(0, 1)), random.Uniform(-90, 90));
    }
  }
  double At(double along_m, double z_m) const {
    const int column = std::clamp(static_cast<int>(100 * along_m), 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(100 * z_m), 0, kRows - 1);
    return std::clamp(values_[static_cast<size_t>(row) * kColumns + column], 0.0f, 255.0f);
  }

 private:
  static constexpr int kColumns = 2000;
  static constexpr int kRows = 1200;

  void Add(double u, double v, double size, double height) {
    const int reach = static_cast<int>(4 * size);
    const int middle_x = static_cast<int>(u);
    const int middle_y = static_cast<int>(v);
    for (int y = std::max(0, middle_y - reach); y < std::min(kRows, middle_y + reach); ++y) {
      for (int x = std::max(0, middle_x - reach); x < std::min(kColumns, middle_x + reach); ++x) {
        const double squares = ((x - u) * (x - u) + (y - v) * (y - v)) / (size * size);
        values_[static_cast<size_t>(y) * kColumns + x] +=
            static_cast<float>(height * std::exp(-squares / 2));
      }
    }
  }
  std::vector<float> values_;
};

// The first house's south wall (y = 0), 20 by 12 m, photographed; black elsewhere.
Image Photograph(const Pattern& pattern, const Camera& camera, const Pose& pose) {
  Image image{camera.width_px, camera.height_px, 3, {}};
  image.data.assign(static_cast<size_t>(camera.width_px) * camera.height_px * 3, 0);
  const Pose world = pose.Inverse();
  constexpr int kSamples = 2;  // per pixel and axis
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      double sum = 0;
      for (int s = 0; s < kSamples * kSamples; ++s) {
        const Eigen::Vector2d pixel(x + (s % kSamples + 0.5) / kSamples,
                                    y + (s / kSamples + 0.5) / kSamples);
        const Vector3d way = world.rotation * camera.Unproject(pixel)->homogeneous();
        const double reach = -world.translation.y() / way.y();
        const Vector3d at = world.translation + reach * way;
        const bool on_wall = reach > 0 && at.x() > 0 && at.x() < 20 && at.z() > 0 && at.z() < 12;
        sum += on_wall ? pattern.At(at.x(), at.z()) : 0;
      }
      std::fill_n(image.Pixel(x, y), 3, static_cast<uint8_t>(sum / (kSamples * kSamples)));
    }
  }
  return image;
}

struct Shot {
  Camera camera = SiteCamera();
  Pose truth;
  WallView view;  // with the pose that is expected
  Features on_wall;
  std::vector<OnWall> places;
  Features plain;
};

// `off` is what the expected position is wrong by.
Shot Take(const Pattern& pattern, const Pose& truth, const Vector3d& off) {
  Shot shot;
  shot.camera = {CameraId{1}, CameraModel::kPinhole, 400, 300, {280, 280, 200, 150}};
  shot.truth = truth;
  shot.view = {TwoHouses().facades[0], {-1, 21}, {-1, 13}, truth};
  shot.view.cam_from_plan.translation = -(truth.rotation * (truth.Center() + off));
  const Image image = Photograph(pattern, shot.camera, truth);
  shot.on_wall = DetectOnWall(image, shot.camera, shot.view, 2000);
  shot.places = PlacesOnWall(shot.on_wall, shot.camera, shot.view);
  shot.plain = DetectFeatures(image, {400, 300}, {0, 2000});
  return shot;
}

// Where a pixel of the photo really is on the wall.
Vector3d Truth(const Shot& shot, const Keypoint& k) {
  const Pose world = shot.truth.Inverse();
  const Vector3d way = world.rotation * shot.camera.Unproject({k.x, k.y})->homogeneous();
  return world.translation - world.translation.y() / way.y() * way;
}

// Matches that join the same place, within 10 cm.
int NumRight(const Shot& a, const Features& of_a, const Shot& b, const Features& of_b,
             const std::vector<Match>& matches) {
  return static_cast<int>(std::ranges::count_if(matches, [&](const Match& m) {
    return (Truth(a, of_a.keypoints[m.first]) - Truth(b, of_b.keypoints[m.second])).norm() < 0.1;
  }));
}

class WallFeatures : public testing::Test {
 protected:
  Pattern pattern_;
  // Level from 14 m; from above under 60 degrees, with the record 1.5 m off.
  Shot frontal_ = Take(pattern_, SitePose({10, -14, 6}, 0, 0), Vector3d::Zero());
  Shot tilted_ = Take(pattern_, SitePose({11, -9, 22}, 0, -60), {1, 0.7, -0.8});
};

TEST_F(WallFeatures, MatchWherePlainOnesDoNot) {
  const auto plain =
      MatchDescriptors(UnitDescriptors(frontal_.plain), UnitDescriptors(tilted_.plain), 0.8);
  const auto on_wall = MatchOnWall({UnitDescriptors(frontal_.on_wall), frontal_.places},
                                   {UnitDescriptors(tilted_.on_wall), tilted_.places}, 4, 0.8);
  const int plain_right = NumRight(frontal_, frontal_.plain, tilted_, tilted_.plain, plain);
  const int right = NumRight(frontal_, frontal_.on_wall, tilted_, tilted_.on_wall, on_wall);
  EXPECT_GT(right, 60);
  EXPECT_GT(right, 3 * plain_right);
  EXPECT_GT(right, 0.8 * static_cast<double>(on_wall.size()));
}

TEST_F(WallFeatures, LieInThePhotoWhereTheyAreOnTheWall) {
  ASSERT_GT(frontal_.on_wall.size(), 100u);
  for (size_t i = 0; i < frontal_.on_wall.size(); ++i) {
    const Keypoint& k = frontal_.on_wall.keypoints[i];
    EXPECT_TRUE(frontal_.camera.Contains({k.x, k.y}));
    const Vector3d place = Truth(frontal_, k);
    EXPECT_NEAR(frontal_.places[i].along_m, place.x(), 0.01);
    EXPECT_NEAR(frontal_.places[i].z_m, place.z(), 0.01);
    EXPECT_NEAR(frontal_.places[i].scale_m, k.scale * 14 / 280, 0.5 * frontal_.places[i].scale_m);
  }
}

TEST_F(WallFeatures, MatchOnlyWithinReachAndOfLikeSize) {
  const WallKeypoints first{UnitDescriptors(frontal_.on_wall), frontal_.places};
  WallKeypoints second = first;
  EXPECT_EQ(MatchOnWall(first, second, 4, 0.8).size(), first.places.size());
  // Beyond the reach by itself, but all by the same: the record is off.
  for (OnWall& place : second.places) place.along_m += 5;
  EXPECT_GT(MatchOnWall(first, second, 4, 0.8).size(), 0.9 * first.places.size());
  for (OnWall& place : second.places) place.along_m += 7;
  EXPECT_LT(MatchOnWall(first, second, 4, 0.8).size(), first.places.size() / 20);
  second = first;
  for (OnWall& place : second.places) place.scale_m *= 100;
  EXPECT_TRUE(MatchOnWall(first, second, 4, 0.8).empty());
  EXPECT_TRUE(MatchOnWall({}, second, 4, 0.8).empty());
  EXPECT_TRUE(MatchOnWall(first, {}, 4, 0.8).empty());
}

// Descriptors with one entry each, so that equal ones are at angle 0 and others at 90 degrees.
WallKeypoints OneHot(const std::vector<int>& entries, const std::vector<float>& along_m) {
  WallKeypoints keypoints;
  for (size_t i = 0; i < entries.size(); ++i) {
    std::vector<int16_t> row(kDescriptorSize, 0);
    row[entries[i]] = static_cast<int16_t>(kDescriptorUnit);
    keypoints.descriptors.insert(keypoints.descriptors.end(), row.begin(), row.end());
    keypoints.places.push_back({along_m[i], 5, 0.1f});
  }
  return keypoints;
}

TEST(MatchOnWall, DoubtsWhatRepeatsJustBeyondItsReach) {
  const WallKeypoints first = OneHot({1, 2}, {10, 10});
  EXPECT_EQ(MatchOnWall(first, OneHot({1, 2, 3}, {11, 11, 11}), 4, 0.8).size(), 2u);
  // The first one occurs again 9 m along the wall, then 11 m.
  EXPECT_EQ(MatchOnWall(first, OneHot({1, 2, 1}, {11, 11, 19}), 4, 0.8).size(), 1u);
  EXPECT_EQ(MatchOnWall(first, OneHot({1, 2, 1}, {11, 11, 21}), 4, 0.8).size(), 2u);
  // And never matches there.
  EXPECT_EQ(MatchOnWall(OneHot({1}, {10}), OneHot({1, 2}, {19, 11}), 4, 0.8).size(), 0u);
}

// A row of windows: each of the entries every three metres.
WallKeypoints Repeating(int windows, float begin_m) {
  std::vector<int> entries;
  std::vector<float> along_m;
  for (int window = 0; window < windows; ++window) {
    for (int i = 0; i < 12; ++i) {
      entries.push_back(i);
      along_m.push_back(begin_m + 3 * static_cast<float>(window) + 0.1f * static_cast<float>(i));
    }
  }
  return OneHot(entries, along_m);
}

TEST(MatchOnWall, ChoosesNoShiftOfWhatRepeats) {
  // Each window matches the others as well as itself.
  EXPECT_TRUE(MatchOnWall(Repeating(6, 0), Repeating(6, 0.4f), 4, 0.8).empty());
  EXPECT_TRUE(MatchOnWall(Repeating(6, 0), Repeating(6, 1.5f), 4, 0.8).empty());
  // One window alone is where it is.
  EXPECT_EQ(MatchOnWall(Repeating(1, 0), Repeating(1, 1.5f), 4, 0.8).size(), 12u);
}

TEST(MatchOnWall, TakesALonelyMatchOnlyWhenItIsGood) {
  WallKeypoints second = OneHot({1}, {10});
  EXPECT_EQ(MatchOnWall(OneHot({1}, {10}), second, 4, 0.8).size(), 1u);
  // 45 degrees from the first's descriptor: the ratio has nothing to compare it with.
  second.descriptors[1] = second.descriptors[2] =
      static_cast<int16_t>(kDescriptorUnit * std::sqrt(0.5));
  EXPECT_EQ(MatchOnWall(OneHot({1}, {10}), second, 4, 0.8).size(), 0u);
}

TEST_F(WallFeatures, OfALongWallFitTheMemoryOfAPhoto) {
  // A wall of 3 km whose nearest part is 5 m away would have a raster of 170 000 columns.
  WallView view = frontal_.view;
  view.wall.a_m = {-1500, 0};
  view.wall.b_m = {1500, 0};
  view.along_m = {0, 3000};
  view.cam_from_plan = SitePose({10, -5, 6}, 0, 0);
  const Image image = Photograph(pattern_, frontal_.camera, view.cam_from_plan);
  EXPECT_LE(DetectOnWall(image, frontal_.camera, view, 2000).size(), 2000u);
}

TEST_F(WallFeatures, AreNoneOfAWallThatThePhotoDoesNotShow) {
  const Image image = Photograph(pattern_, frontal_.camera, frontal_.truth);
  WallView view = frontal_.view;
  view.cam_from_plan = SitePose({10, -14, 6}, 180, 0);
  EXPECT_EQ(DetectOnWall(image, frontal_.camera, view, 2000).size(), 0u);
}

}  // namespace
}  // namespace stucco::test
