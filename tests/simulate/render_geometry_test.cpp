// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "simulate/render/renderer.h"
#include "tests/simulate/scenes.h"

namespace stucco::simulate {
namespace {

using test::LookAt;

constexpr int kColumns = 16;
constexpr int kRows = 12;
constexpr double kSquare_m = 0.25;

// A board upright at y = 0, its front to the south, with its middle at the origin.
Scene BoardScene() {
  Scene scene;
  const int material = test::AddTexture(scene, test::Checkerboard(kColumns, kRows, 25));
  const auto width = static_cast<float>(kColumns * kSquare_m);
  const auto height = static_cast<float>(kRows * kSquare_m);
  test::AddQuad(scene, {{-width / 2, 0, height / 2}, {width, 0, 0}, {0, 0, -height}}, material);
  return scene;
}

std::vector<Eigen::Vector3d> BoardCorners() {
  std::vector<Eigen::Vector3d> corners;
  for (int r = 1; r < kRows; ++r) {
    for (int c = 1; c < kColumns; ++c) {
      corners.emplace_back((c - kColumns / 2.0) * kSquare_m, 0, (kRows / 2.0 - r) * kSquare_m);
    }
  }
  return corners;
}

struct Agreement {
  int corners = 0;
  double worst_px = 0;
  cv::Point2d shift_px;  // on average
};

// Where OpenCV sees the corners, against where the camera model says they are. Even in a perfect
// picture cornerSubPix errs by up to a tenth of a pixel, so the picture is taken with three times
// the pixels, and what comes out is in pixels of the camera.
Agreement Compare(const Renderer& renderer, const Camera& usual, const Pose& cam_from_world) {
  constexpr int kFiner = 3;
  const Camera camera = Resized(usual, kFiner * usual.width_px, kFiner * usual.height_px);
  Light albedo;
  albedo.lit = false;
  const Radiance picture = renderer.Photograph(camera, cam_from_world, albedo);
  cv::Mat grey(camera.height_px, camera.width_px, CV_8UC1);
  for (size_t i = 0; i < grey.total(); ++i) {
    grey.data[i] = static_cast<uint8_t>(std::lround(20 + 200 * picture.rgb[3 * i]));
  }
  constexpr float kMargin = 20;
  std::vector<cv::Point2f> expected, found;
  for (const Eigen::Vector3d& corner : BoardCorners()) {
    const auto pixel = camera.Project(cam_from_world * corner);
    if (!pixel) continue;
    const cv::Point2f at(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()));
    if (at.x < kMargin || at.y < kMargin || at.x > static_cast<float>(camera.width_px) - kMargin ||
        at.y > static_cast<float>(camera.height_px) - kMargin) {
      continue;
    }
    expected.push_back(at - cv::Point2f(0.5f, 0.5f));  // OpenCV's pixel centres are whole numbers
  }
  found = expected;
  // Away from the answer, so that standing still is no success.
  for (cv::Point2f& point : found) point += cv::Point2f(0.4f, -0.3f);
  cv::cornerSubPix(grey, found, {6, 6}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4});
  Agreement agreement;
  for (size_t i = 0; i < found.size(); ++i) {
    const cv::Point2d error = (found[i] - expected[i]) / kFiner;
    agreement.worst_px = std::max(agreement.worst_px, cv::norm(error));
    agreement.shift_px += error / static_cast<double>(found.size());
    ++agreement.corners;
  }
  return agreement;
}

Camera With(CameraModel model, std::vector<double> distortion) {
  Camera camera = test::Pinhole(900, 700, 800);
  camera.model = model;
  camera.params = {800, 790, 455.3, 346.8};
  camera.params.insert(camera.params.end(), distortion.begin(), distortion.end());
  return camera;
}

TEST(RenderGeometry, CornersAreWhereTheCameraModelSaysThem) {
  const Renderer renderer(BoardScene());
  const std::vector<Camera> cameras = {
      With(CameraModel::kPinhole, {}), With(CameraModel::kOpenCv, {-0.28, 0.09, 0.002, -0.003}),
      With(CameraModel::kOpenCv, {0.15, -0.05, -0.004, 0.002}),
      With(CameraModel::kFullOpenCv, {-0.35, 0.12, 0.001, 0.002, -0.02, 0.05, 0.01, 0.002})};
  const std::vector<Pose> poses = {LookAt({0, -4.2, 0}, {0, 0, 0}),
                                   LookAt({1.6, -3.9, 0.9}, {0.1, 0, -0.1}),
                                   LookAt({-2.2, -3.6, -1.2}, {0, 0, 0.1}, {0.3, 0.1, 0.9})};
  for (size_t c = 0; c < cameras.size(); ++c) {
    for (size_t p = 0; p < poses.size(); ++p) {
      const Agreement agreement = Compare(renderer, cameras[c], poses[p]);
      SCOPED_TRACE(fmt::format(
          "camera {} pose {}: worst {:.4f} shift {:.4f} {:.4f} px of {} corners", c, p,
          agreement.worst_px, agreement.shift_px.x, agreement.shift_px.y, agreement.corners));
      EXPECT_GT(agreement.corners, 100);
      EXPECT_LT(agreement.worst_px, 0.05);
      EXPECT_LT(cv::norm(agreement.shift_px), 0.01);
    }
  }
}

// Nearer than the texture's resolution every pixel is the bilinear value of the texture, at the
// place that the camera's formulas give for its centre.
TEST(RenderGeometry, PixelsAreWhatTheTextureHasThere) {
  const Renderer renderer(BoardScene());
  const Image board = test::Checkerboard(kColumns, kRows, 25);
  const Camera camera = With(CameraModel::kFullOpenCv, {-0.3, 0.1, 0.001, 0.002, 0, 0.05, 0, 0});
  const Pose cam_from_world = LookAt({1.1, -3.2, 0.6}, {0.1, 0, -0.1}, {0.2, 0, 1});
  Light albedo;
  albedo.lit = false;
  const Radiance picture = renderer.Photograph(camera, cam_from_world, albedo);
  const Eigen::Vector3d centre = cam_from_world.Center();
  int compared = 0;
  for (int y = 0; y < camera.height_px; y += 3) {
    for (int x = 0; x < camera.width_px; x += 3) {
      const Eigen::Vector3d way =
          cam_from_world.rotation.conjugate() * camera.Unproject({x + 0.5, y + 0.5})->homogeneous();
      const Eigen::Vector3d place = centre - centre.y() / way.y() * way;
      const double u = (place.x() / kSquare_m + kColumns / 2.0) * 25 - 0.5;
      const double v = (kRows / 2.0 - place.z() / kSquare_m) * 25 - 0.5;
      if (u < 1 || v < 1 || u > board.width_px - 2 || v > board.height_px - 2) continue;
      const int left = static_cast<int>(u), top = static_cast<int>(v);
      const auto white = [&](int dx, int dy) {
        return board.Pixel(left + dx, top + dy)[0] / 255.0;
      };
      const double across = u - left, down = v - top;
      const double expected = (1 - down) * ((1 - across) * white(0, 0) + across * white(1, 0)) +
                              down * ((1 - across) * white(0, 1) + across * white(1, 1));
      const size_t at = 3 * (static_cast<size_t>(y) * camera.width_px + x);
      // A thousandth of a pixel on the steepest edge, which rises within a texel of two pixels.
      ASSERT_NEAR(picture.rgb[at], expected, 1e-3) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 30000);
}

TEST(RenderGeometry, DepthIsThatOfThePlane) {
  const Renderer renderer(BoardScene());
  const Camera camera = With(CameraModel::kOpenCv, {-0.2, 0.05, 0.001, -0.002});
  const Pose cam_from_world = LookAt({0.8, -4, 0.5}, {0, 0, 0});
  const DepthMap map = renderer.Depth(camera, cam_from_world);
  const Eigen::Vector3d centre = cam_from_world.Center();
  int on_board = 0;
  for (int y = 0; y < map.height; y += 7) {
    for (int x = 0; x < map.width; x += 7) {
      const auto ray = camera.Unproject({x + 0.5, y + 0.5});
      ASSERT_TRUE(ray);
      const Eigen::Vector3d way =
          cam_from_world.rotation.conjugate() * Eigen::Vector3d(ray->x(), ray->y(), 1);
      const double depth = -centre.y() / way.y();
      const Eigen::Vector3d place = centre + depth * way;
      const double inside = std::min(kColumns * kSquare_m / 2 - std::abs(place.x()),
                                     kRows * kSquare_m / 2 - std::abs(place.z()));
      const float found = map.depths[map.Index(x, y)];
      if (inside > 1e-4) {
        EXPECT_NEAR(found, depth, 1e-5);
      } else if (inside < -1e-4) {
        EXPECT_EQ(found, 0);
      }
      on_board += inside > 1e-4;
    }
  }
  EXPECT_GT(on_board, 1000);
}

TEST(RenderGeometry, PixelsOutsideTheLensAreBlack) {
  const Renderer renderer(BoardScene());
  // r (1 - r^2) turns back at r = 0.58: beyond 0.385 of the focal length there is no ray.
  const Camera camera = With(CameraModel::kOpenCv, {-1, 0, 0, 0});
  const Radiance picture = renderer.Photograph(camera, LookAt({0, -4, 0}, {0, 0, 0}), {});
  EXPECT_EQ(picture.rgb[0], 0);
  EXPECT_GT(picture.rgb[3 * (static_cast<size_t>(346) * 900 + 455)], 0);
}

// The four corners of a picture lie where the uv say: no mirrored and no turned textures.
TEST(RenderGeometry, TexturesAreUpright) {
  Scene scene;
  Image image{2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
  test::AddQuad(scene, {{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, test::AddTexture(scene, image));
  const Renderer renderer(std::move(scene));
  Light albedo;
  albedo.lit = false;
  const Radiance picture =
      renderer.Photograph(test::Pinhole(100, 100, 100), LookAt({0, -2.5, 0}, {0, 0, 0}), albedo);
  const auto at = [&](int x, int y) {
    return Eigen::Vector3f(&picture.rgb[3 * (static_cast<size_t>(y) * 100 + x)]);
  };
  EXPECT_TRUE(at(20, 20).isApprox(Eigen::Vector3f(1, 0, 0)));
  EXPECT_TRUE(at(80, 20).isApprox(Eigen::Vector3f(0, 1, 0)));
  EXPECT_TRUE(at(20, 80).isApprox(Eigen::Vector3f(0, 0, 1)));
  EXPECT_TRUE(at(80, 80).isApprox(Eigen::Vector3f(1, 1, 1)));
}

// At its own resolution and without perspective a texture comes back as it was.
TEST(RenderGeometry, FlattenReturnsTheTexture) {
  Scene scene;
  Image image{40, 30, 3, {}};
  for (int i = 0; i < 40 * 30 * 3; ++i) image.data.push_back(static_cast<uint8_t>(i * 37 % 256));
  test::AddQuad(scene, {{1, 2, 3}, {0.4f, 0, 0}, {0, 0, -0.3f}}, test::AddTexture(scene, image));
  const Renderer renderer(std::move(scene));
  PicturePlane plane;
  plane.origin = {1, 2, 3};
  plane.width_px = 40;
  plane.height_px = 30;
  Light albedo;
  albedo.lit = false;
  const Radiance picture = renderer.Flatten(plane, albedo);
  for (size_t i = 0; i < picture.rgb.size(); ++i) {
    const double value = image.data[i] / 255.0;
    const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    ASSERT_NEAR(picture.rgb[i], linear, 2e-3) << i;
  }
}

TEST(RenderGeometry, FlattenSeesOnlyWhatIsNear) {
  Scene scene;
  const int material = test::AddTexture(scene, test::Plain(255));
  test::AddQuad(scene, {{0, -2, 1}, {1, 0, 0}, {0, 0, -1}}, material, "before");
  test::AddQuad(scene, {{0, 3.5f, 1}, {1, 0, 0}, {0, 0, -1}}, material, "behind");
  const Renderer renderer(std::move(scene));
  PicturePlane plane;
  plane.origin = {0, 0, 1};
  plane.width_px = plane.height_px = 10;
  plane.from_m = 1;
  Light albedo;
  albedo.lit = false;
  EXPECT_EQ(renderer.Flatten(plane, albedo).rgb[0], 0);
  EXPECT_TRUE(std::isnan(renderer.Heights(plane)[0]));
  plane.to_m = 4;
  EXPECT_EQ(renderer.Flatten(plane, albedo).rgb[0], 1);
  EXPECT_NEAR(renderer.Heights(plane)[0], -3.5, 1e-5);
  plane.from_m = 3;
  EXPECT_NEAR(renderer.Heights(plane)[0], 2, 1e-5);
}

TEST(RenderGeometry, CastTellsElementAndNormal) {
  Scene scene;
  const int material = test::AddTexture(scene, test::Plain(255));
  test::AddBox(scene, {-1, -1, 0}, {1, 1, 2}, material, "house");
  test::AddQuad(scene, {{-9, 9, 0}, {18, 0, 0}, {0, -18, 0}}, material, "ground");
  const Renderer renderer(std::move(scene));
  const auto wall = renderer.Cast({0.3, -5, 1}, {0, 2, 0});
  ASSERT_TRUE(wall);
  EXPECT_EQ(renderer.scene().elements[wall->element], "house");
  EXPECT_NEAR(wall->distance, 4, 1e-5);
  EXPECT_LT((wall->normal - Eigen::Vector3d(0, -1, 0)).norm(), 1e-6);
  EXPECT_LT((wall->point - Eigen::Vector3d(0.3, -1, 1)).norm(), 1e-5);
  // From inside, the wall's back: its normal turns to the viewer.
  const auto inside = renderer.Cast({0.3, 0, 1}, {0, -1, 0});
  ASSERT_TRUE(inside);
  EXPECT_LT((inside->normal - Eigen::Vector3d(0, 1, 0)).norm(), 1e-6);
  EXPECT_FALSE(renderer.Cast({0, -5, 1}, {0, 0, 1}));
  EXPECT_FALSE(renderer.Cast({0, -5, 1}, {0, 0, 0}));
  EXPECT_FALSE(renderer.Cast({0, -5, std::nan("")}, {0, 0, 1}));
}

}  // namespace
}  // namespace stucco::simulate
