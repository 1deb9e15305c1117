// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace stucco {
namespace {

const std::vector<Camera>& AllModels() {
  static const std::vector<Camera> cameras = {
      {CameraId{1}, CameraModel::kSimplePinhole, 1600, 1200, {1000, 800, 600}},
      {CameraId{2}, CameraModel::kPinhole, 1600, 1200, {1000, 900, 800, 600}},
      {CameraId{3}, CameraModel::kSimpleRadial, 1600, 1200, {1000, 800, 600, 0.1}},
      {CameraId{4}, CameraModel::kRadial, 1600, 1200, {1000, 800, 600, 0.1, 0.2}},
      {CameraId{5}, CameraModel::kOpenCv, 1600, 1200, {1000, 900, 800, 600, 0.1, 0.2, 0.01, 0.02}},
      {CameraId{6},
       CameraModel::kFullOpenCv,
       1600,
       1200,
       {1000, 900, 800, 600, 0.1, 0.2, 0.01, 0.02, 0.3, 0.01, 0.02, 0.04}},
  };
  return cameras;
}

TEST(Camera, DistortsByHandComputedValues) {
  // Ray (0.1, 0.2): r^2 = 0.05, r^4 = 0.0025, r^6 = 0.000125.
  const Eigen::Vector2d ray(0.1, 0.2);
  const double rational = (1 + 0.005 + 0.0005 + 0.0000375) / (1 + 0.0005 + 0.00005 + 0.000005);
  const std::vector<Eigen::Vector2d> bent = {
      {0.1, 0.2},
      {0.1, 0.2},
      {0.1005, 0.201},
      {0.10055, 0.2011},
      // tangential: x 2 p1 x y + p2 (r^2 + 2 x^2) = 0.0004 + 0.0014, y 0.0013 + 0.0008
      {0.10055 + 0.0018, 0.2011 + 0.0021},
      {0.1 * rational + 0.0018, 0.2 * rational + 0.0021},
  };
  for (size_t i = 0; i < AllModels().size(); ++i) {
    const Camera& camera = AllModels()[i];
    const Eigen::Vector2d pixel = camera.Distort(ray);
    EXPECT_NEAR(pixel.x(), camera.FocalX() * bent[i].x() + 800, 1e-10) << Name(camera.model);
    EXPECT_NEAR(pixel.y(), camera.FocalY() * bent[i].y() + 600, 1e-10) << Name(camera.model);
  }
}

TEST(Camera, UnprojectInvertsProjectForEveryModel) {
  for (const Camera& camera : AllModels()) {
    ASSERT_FALSE(FindProblem(camera)) << *FindProblem(camera);
    for (double x = -0.75; x <= 0.75; x += 0.125) {
      for (double y = -0.6; y <= 0.6; y += 0.1) {
        const auto pixel = camera.Project({2 * x, 2 * y, 2});
        ASSERT_TRUE(pixel);
        const auto ray = camera.Unproject(*pixel);
        ASSERT_TRUE(ray) << Name(camera.model) << " " << x << " " << y;
        EXPECT_NEAR(ray->x(), x, 1e-9) << Name(camera.model);
        EXPECT_NEAR(ray->y(), y, 1e-9) << Name(camera.model);
      }
    }
  }
}

TEST(Camera, UnprojectInvertsStrongBarrelUpToItsTurn) {
  // r (1 - r^2 / 2) turns at r = sqrt(2 / 3) = 0.816, where it reaches 0.544.
  const Camera camera = {CameraId{1}, CameraModel::kSimpleRadial, 1000, 1000, {1000, 0, 0, -0.5}};
  for (double r = 0; r < 0.81; r += 0.01) {
    const auto ray = camera.Unproject(camera.Distort({r, 0}));
    ASSERT_TRUE(ray) << r;
    EXPECT_NEAR(ray->x(), r, 1e-7);
  }
  EXPECT_TRUE(camera.IsInvertibleAt({0.81, 0}));
  EXPECT_FALSE(camera.IsInvertibleAt({0.82, 0}));
  EXPECT_FALSE(camera.IsInvertibleAt({0, -2}));
  EXPECT_FALSE(camera.Unproject({545, 0}));
  EXPECT_FALSE(camera.Unproject({1000, 1000}));
}

TEST(Camera, IsNotInvertibleBehindATurnThatRisesAgain) {
  // d/dr = 1 - 3.6 r^2 + 3 r^4 is negative from r = 0.66 to 0.87 and positive at 1.
  const Camera camera = {CameraId{1}, CameraModel::kRadial, 1000, 1000, {1000, 0, 0, -1.2, 0.6}};
  EXPECT_TRUE(camera.IsInvertibleAt({0.6, 0}));
  EXPECT_FALSE(camera.IsInvertibleAt({0.75, 0}));
  EXPECT_FALSE(camera.IsInvertibleAt({1, 0}));
}

TEST(Camera, IsNotInvertibleBehindAPole) {
  Camera camera = AllModels().back();
  camera.params = {1000, 1000, 0, 0, 0, 0, 0, 0, 0, -2, 0, 0};  // 1 - 2 r^2 below the line
  EXPECT_TRUE(camera.IsInvertibleAt({0.5, 0}));
  EXPECT_FALSE(camera.IsInvertibleAt({0.9, 0}));
}

TEST(Camera, ProjectsNothingFromBehindOrNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Camera& camera : AllModels()) {
    EXPECT_FALSE(camera.Project({0, 0, 0}));
    EXPECT_FALSE(camera.Project({0.1, 0.1, -1}));
    EXPECT_FALSE(camera.Project({0.1, 0.1, nan}));
    EXPECT_FALSE(camera.Unproject({nan, 10}));
  }
}

TEST(Camera, ContainsItsPixels) {
  const Camera& camera = AllModels()[1];
  EXPECT_TRUE(camera.Contains({0, 0}));
  EXPECT_TRUE(camera.Contains({1599.999, 1199.999}));
  EXPECT_FALSE(camera.Contains({1600, 10}));
  EXPECT_FALSE(camera.Contains({-0.001, 10}));
  EXPECT_FALSE(camera.Contains({std::nan(""), 10}));
}

TEST(Camera, ResizedSeesTheSameRays) {
  for (const Camera& camera : AllModels()) {
    for (const auto& [width, height] : {std::pair(800, 600), std::pair(401, 299)}) {
      const Camera small = Resized(camera, width, height);
      ASSERT_FALSE(FindProblem(small)) << *FindProblem(small);
      EXPECT_EQ(small.width_px, width);
      EXPECT_EQ(small.height_px, height);
      for (const Eigen::Vector2d& ray : {Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-0.1, 0.4)}) {
        const Eigen::Vector2d full = camera.Distort(ray);
        const Eigen::Vector2d pixel = small.Distort(ray);
        EXPECT_NEAR(pixel.x(), full.x() * width / 1600, 1e-9) << Name(camera.model);
        EXPECT_NEAR(pixel.y(), full.y() * height / 1200, 1e-9) << Name(camera.model);
      }
    }
  }
}

TEST(Camera, ResizedKeepsTheModelWhenAxesScaleAlike) {
  for (const Camera& camera : AllModels()) {
    EXPECT_EQ(Resized(camera, 800, 600).model, camera.model);
  }
  EXPECT_EQ(Resized(AllModels()[0], 800, 601).model, CameraModel::kPinhole);
  EXPECT_EQ(Resized(AllModels()[3], 800, 601).model, CameraModel::kOpenCv);
}

TEST(Camera, SaysWhatEachParameterIs) {
  for (const Camera& camera : AllModels()) {
    const auto names = ParameterNames(camera.model);
    const auto kinds = ParameterKinds(camera.model);
    ASSERT_EQ(kinds.size(), names.size()) << Name(camera.model);
    for (size_t i = 0; i < names.size(); ++i) {
      const bool is_late = names[i].size() == 2 && names[i][1] >= '3';  // k3 ... k6
      const ParameterKind expected = names[i].starts_with("f")   ? ParameterKind::kFocalLength
                                     : names[i].starts_with("c") ? ParameterKind::kPrincipalPoint
                                     : names[i].starts_with("p") ? ParameterKind::kTangential
                                     : is_late                   ? ParameterKind::kRational
                                                                 : ParameterKind::kRadial;
      EXPECT_EQ(kinds[i], expected) << Name(camera.model) << " " << names[i];
    }
  }
}

TEST(CameraDeathTest, RequiresTheParametersOfItsModel) {
  Camera camera = AllModels()[4];
  camera.params.pop_back();
  EXPECT_DEATH(camera.Distort({0.1, 0.2}), "p.size\\(\\) == 8");
}

TEST(Camera, FindsProblems) {
  const Camera good = AllModels()[4];
  EXPECT_FALSE(FindProblem(good));
  Camera bad = good;
  bad.params.pop_back();
  EXPECT_EQ(FindProblem(bad), "OPENCV has 8 parameters, not 7");
  bad = good;
  bad.params[1] = 0;
  EXPECT_EQ(FindProblem(bad), "focal length is not positive");
  bad = good;
  bad.params[6] = std::nan("");
  EXPECT_EQ(FindProblem(bad), "p1 is not finite");
  bad = good;
  bad.height_px = 0;
  EXPECT_EQ(FindProblem(bad), "size is 1600 x 0");
}

TEST(Camera, NamesAndNumbersAreThoseOfColmap) {
  for (const Camera& camera : AllModels()) {
    EXPECT_EQ(CameraModelFromName(Name(camera.model)), camera.model);
    EXPECT_EQ(CameraModelFromNumber(static_cast<int>(camera.model)), camera.model);
    EXPECT_EQ(ParameterNames(camera.model).size(), camera.params.size());
  }
  EXPECT_EQ(CameraModelFromNumber(6), CameraModel::kFullOpenCv);
  EXPECT_EQ(Name(CameraModel::kFullOpenCv), "FULL_OPENCV");
  EXPECT_FALSE(CameraModelFromNumber(5));
  EXPECT_FALSE(CameraModelFromName("OPENCV_FISHEYE"));
  EXPECT_FALSE(CameraModelFromName("pinhole"));
}

}  // namespace
}  // namespace stucco
