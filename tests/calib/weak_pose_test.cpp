// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/weak_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(WhyWeak, SaysWhatIsMissing) {
  EXPECT_EQ(WhyWeak(0.04, 50, 0.01), "");
  EXPECT_THAT(WhyWeak(0.01, 49, 0.01), HasSubstr("only 49 points"));
  EXPECT_THAT(WhyWeak(0.07, 500, 0.01), HasSubstr("7 times less sure"));
  EXPECT_THAT(WhyWeak(-1, 500, 0.01), HasSubstr("could not be computed"));
}

TEST(WeakPoses, AreThoseOfRegisteredPhotosThatLittleHolds) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 300});
  std::vector<PoseSigma> sigmas(6, {.position = 0.01, .rotation_rad = 0.001});
  EXPECT_THAT(WeakPoses(scene, sigmas), IsEmpty());
  sigmas[1].position = 0.06;
  sigmas[2].position = 0.06;
  scene.photos[2].pose.reset();
  int left = 49;
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& element : track.elements) {
      if (element.photo == 2) element.used = false;
      if (element.photo == 4 && element.used && left-- <= 0) element.used = false;
    }
  }
  EXPECT_THAT(WeakPoses(scene, sigmas), ElementsAre(1, 4));
}

}  // namespace
}  // namespace stucco::test
