// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/texture/synthetic.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace stucco::test {
namespace {

constexpr int kRays = 2;  // a pixel side

double Hash(int a, int b, int c) {
  uint32_t h = static_cast<uint32_t>(a) * 374761393u + static_cast<uint32_t>(b) * 668265263u +
               static_cast<uint32_t>(c) * 2246822519u;
  h = (h ^ (h >> 13)) * 1274126177u;
  return static_cast<double>(h ^ (h >> 16)) / 4294967295.0;
}

}  // namespace

Facet MakeWall(double width, double height) {
  Facet facet;
  facet.id = "B0001/W01";
  facet.normal = -Eigen::Vector3d::UnitY();
  facet.outer = {{0, 0, 0}, {width, 0, 0}, {width, 0, height}, {0, 0, height}};
  facet.area = width * height;
  facet.source = "planes";
  return facet;
}

Proxy MakeProxy(const std::vector<Facet>& facets) {
  Proxy proxy;
  proxy.metric = true;
  proxy.buildings = {{"B0001", false, "cloud", "", facets}};
  return proxy;
}

Colour WallColour(double x, double z) {
  const int column = static_cast<int>(std::floor(x / 0.35));
  const int row = static_cast<int>(std::floor(z / 0.3));
  const double wave = 18 * std::sin(9 * x + 3 * std::sin(5 * z)) * std::sin(11 * z);
  Colour colour;
  for (int k = 0; k < 3; ++k) colour[k] = 70 + 90 * Hash(column, row, k) + wave;
  // A dark frame in every other block, as windows have.
  const double fx = x / 0.35 - column;
  const double fz = z / 0.3 - row;
  const double rim = std::min({fx, 1 - fx, fz, 1 - fz});
  if ((column + row) % 2 == 0 && rim > 0.15 && rim < 0.3) colour *= 0.45;
  return colour;
}

SurveyPhoto LookFrom(const std::string& name, const Eigen::Vector3d& position,
                     const Eigen::Vector3d& target, const Pinhole& camera) {
  SurveyPhoto photo;
  photo.captured.path = name;
  photo.captured.hash = name;
  photo.camera.id = {1};
  photo.camera.model = CameraModel::kPinhole;
  photo.camera.width_px = camera.width_px;
  photo.camera.height_px = camera.height_px;
  photo.camera.params = {camera.focal_px, camera.focal_px, camera.width_px / 2.0,
                         camera.height_px / 2.0};
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d cam_from_world;
  cam_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  photo.cam_from_world.rotation = Eigen::Quaterniond(cam_from_world);
  photo.cam_from_world.translation = -(photo.cam_from_world.rotation * position);
  return photo;
}

Scene WallScene(double width, double height) {
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& way) -> std::optional<Colour> {
    const double distance = -from.y() / way.y();
    if (!(distance > 0)) return std::nullopt;
    const Eigen::Vector3d point = from + distance * way;
    if (point.x() < 0 || point.x() > width || point.z() < 0 || point.z() > height) {
      return std::nullopt;
    }
    return WallColour(point.x(), point.z());
  };
}

Scene DiscScene(const Eigen::Vector3d& center, double radius, const Scene& behind) {
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& way) -> std::optional<Colour> {
    const double distance = (center.y() - from.y()) / way.y();
    if (distance > 0 && (from + distance * way - center).norm() < radius) {
      return Colour(220, 20, 20);
    }
    return behind(from, way);
  };
}

Colour BalconyColour(double x, double z) {
  return WallColour(x + 1.1, z + 1.7);
}

Scene BalconyScene(const Balcony& balcony, const Scene& behind) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(balcony.low.x(), -balcony.depth, balcony.low.y()),
                                Eigen::Vector3d(balcony.high.x(), 0, balcony.high.y()));
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& way) -> std::optional<Colour> {
    const Eigen::Array3d to_low = (box.min() - from).array() / way.array();
    const Eigen::Array3d to_high = (box.max() - from).array() / way.array();
    int side = 0;
    const double enter = to_low.min(to_high).maxCoeff(&side);
    const double leave = to_low.max(to_high).minCoeff();
    if (!(enter > 0 && enter < leave)) return behind(from, way);
    const Eigen::Vector3d point = from + enter * way;
    return side == 1 ? BalconyColour(point.x(), point.z()) : Colour::Constant(110);
  };
}

Image Render(const SurveyPhoto& photo, const Scene& scene, double exposure) {
  Image image;
  image.width_px = photo.camera.width_px;
  image.height_px = photo.camera.height_px;
  image.data.resize(static_cast<size_t>(3) * image.width_px * image.height_px);
  const Eigen::Vector3d from = photo.cam_from_world.Center();
  const Eigen::Quaterniond world_from_cam = photo.cam_from_world.rotation.conjugate();
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      Colour sum = Colour::Zero();
      for (int ray = 0; ray < kRays * kRays; ++ray) {
        const Eigen::Vector2d pixel(x + (ray % kRays + 0.5) / kRays,
                                    y + (ray / kRays + 0.5) / kRays);
        const auto direction = photo.camera.Unproject(pixel);
        if (!direction) throw std::runtime_error("the test camera cannot be inverted");
        const Eigen::Vector3d way = world_from_cam * direction->homogeneous();
        sum += scene(from, way).value_or(Colour(128, 128, 128));
      }
      sum *= exposure / (kRays * kRays);
      for (int k = 0; k < 3; ++k) {
        image.Pixel(x, y)[k] = static_cast<uint8_t>(std::clamp(sum[k] + 0.5, 0.0, 255.0));
      }
    }
  }
  return image;
}

Image WallPicture(const TexelGrid& grid, const std::optional<Balcony>& balcony) {
  const auto colour_at = [&](double x, double z) {
    const bool before = balcony && x > balcony->low.x() && x < balcony->high.x() &&
                        z > balcony->low.y() && z < balcony->high.y();
    return before ? BalconyColour(x, z) : WallColour(x, z);
  };
  Image image;
  image.width_px = grid.width;
  image.height_px = grid.height;
  image.data.resize(3 * grid.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      Colour sum = Colour::Zero();
      for (int part = 0; part < kRays * kRays; ++part) {
        const Eigen::Vector3d point =
            grid.At(x + (part % kRays + 0.5) / kRays, y + (part / kRays + 0.5) / kRays);
        sum += colour_at(point.x(), point.z()) / (kRays * kRays);
      }
      for (int k = 0; k < 3; ++k) {
        image.Pixel(x, y)[k] = static_cast<uint8_t>(std::clamp(sum[k] + 0.5, 0.0, 255.0));
      }
    }
  }
  return image;
}

double Psnr(const Image& a, const Image& b, const std::vector<uint8_t>& mask) {
  if (a.data.size() != b.data.size()) return 0;
  double sum = 0;
  double count = 0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    if (!mask.empty() && !mask[i / 3]) continue;
    const double difference = static_cast<double>(a.data[i]) - b.data[i];
    sum += difference * difference;
    ++count;
  }
  return 10 * std::log10(255.0 * 255.0 * count / std::max(1e-9, sum));
}

}  // namespace stucco::test
