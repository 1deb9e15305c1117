// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/nerfstudio.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cassert>
#include <nlohmann/json.hpp>

#include "exchange/brown_lens.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/ply.h"
#include "survey/point_cloud.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr char kPoints[] = "sparse_pc.ply";

void PutLens(const Camera& camera, OrderedJson& json) {
  const BrownLens lens = LensWithNames(camera);
  if (lens.k4 != 0 || lens.k5 != 0 || lens.k6 != 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("camera {} ({}) has k4, k5 or k6, which nerfstudio does not know",
                            camera.id.value, Name(camera.model)),
                "calibrate with another lens model (stucco calib SURVEY --camera-model OPENCV), or "
                "export colmap-txt");
  }
  json["w"] = camera.width_px;
  json["h"] = camera.height_px;
  json["fl_x"] = lens.fx;
  json["fl_y"] = lens.fy;
  json["cx"] = lens.cx;
  json["cy"] = lens.cy;
  json["k1"] = lens.k1;
  json["k2"] = lens.k2;
  if (lens.k3 != 0) json["k3"] = lens.k3;
  json["p1"] = lens.p1;
  json["p2"] = lens.p2;
}

OrderedJson Rows(const Eigen::Matrix4d& matrix, int rows) {
  OrderedJson json = OrderedJson::array();
  for (int row = 0; row < rows; ++row) {
    json.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  }
  return json;
}

Eigen::Matrix4d AsMatrix(const Pose& pose) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = pose.translation;
  return matrix;
}

// Viewers turn about z.
Eigen::Matrix4d FileFromWorld(const Georef& georef) {
  Pose turn;
  if (georef.frame != "enu" && georef.up) {
    turn.rotation = Eigen::Quaterniond::FromTwoVectors(*georef.up, Eigen::Vector3d::UnitZ());
  }
  return AsMatrix(turn);
}

OrderedJson Frame(const ModelToWrite& what, const RegisteredImage& photo, const fs::path& folder,
                  const Eigen::Matrix4d& file_from_world) {
  const Eigen::Matrix4d cam_from_opengl = Eigen::Vector4d(1, -1, -1, 1).asDiagonal();
  OrderedJson json;
  json["file_path"] = PathFrom(folder, what, photo);
  json["transform_matrix"] =
      Rows(file_from_world * AsMatrix(photo.cam_from_world.Inverse()) * cam_from_opengl, 4);
  return json;
}

void WritePoints(const Reconstruction& model, const Eigen::Matrix4d& file_from_world,
                 const fs::path& path) {
  PointCloud cloud;
  for (const auto& [id, point] : model.points) {
    cloud.positions.push_back((file_from_world * point.position.homogeneous()).head<3>());
    cloud.colors.push_back(point.rgb);
  }
  WritePly(cloud, path);
}

}  // namespace

void WriteNerfstudio(const ModelToWrite& what, const fs::path& folder) {
  assert(!FindProblem(what.model));
  const bool is_shared = what.model.cameras.size() == 1;
  const Eigen::Matrix4d file_from_world = FileFromWorld(what.georef);
  OrderedJson json;
  json["camera_model"] = "OPENCV";
  if (is_shared) PutLens(what.model.cameras.begin()->second, json);
  json["applied_transform"] = Rows(file_from_world, 3);
  if (!what.model.points.empty()) json["ply_file_path"] = kPoints;
  OrderedJson& frames = json["frames"] = OrderedJson::array();
  for (const auto& [id, photo] : what.model.photos) {
    OrderedJson frame = Frame(what, photo, folder, file_from_world);
    if (!is_shared) PutLens(what.model.cameras.at(photo.camera), frame);
    frames.push_back(std::move(frame));
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (!what.model.points.empty()) WritePoints(what.model, file_from_world, folder / kPoints);
  WriteFileAtomically(folder / "transforms.json", json.dump(2) + "\n");
}

}  // namespace stucco
