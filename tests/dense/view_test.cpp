// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "dense/internal/source_geometry.h"
#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

TEST(Pack, PutsFourNeighboursIntoOneWord) {
  const PackedImage image = Pack(3, 2, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(image.quads[0], 0x05040201u);
  EXPECT_EQ(image.quads[1], 0x06050302u);
  EXPECT_EQ(image.quads[2], 0x06060303u);  // the right edge repeats
  EXPECT_EQ(image.quads[3], 0x05040504u);  // and so does the bottom
  EXPECT_EQ(image.quads[5], 0x06060606u);
  EXPECT_EQ(image.gray, (std::vector<uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(Pack(1, 1, {9}).quads, std::vector<uint32_t>{0x09090909u});
}

Camera DistortedCamera() {
  return {CameraId{1},
          CameraModel::kOpenCv,
          400,
          300,
          {350, 352, 205, 148, -0.12, 0.03, 0.001, -0.002}};
}

TEST(PinholeLevels, ProjectAsTheCameraDoes) {
  Camera camera = DistortedCamera();
  camera.params = {350, 352, 205, 148, 0, 0, 0, 0};
  const Pose pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {1, 2, 3}};
  const auto levels = PinholeLevels(camera, pose, 200, 3);
  ASSERT_EQ(levels.size(), 3u);
  const Eigen::Vector2d ray(0.2, -0.1);
  const Eigen::Vector2d pixel = camera.Distort(ray);  // pixel centres at + 0.5
  double share = 1;
  for (size_t level = 0; level < 3; ++level) {
    share /= 2;
    const PinholeCamera& view = levels[level];
    EXPECT_EQ(view.width, 400 >> (level + 1));
    EXPECT_EQ(view.height, 300 >> (level + 1));
    // Uneven sizes lose up to a pixel when they are halved.
    const double tolerance = level == 2 ? 0.3 : 1e-3;
    EXPECT_NEAR(view.fx * ray.x() + view.cx, pixel.x() * share - 0.5, tolerance);
    EXPECT_NEAR(view.fy * ray.y() + view.cy, pixel.y() * share - 0.5, tolerance);
    EXPECT_EQ(view.translation, pose.translation);
  }
}

TEST(PinholeLevels, NeverReachSizeZero) {
  for (const PinholeCamera& view : PinholeLevels(DistortedCamera(), {}, 4, 6)) {
    EXPECT_GE(view.width, 1);
    EXPECT_GE(view.height, 1);
    EXPECT_GT(view.fx, 0);
  }
}

double Pattern(double x, double y) {
  return 128 + 55 * std::sin(9 * x) + 55 * std::sin(8 * y + 1);
}

// The pattern as a camera with distortion sees it.
Image DistortedPicture(const Camera& camera) {
  Image image{camera.width_px, camera.height_px, 3, {}};
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const auto ray = camera.Unproject({x + 0.5, y + 0.5});
      const auto gray = static_cast<uint8_t>(Pattern(ray->x(), ray->y()));
      image.data.insert(image.data.end(), {gray, gray, gray});
    }
  }
  return image;
}

SurveyPhoto DistortedPhoto(const std::string& path) {
  SurveyPhoto photo;
  photo.captured.path = path;
  photo.camera = DistortedCamera();
  return photo;
}

TEST(LoadView, TakesTheDistortionOut) {
  const TemporaryFolder folder;
  WriteImage(DistortedPicture(DistortedCamera()), folder / "photo.jpg", 98);
  for (const int max_px : {400, 200}) {
    const auto pyramid = LoadView(folder.path(), DistortedPhoto("photo.jpg"), max_px, 3);
    ASSERT_EQ(pyramid->cameras.size(), 3u);
    ASSERT_EQ(pyramid->images.size(), 3u);
    EXPECT_EQ(pyramid->color.width_px, max_px);
    for (size_t level = 0; level < 3; ++level) {
      const PinholeCamera& view = pyramid->cameras[level];
      const PackedImage& image = pyramid->images[level];
      ASSERT_EQ(image.width, view.width);
      ASSERT_EQ(image.gray.size(), static_cast<size_t>(view.width) * view.height);
      double sum = 0;
      int count = 0;
      for (int y = view.height / 10; y < view.height * 9 / 10; ++y) {
        for (int x = view.width / 10; x < view.width * 9 / 10; ++x) {
          const Eigen::Vector3f ray = view.Ray(static_cast<float>(x), static_cast<float>(y));
          sum += std::abs(image.gray[static_cast<size_t>(y) * view.width + x] -
                          Pattern(ray.x(), ray.y()));
          ++count;
        }
      }
      // Half a pixel of shift would be 3 grey levels at full size and more when reduced.
      EXPECT_LT(sum / count, 1.2 + 1.2 * static_cast<double>(level)) << max_px << " " << level;
    }
  }
}

TEST(LoadView, NamesADamagedPhoto) {
  const TemporaryFolder folder;
  WriteFile(folder / "broken.jpg", "not a picture");
  for (const std::string path : {"broken.jpg", "gone.jpg"}) {
    ExpectBadInput([&] { LoadView(folder.path(), DistortedPhoto(path), 200, 3); }, path);
  }
}

TEST(SourceGeometry, TakesPointsOfAPlaneToTheSource) {
  const Pose a{Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())), {0.1, 0.2, 0}};
  const Pose b{Eigen::Quaterniond(Eigen::AngleAxisd(-0.2, Eigen::Vector3d(1, 1, 0).normalized())),
               {-0.8, 0.1, 0.3}};
  const PinholeCamera reference = PinholeLevels(DistortedCamera(), a, 400, 1)[0];
  const PinholeCamera source = PinholeLevels(DistortedCamera(), b, 200, 1)[0];
  const SourceGeometry geometry(reference, source);
  const Eigen::Vector3f normal = Eigen::Vector3f(0.3f, 0.1f, -1).normalized();
  const DepthPlane plane = PlaneAcross(reference, 200, 150, 6, normal);
  const Eigen::Vector3f point = reference.Ray(200, 150) * 6;
  const PatchWarp warp = geometry.Warp(plane, 200, 150);
  for (const auto& [dx, dy] :
       {std::pair{-150.f, -110.f}, std::pair{0.f, 0.f}, std::pair{133.f, -129.f}}) {
    const Eigen::Vector3f ray = reference.Ray(200 + dx, 150 + dy);
    const Eigen::Vector3d in_reference =
        (ray * (normal.dot(point) / normal.dot(ray))).cast<double>();
    const Eigen::Vector3d in_source = b * (a.Inverse() * in_reference);
    const auto along = [&](int k) { return warp.at[k] + warp.right[k] * dx + warp.down[k] * dy; };
    EXPECT_NEAR(along(0) / along(2), source.fx * in_source.x() / in_source.z() + source.cx, 1e-2);
    EXPECT_NEAR(along(1) / along(2), source.fy * in_source.y() / in_source.z() + source.cy, 1e-2);
  }
}

TEST(DepthPlane, KeepsDepthAndNormal) {
  const PinholeCamera view = PinholeLevels(DistortedCamera(), {}, 400, 1)[0];
  const Eigen::Vector3f normal = Eigen::Vector3f(0.4f, -0.3f, -1).normalized();
  for (const auto& [x, y] : {std::pair{200, 150}, std::pair{3, 290}, std::pair{390, 10}}) {
    const DepthPlane plane = PlaneAcross(view, x, y, 7, normal);
    EXPECT_FLOAT_EQ(plane.depth(), 7);
    EXPECT_LT((AwayNormal(view, x, y, plane).normalized() + normal).norm(), 1e-5);
    // What the plane's neighbours see lies on it too.
    const Eigen::Vector3f here =
        view.Ray(static_cast<float>(x), static_cast<float>(y)) * plane.depth();
    const Eigen::Vector3f there =
        view.Ray(static_cast<float>(x + 9), static_cast<float>(y - 4)) / plane.At(9, -4);
    EXPECT_NEAR(normal.dot(there - here), 0, 1e-4);
    EXPECT_LT((AwayNormal(view, x, y, plane.MovedTo(0.2f)).normalized() + normal).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace stucco::test
