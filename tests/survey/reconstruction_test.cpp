// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/reconstruction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/survey/support.h"

namespace stucco {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

TEST(Reconstruction, AcceptsAWholeOne) {
  const Reconstruction whole = test::MakeReconstruction();
  EXPECT_FALSE(FindProblem(whole)) << *FindProblem(whole);
  EXPECT_FALSE(FindProblem(Reconstruction()));
}

TEST(Reconstruction, FindsEachProblem) {
  const auto problem_after = [](const auto& damage) {
    Reconstruction r = test::MakeReconstruction();
    damage(r);
    return FindProblem(r);
  };
  EXPECT_THAT(problem_after([](Reconstruction& r) { r.cameras.at(CameraId{1}).params[0] = -1; }),
              Optional(HasSubstr("camera 1: focal length")));
  EXPECT_THAT(problem_after([](Reconstruction& r) { r.cameras.erase(CameraId{7}); }),
              Optional(HasSubstr("uses camera 7, which is missing")));
  EXPECT_THAT(problem_after([](Reconstruction& r) { r.photos.at(PhotoId{2}).id = PhotoId{9}; }),
              Optional(HasSubstr("photo 2 is stored under another id")));
  EXPECT_THAT(problem_after([](Reconstruction& r) {
                r.photos.at(PhotoId{2}).name = r.photos.at(PhotoId{1}).name;
              }),
              Optional(HasSubstr("two photos are named")));
  EXPECT_THAT(problem_after([](Reconstruction& r) {
                r.photos.at(PhotoId{2}).cam_from_world.rotation.coeffs() *= 2;
              }),
              Optional(HasSubstr("has no valid pose")));
  EXPECT_THAT(problem_after([](Reconstruction& r) {
                r.photos.at(PhotoId{1}).observations[0].pixel.x() = std::nan("");
              }),
              Optional(HasSubstr("observation 0 is not finite")));
  EXPECT_THAT(problem_after([](Reconstruction& r) { r.points.erase(PointId{10}); }),
              Optional(HasSubstr("observation 0 is of point 10, which is missing")));
  EXPECT_THAT(
      problem_after([](Reconstruction& r) { r.points.at(PointId{11}).track[0].observation = 99; }),
      Optional(HasSubstr("point 11 is observation 99 of photo 1, which has 5")));
  EXPECT_THAT(
      problem_after([](Reconstruction& r) { r.points.at(PointId{11}).track[0].observation = 0; }),
      Optional(HasSubstr("says otherwise")));
  EXPECT_THAT(problem_after([](Reconstruction& r) {
                auto& track = r.points.at(PointId{11}).track;
                track.push_back(track[0]);
              }),
              Optional(HasSubstr("lists an observation twice")));
  EXPECT_THAT(problem_after([](Reconstruction& r) { r.points.at(PointId{11}).track.pop_back(); }),
              Optional(HasSubstr("11 observations have a point, but tracks list 10")));
  EXPECT_THAT(problem_after(
                  [](Reconstruction& r) { r.points.at(PointId{12}).position.z() = std::nan(""); }),
              Optional(HasSubstr("point 12 has no finite position")));
}

TEST(Reconstruction, MeasuresErrorAndTracks) {
  Reconstruction r = test::MakeReconstruction();
  EXPECT_NEAR(MeanReprojectionError(r), 0, 1e-10);
  EXPECT_DOUBLE_EQ(MeanTrackLength(r), 11.0 / 4);
  // One of eleven observations is 5 pixels off.
  r.photos.at(PhotoId{1}).observations[0].pixel += Eigen::Vector2d(3, -4);
  EXPECT_NEAR(MeanReprojectionError(r), 5.0 / 11, 1e-10);
  EXPECT_EQ(MeanReprojectionError({}), 0);
  EXPECT_EQ(MeanTrackLength({}), 0);
}

TEST(Reconstruction, TransformKeepsEveryPicture) {
  Reconstruction r = test::MakeReconstruction();
  const Eigen::Vector3d before = r.points.at(PointId{10}).position;
  const Similarity new_from_old = {
      3, Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitY())), {100, -20, 5}};
  Transform(new_from_old, r);
  EXPECT_FALSE(FindProblem(r));
  EXPECT_NEAR(MeanReprojectionError(r), 0, 1e-9);
  EXPECT_NEAR((r.points.at(PointId{10}).position - new_from_old * before).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace stucco
