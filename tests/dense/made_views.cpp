// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dense/made_views.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stucco::test {
namespace {

double Lattice(int x, int y, int octave) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9E3779B1u ^ static_cast<uint32_t>(y) * 0x85EBCA77u ^
               static_cast<uint32_t>(octave) * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return (h ^ (h >> 15)) * 0x1p-32;
}

// Smooth noise between 0 and 1 with cells of one unit.
double ValueNoise(double x, double y, int octave) {
  const int ix = static_cast<int>(std::floor(x));
  const int iy = static_cast<int>(std::floor(y));
  const double fx = x - ix;
  const double fy = y - iy;
  const double sx = fx * fx * (3 - 2 * fx);
  const double sy = fy * fy * (3 - 2 * fy);
  const double top = std::lerp(Lattice(ix, iy, octave), Lattice(ix + 1, iy, octave), sx);
  const double bottom = std::lerp(Lattice(ix, iy + 1, octave), Lattice(ix + 1, iy + 1, octave), sx);
  return std::lerp(top, bottom, sy);
}

// Pixels are 2.5 cm at five metres.
double Texture(double u, double v) {
  double value = 128;
  int octave = 0;
  for (const double cell : {0.6, 0.3, 0.15, 0.07}) {
    value += 70 * (ValueNoise(u / cell + 100, v / cell + 100, octave++) - 0.5);
  }
  return value;
}

double GrayAt(const PinholeCamera& view, const std::vector<MadePlane>& planes, double x, double y) {
  const auto hit = FirstHit(view, planes, x, y);
  if (!hit) return 128;
  const Eigen::Vector3d in_cam((x - view.cx) / view.fx * hit->depth,
                               (y - view.cy) / view.fy * hit->depth, hit->depth);
  const Eigen::Vector3d world =
      view.rotation.cast<double>().transpose() * (in_cam - view.translation);
  const Eigen::Vector3d offset = world - hit->plane->center;
  return Texture(offset.dot(hit->plane->u), offset.dot(hit->plane->v));
}

}  // namespace

Camera SmallCamera() {
  return {CameraId{1}, CameraModel::kPinhole, 200, 150, {200, 200, 100, 75}};
}

std::optional<Hit> FirstHit(const PinholeCamera& view, const std::vector<MadePlane>& planes,
                            double x, double y) {
  const Eigen::Matrix3d world_from_cam = view.rotation.cast<double>().transpose();
  const Eigen::Vector3d origin = -(world_from_cam * view.translation);
  const Eigen::Vector3d ray =
      world_from_cam * Eigen::Vector3d((x - view.cx) / view.fx, (y - view.cy) / view.fy, 1);
  std::optional<Hit> first;
  for (const MadePlane& plane : planes) {
    const double along = plane.Normal().dot(ray);
    if (std::abs(along) < 1e-9) continue;
    const double depth = plane.Normal().dot(plane.center - origin) / along;
    const Eigen::Vector3d offset = origin + depth * ray - plane.center;
    if (depth <= 0.01 || std::abs(offset.dot(plane.u)) > plane.half_width ||
        std::abs(offset.dot(plane.v)) > plane.half_height) {
      continue;
    }
    if (!first || depth < first->depth) first = Hit{depth, &plane};
  }
  return first;
}

Image Render(const PinholeCamera& view, const std::vector<MadePlane>& planes) {
  Image image{view.width, view.height, 3, {}};
  image.data.resize(size_t{3} * view.width * view.height);
  constexpr int kSamples = 3;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      double sum = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        sum += GrayAt(view, planes, x + (i % kSamples - 1) / 3.0, y + (i / kSamples - 1) / 3.0);
      }
      const double gray = sum / (kSamples * kSamples);
      std::fill_n(image.Pixel(x, y), 3, static_cast<uint8_t>(std::clamp(gray + 0.5, 0.0, 255.0)));
    }
  }
  return image;
}

DepthMap TrueDepths(const PinholeCamera& view, const std::vector<MadePlane>& planes) {
  DepthMap map = EmptyDepthMap(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto hit = FirstHit(view, planes, x, y);
      if (!hit) continue;
      const size_t index = map.Index(x, y);
      map.depths[index] = static_cast<float>(hit->depth);
      map.costs[index] = 0;
      Eigen::Vector3f normal = view.rotation * hit->plane->Normal().cast<float>();
      if (normal.dot(view.Ray(static_cast<float>(x), static_cast<float>(y))) > 0) normal = -normal;
      for (int k = 0; k < 3; ++k) {
        map.normals[index][k] = static_cast<int8_t>(std::lround(normal[k] * 127));
      }
    }
  }
  return map;
}

MadePlane SlantedWall() {
  return {{0, 0, 5},
          Eigen::Vector3d(1, 0, 0.45).normalized(),
          Eigen::Vector3d(0.08, 1, -0.18).normalized()};
}

std::vector<MadePlane> TwoWalls() {
  // The walls start at x = 0, z = 4.5 and run away to both sides.
  const Eigen::Vector3d left = Eigen::Vector3d(-1, 0, 0.6).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d(1, 0, 0.6).normalized();
  const Eigen::Vector3d edge(0, 0, 4.5);
  return {{edge + 2.5 * left, left, Eigen::Vector3d::UnitY(), 2.5, 3},
          {edge + 2.5 * right, right, Eigen::Vector3d::UnitY(), 2.5, 3}};
}

std::vector<Pose> PosesAround(int count) {
  const std::vector<Eigen::Vector3d> places = {
      {0, 0, 0}, {0.7, 0.1, 0}, {-0.7, -0.1, 0.1}, {0.1, -0.6, 0}, {-0.1, 0.6, 0.1}};
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d forward = (Eigen::Vector3d(0, 0, 5) - places[i]).normalized();
    Pose pose;
    pose.rotation = Eigen::Quaterniond::FromTwoVectors(forward, Eigen::Vector3d::UnitZ());
    pose.translation = -(pose.rotation * places[i]);
    poses.push_back(pose);
  }
  return poses;
}

std::shared_ptr<const ViewPyramid> MadePyramid(const Pose& pose,
                                               const std::vector<MadePlane>& planes) {
  auto pyramid = std::make_shared<ViewPyramid>();
  pyramid->cameras = PinholeLevels(SmallCamera(), pose, 0, 3);
  pyramid->color = Render(pyramid->cameras[0], planes);
  for (const PinholeCamera& view : pyramid->cameras) {
    const Image image = Render(view, planes);
    std::vector<uint8_t> gray;
    for (size_t i = 0; i < image.data.size(); i += 3) gray.push_back(image.data[i]);
    pyramid->images.push_back(Pack(view.width, view.height, std::move(gray)));
  }
  return pyramid;
}

}  // namespace stucco::test
