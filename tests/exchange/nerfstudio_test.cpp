// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/nerfstudio.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "survey/files.h"
#include "survey/point_cloud.h"
#include "tests/exchange/made_model.h"
#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using Json = nlohmann::json;

Eigen::Matrix4d MatrixOf(const Json& rows) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (size_t row = 0; row < rows.size(); ++row) {
    for (size_t column = 0; column < 4; ++column) {
      matrix(static_cast<int>(row), static_cast<int>(column)) = rows[row][column];
    }
  }
  return matrix;
}

class NerfstudioTest : public testing::Test {
 protected:
  Json Written() {
    const auto folder = photos.root / "photos";
    WriteNerfstudio({model, georef, folder}, photos.root / "out");
    return Json::parse(ReadFile(photos.root / "out/transforms.json"));
  }

  RowOfPhotos photos;
  Reconstruction model = MadeModel();
  Georef georef = MadePlace();
};

// The view of RowOfPhotos: columns are the camera's right, up and back, and its place.
TEST_F(NerfstudioTest, APoseIsWhatTheDocumentSays) {
  RegisteredImage photo;
  photo.id = PhotoId{1};
  photo.camera = CameraId{2};
  photo.name = "sub/c.jpg";
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  photo.cam_from_world.rotation = Eigen::Quaterniond(rotation);
  photo.cam_from_world.translation = -(rotation * Eigen::Vector3d(1, 2, 3));
  model.photos = {{photo.id, photo}};
  model.points.clear();
  model.cameras.erase(CameraId{1});
  const Json json = Written();
  Eigen::Matrix4d expected;
  expected << 0, 0, -1, 1, -1, 0, 0, 2, 0, 1, 0, 3, 0, 0, 0, 1;
  EXPECT_LT((MatrixOf(json["frames"][0]["transform_matrix"]) - expected).norm(), 1e-12);
  EXPECT_EQ(MatrixOf(json["applied_transform"]), Eigen::Matrix4d::Identity());
  EXPECT_EQ(json["frames"][0]["file_path"], "../photos/sub/c.jpg");
  EXPECT_EQ(json["camera_model"], "OPENCV");
  EXPECT_EQ(json["fl_x"], 173.1);
  EXPECT_EQ(json["fl_y"], 173.1);
  EXPECT_EQ(json["cx"], 99.1);
  EXPECT_EQ(json["k2"], -0.01);
  EXPECT_FALSE(json.contains("ply_file_path"));
}

// A reader of its own, with OpenGL's axes and the model OPENCV, sees what we see.
TEST_F(NerfstudioTest, EveryPointIsSeenWhereItWas) {
  georef = Georef();
  georef.up = Eigen::Vector3d(0, -1, 0);
  const Json json = Written();
  const Eigen::Matrix4d applied = MatrixOf(json["applied_transform"]);
  EXPECT_LT((applied * Eigen::Vector4d(0, -1, 0, 0) - Eigen::Vector4d::UnitZ()).norm(), 1e-12);
  const PointCloud cloud = ReadPly(photos.root / "out" / json["ply_file_path"].get<std::string>());
  ASSERT_EQ(cloud.size(), model.points.size());
  auto photo = model.photos.begin();
  for (const Json& frame : json["frames"]) {
    const Eigen::Matrix4d opengl_from_file = MatrixOf(frame["transform_matrix"]).inverse();
    auto point = model.points.begin();
    for (const Eigen::Vector3d& position : cloud.positions) {
      const Eigen::Vector4d at = opengl_from_file * position.homogeneous();
      const double x = at.x() / -at.z(), y = at.y() / at.z(), s = x * x + y * y;
      const double k3 = frame.value("k3", 0.0), p1 = frame["p1"], p2 = frame["p2"];
      const double r =
          1 + s * (frame["k1"].get<double>() + s * (frame["k2"].get<double>() + s * k3));
      const Eigen::Vector2d seen(
          frame["fl_x"].get<double>() * (x * r + 2 * p1 * x * y + p2 * (s + 2 * x * x)) +
              frame["cx"].get<double>(),
          frame["fl_y"].get<double>() * (y * r + p1 * (s + 2 * y * y) + 2 * p2 * x * y) +
              frame["cy"].get<double>());
      EXPECT_LT((seen - PixelIn(model, photo->second.name, point->second.position)).norm(), 1e-9);
      ++point;
    }
    ++photo;
  }
}

TEST_F(NerfstudioTest, ALensThatTheFormatDoesNotKnowIsRefused) {
  model.cameras.at(CameraId{1}).params.back() = 0.1;
  EXPECT_THAT(RefusalOf([&] { Written(); }).what(), testing::HasSubstr("k4, k5 or k6"));
}

}  // namespace
}  // namespace stucco
