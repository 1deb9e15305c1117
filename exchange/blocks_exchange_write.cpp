// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <pugixml.hpp>
#include <sstream>

#include "exchange/blocks_exchange.h"
#include "exchange/brown_lens.h"
#include "exchange/internal/blocks_exchange_photos.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// Version 2.1 has focal lengths in millimetres only; those of a full-frame sensor are as good as
// any, and readable.
constexpr double kSensor_mm = 36;

void Put(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

void Put(pugi::xml_node parent, const char* name, double number) {
  Put(parent, name, fmt::format("{:.17g}", number));
}

template <typename Integer>
void PutInteger(pugi::xml_node parent, const char* name, Integer number) {
  Put(parent, name, std::to_string(number));
}

void PutVector(pugi::xml_node parent, const char* name, const Eigen::Vector3d& vector) {
  pugi::xml_node node = parent.append_child(name);
  Put(node, "x", vector.x());
  Put(node, "y", vector.y());
  Put(node, "z", vector.z());
}

void PutPixel(pugi::xml_node node, const Eigen::Vector2d& pixel) {
  Put(node, "x", pixel.x() - kPixelCentre);
  Put(node, "y", pixel.y() - kPixelCentre);
}

void RequireBrown(const BrownLens& lens, const Camera& camera) {
  if (lens.k4 == 0 && lens.k5 == 0 && lens.k6 == 0) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("camera {} ({}) has k4, k5 or k6, which BlocksExchange does not know",
                          camera.id.value, Name(camera.model)),
              "calibrate with another lens model (stucco calib SURVEY --camera-model OPENCV), or "
              "export colmap-txt");
}

void PutCamera(const Camera& camera, pugi::xml_node group) {
  const BrownLens lens = LensWithNames(camera);
  RequireBrown(lens, camera);
  Put(group, "Name", fmt::format("camera {}", camera.id.value));
  pugi::xml_node dimensions = group.append_child("ImageDimensions");
  PutInteger(dimensions, "Width", camera.width_px);
  PutInteger(dimensions, "Height", camera.height_px);
  Put(group, "CameraModelType", "Perspective");
  const int longer_px = std::max(camera.width_px, camera.height_px);
  Put(group, "SensorSize", kSensor_mm);
  Put(group, "FocalLength", lens.fx * kSensor_mm / longer_px);
  Put(group, "CameraOrientation", "XRightYDown");
  PutPixel(group.append_child("PrincipalPoint"), {lens.cx, lens.cy});
  pugi::xml_node distortion = group.append_child("Distortion");
  Put(distortion, "K1", lens.k1);
  Put(distortion, "K2", lens.k2);
  Put(distortion, "K3", lens.k3);
  // Brown's order, see the reader.
  Put(distortion, "P1", lens.p2);
  Put(distortion, "P2", lens.p1);
  if (lens.fx != lens.fy) Put(group, "AspectRatio", lens.fy / lens.fx);
}

void PutPose(const Pose& cam_from_world, const Eigen::Vector3d& file_from_world,
             pugi::xml_node photo) {
  pugi::xml_node pose = photo.append_child("Pose");
  pugi::xml_node rotation = pose.append_child("Rotation");
  const Eigen::Matrix3d matrix = cam_from_world.rotation.toRotationMatrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      Put(rotation, fmt::format("M_{}{}", row, column).c_str(), matrix(row, column));
    }
  }
  PutVector(pose, "Center", cam_from_world.Center() + file_from_world);
}

void PutSystems(const Georef& georef, pugi::xml_node root) {
  pugi::xml_node srs = root.append_child("SpatialReferenceSystems").append_child("SRS");
  Put(srs, "Id", "0");
  Put(srs, "Name", "Local east, north, up");
  Put(srs, "Definition",
      fmt::format("ENU:{:.17g},{:.17g}", georef.origin_latitude_deg, georef.origin_longitude_deg));
}

void PutTiePoint(const TrackPoint& point, const Reconstruction& model,
                 const Eigen::Vector3d& file_from_world, pugi::xml_node parent) {
  pugi::xml_node tie = parent.append_child("TiePoint");
  pugi::xml_node color = tie.append_child("Color");
  Put(color, "Red", point.rgb[0] / 255.0);
  Put(color, "Green", point.rgb[1] / 255.0);
  Put(color, "Blue", point.rgb[2] / 255.0);
  PutVector(tie, "Position", point.position + file_from_world);
  for (const TrackElement& element : point.track) {
    pugi::xml_node measurement = tie.append_child("Measurement");
    PutInteger(measurement, "PhotoId", element.photo.value);
    PutPixel(measurement, model.photos.at(element.photo).observations[element.observation].pixel);
  }
}

void PutBlock(const ModelToWrite& what, const fs::path& folder, pugi::xml_node block) {
  // The file's frame has its zero on the ellipsoid, in so far as the survey's heights are above it.
  const bool is_enu = what.georef.frame == "enu";
  const Eigen::Vector3d file_from_world(0, 0, is_enu ? what.georef.origin_height_m : 0);
  Put(block, "Name", "Stucco");
  if (is_enu) Put(block, "SRSId", "0");
  pugi::xml_node groups = block.append_child("Photogroups");
  for (const auto& [id, camera] : what.model.cameras) {
    pugi::xml_node group = groups.append_child("Photogroup");
    PutCamera(camera, group);
    for (const auto& [photo_id, photo] : what.model.photos) {
      if (photo.camera != id) continue;
      pugi::xml_node node = group.append_child("Photo");
      PutInteger(node, "Id", photo_id.value);
      Put(node, "ImagePath", PathFrom(folder, what, photo));
      Put(node, "Component", "1");
      PutPose(photo.cam_from_world, file_from_world, node);
    }
  }
  pugi::xml_node points = block.append_child("TiePoints");
  for (const auto& [id, point] : what.model.points) {
    PutTiePoint(point, what.model, file_from_world, points);
  }
}

}  // namespace

void WriteBlocksExchange(const ModelToWrite& what, const fs::path& file) {
  assert(!FindProblem(what.model));
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "utf-8";
  pugi::xml_node root = document.append_child("BlocksExchange");
  root.append_attribute("version") = "2.1";
  if (what.georef.frame == "enu") PutSystems(what.georef, root);
  PutBlock(what, file.parent_path(), root.append_child("Block"));
  std::ostringstream text;
  document.save(text, "  ");
  WriteFileAtomically(file, text.str());
}

}  // namespace stucco
