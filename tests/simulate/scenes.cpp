// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/simulate/scenes.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace stucco::test {

int AddMaterial(simulate::Scene& scene, const simulate::Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

int AddTexture(simulate::Scene& scene, const Image& image) {
  scene.textures.push_back(image);
  simulate::Material material;
  material.texture = static_cast<int>(scene.textures.size()) - 1;
  return AddMaterial(scene, material);
}

void AddQuad(simulate::Scene& scene, const Quad& quad, int material, const std::string& element,
             float repeats) {
  const auto named = std::find(scene.elements.begin(), scene.elements.end(), element);
  const auto number = static_cast<int>(named - scene.elements.begin());
  if (named == scene.elements.end()) scene.elements.push_back(element);
  const auto first = static_cast<int>(scene.positions.size());
  for (const Eigen::Vector2f& uv : {Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 0),
                                    Eigen::Vector2f(1, 1), Eigen::Vector2f(0, 1)}) {
    scene.positions.push_back(quad.top_left + uv.x() * quad.right + uv.y() * quad.down);
    scene.uv.push_back(repeats * uv);
  }
  for (const Eigen::Vector3i& corners : {Eigen::Vector3i(0, 3, 2), Eigen::Vector3i(0, 2, 1)}) {
    scene.triangles.emplace_back(corners.array() + first);
    scene.materials_of.push_back(material);
    scene.elements_of.push_back(number);
  }
}

void AddBox(simulate::Scene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
            int material, const std::string& element) {
  const Eigen::Vector3f size = high - low;
  const Eigen::Vector3f x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  AddQuad(scene, {low + z, x, -z}, material, element);           // south
  AddQuad(scene, {low + z + x, y, -z}, material, element);       // east
  AddQuad(scene, {low + z + x + y, -x, -z}, material, element);  // north
  AddQuad(scene, {low + z + y, -y, -z}, material, element);      // west
  AddQuad(scene, {low + z + y, x, -y}, material, element);       // top
  AddQuad(scene, {low, x, y}, material, element);                // bottom
}

Image Checkerboard(int columns, int rows, int square_px) {
  Image image{columns * square_px, rows * square_px, 3, {}};
  image.data.resize(size_t{3} * image.width_px * image.height_px);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const bool white = (x / square_px + y / square_px) % 2 != 0;
      std::fill_n(image.Pixel(x, y), 3, white ? 255 : 0);
    }
  }
  return image;
}

Image Plain(uint8_t value) {
  return {1, 1, 3, {value, value, value}};
}

Pose LookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& up) {
  const Eigen::Vector3d forward = (to - from).normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  Eigen::Matrix3d cam_from_world;
  cam_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  Pose pose;
  pose.rotation = Eigen::Quaterniond(cam_from_world);
  pose.translation = -(cam_from_world * from);
  return pose;
}

Camera Pinhole(int width_px, int height_px, double focal_px) {
  Camera camera;
  camera.model = CameraModel::kPinhole;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.params = {focal_px, focal_px, width_px / 2.0, height_px / 2.0};
  return camera;
}

}  // namespace stucco::test
