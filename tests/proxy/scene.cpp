// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/proxy/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "survey/geometry2d.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

// The generator's distributions differ between libraries; these do not.
class Dice {
 public:
  explicit Dice(uint64_t seed) : engine_(seed) {}
  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double Normal() {
    const double u = 1 - Uniform(0, 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * Uniform(0, 1));
  }
  Vector3d Direction() { return Vector3d(Normal(), Normal(), Normal()).normalized(); }

 private:
  std::mt19937_64 engine_;
};

struct Frame {
  Vector3d origin, u, v, normal;
  Ring ring;
};

Frame FrameOfPolygon(const TruePolygon& polygon) {
  Frame frame;
  Vector3d normal = Vector3d::Zero();
  for (size_t i = 1; i + 1 < polygon.ring.size(); ++i) {
    normal += (polygon.ring[i] - polygon.ring[0]).cross(polygon.ring[i + 1] - polygon.ring[0]);
  }
  frame.normal = normal.normalized();
  frame.origin = polygon.ring[0];
  frame.u = (polygon.ring[1] - polygon.ring[0]).normalized();
  frame.v = frame.normal.cross(frame.u);
  for (const auto& p : polygon.ring) {
    frame.ring.emplace_back(frame.u.dot(p - frame.origin), frame.v.dot(p - frame.origin));
  }
  return frame;
}

bool Blocks(const Frame& frame, const Vector3d& eye, const Vector3d& point) {
  const double de = frame.normal.dot(eye - frame.origin);
  const double dp = frame.normal.dot(point - frame.origin);
  if (de * dp >= 0 || std::abs(dp) < 1e-6) return false;
  const Vector3d hit = eye + de / (de - dp) * (point - eye);
  return Contains(frame.ring, {frame.u.dot(hit - frame.origin), frame.v.dot(hit - frame.origin)});
}

Pose LookAt(const Vector3d& center, const Vector3d& target) {
  const Vector3d forward = (target - center).normalized();
  return PoseOf(center, forward, forward.cross(Vector3d::UnitZ()).normalized());
}

std::vector<SurveyPhoto> PlacePhotos(bool front_only) {
  std::vector<SurveyPhoto> photos;
  const auto add = [&](const Pose& cam_from_world) {
    SurveyPhoto& photo = photos.emplace_back();
    photo.id = {static_cast<uint32_t>(photos.size())};
    photo.captured.path = "p" + std::to_string(photos.size());
    photo.cam_from_world = cam_from_world;
  };
  if (front_only) {
    for (int i = 0; i < 9; ++i) {
      const double x = -16 + 4.0 * i;
      add(LookAt({x, -22 + 0.05 * x * x, 1.7}, {0.3 * x, 0, 4.5}));
    }
    return photos;
  }
  for (const double height : {6.0, 22.0}) {
    for (int i = 0; i < 12; ++i) {
      const double angle = 2 * std::numbers::pi * i / 12;
      add(LookAt({30 * std::cos(angle), 30 * std::sin(angle), height}, {0, 0, 3}));
    }
  }
  return photos;
}

TruePolygon Polygon(std::string name, std::vector<Vector3d> ring) {
  return {std::move(name), std::move(ring)};
}

void AddPoint(const Vector3d& position, const Vector3d& normal, std::vector<uint32_t> views,
              PointCloud& cloud) {
  cloud.positions.push_back(position);
  cloud.normals.push_back(normal.cast<float>());
  cloud.colors.push_back({128, 128, 128});
  cloud.views.push_back(std::move(views));
}

void SamplePolygon(const std::vector<Frame>& blockers, const Frame& frame,
                   const CaptureOptions& options, Dice& dice, Captured& captured) {
  constexpr double kNormalNoise = 0.17;  // radians, 10 degrees
  Eigen::AlignedBox2d box;
  for (const auto& p : frame.ring) box.extend(p);
  for (double x = box.min().x() + options.spacing / 2; x < box.max().x(); x += options.spacing) {
    for (double y = box.min().y() + options.spacing / 2; y < box.max().y(); y += options.spacing) {
      const Eigen::Vector2d at(x + dice.Uniform(-0.5, 0.5) * options.spacing,
                               y + dice.Uniform(-0.5, 0.5) * options.spacing);
      const double push = options.noise * dice.Normal();
      const Vector3d tilt = kNormalNoise * dice.Normal() * dice.Direction();
      if (!Contains(frame.ring, at)) continue;
      const Vector3d exact = frame.origin + at.x() * frame.u + at.y() * frame.v;
      std::vector<uint32_t> views;
      for (const SurveyPhoto& photo : captured.photos) {
        const Vector3d eye = photo.cam_from_world.Center();
        const Vector3d ray = (eye - exact).normalized();
        if (views.size() == 3 || ray.dot(frame.normal) < 0.15) continue;
        if (std::none_of(blockers.begin(), blockers.end(),
                         [&](const Frame& other) { return Blocks(other, eye, exact); })) {
          views.push_back(photo.id.value);
        }
      }
      if (views.size() < 2) continue;
      AddPoint(exact + push * frame.normal, (frame.normal + tilt).normalized(), views,
               captured.cloud);
    }
  }
}

}  // namespace

ProxyInput InputOf(const Captured& captured, const Georef& georef) {
  return {StreamOf(captured.cloud), captured.photos, georef};
}

Pose PoseOf(const Vector3d& center, const Vector3d& forward, const Vector3d& right) {
  Eigen::Matrix3d cam_from_world;
  cam_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  Pose pose;
  pose.rotation = Eigen::Quaterniond(cam_from_world);
  pose.translation = -(pose.rotation * center);
  return pose;
}

House BoxHouse(double length, double width, double height, const Vector3d& corner) {
  const double x0 = corner.x() - length / 2, x1 = corner.x() + length / 2;
  const double y0 = corner.y() - width / 2, y1 = corner.y() + width / 2;
  const double z0 = corner.z(), z1 = corner.z() + height;
  return {{Polygon("south", {{x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1}}),
           Polygon("east", {{x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1}}),
           Polygon("north", {{x1, y1, z0}, {x0, y1, z0}, {x0, y1, z1}, {x1, y1, z1}}),
           Polygon("west", {{x0, y1, z0}, {x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}}),
           Polygon("roof", {{x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}})}};
}

House GableHouse(double length, double width, double height, double ridge) {
  const double x = length / 2, y = width / 2, h = height, r = ridge;
  return {{Polygon("south", {{-x, -y, 0}, {x, -y, 0}, {x, -y, h}, {-x, -y, h}}),
           Polygon("east", {{x, -y, 0}, {x, y, 0}, {x, y, h}, {x, 0, r}, {x, -y, h}}),
           Polygon("north", {{x, y, 0}, {-x, y, 0}, {-x, y, h}, {x, y, h}}),
           Polygon("west", {{-x, y, 0}, {-x, -y, 0}, {-x, -y, h}, {-x, 0, r}, {-x, y, h}}),
           Polygon("south roof", {{-x, -y, h}, {x, -y, h}, {x, 0, r}, {-x, 0, r}}),
           Polygon("north roof", {{x, y, h}, {-x, y, h}, {-x, 0, r}, {x, 0, r}})}};
}

House LShapedHouse(double length, double width, double height) {
  const double x = length / 2, y = width / 2, h = height;
  const std::vector<Eigen::Vector2d> corners = {{-x, -y}, {x, -y}, {x, 0}, {0, 0}, {0, y}, {-x, y}};
  House house;
  TruePolygon roof{.name = "roof", .ring = {}};
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    house.polygons.push_back(
        Polygon("wall " + std::to_string(i),
                {{a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), h}, {a.x(), a.y(), h}}));
    roof.ring.emplace_back(a.x(), a.y(), h);
  }
  house.polygons.push_back(roof);
  return house;
}

TruePolygon GroundSquare(double half, double z) {
  return Polygon("ground",
                 {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
}

Captured Capture(const std::vector<House>& houses, const std::vector<TruePolygon>& others,
                 const CaptureOptions& options) {
  Captured captured;
  captured.photos = PlacePhotos(options.front_only);
  std::vector<Frame> frames;
  std::vector<std::string> names;
  const auto add = [&](const TruePolygon& polygon) {
    frames.push_back(FrameOfPolygon(polygon));
    names.push_back(polygon.name);
  };
  for (const House& house : houses) {
    for (const TruePolygon& polygon : house.polygons) add(polygon);
  }
  for (const TruePolygon& polygon : others) add(polygon);
  Dice dice(options.seed);
  Eigen::AlignedBox3d box;
  for (size_t i = 0; i < frames.size(); ++i) {
    for (const auto& p : frames[i].ring) {
      box.extend(frames[i].origin + p.x() * frames[i].u + p.y() * frames[i].v);
    }
    if (std::find(options.hide.begin(), options.hide.end(), names[i]) != options.hide.end()) {
      continue;
    }
    SamplePolygon(frames, frames[i], options, dice, captured);
  }
  const auto strays = static_cast<int>(options.outliers * double(captured.cloud.size()));
  for (int i = 0; i < strays; ++i) {
    const Vector3d p =
        box.min() + Vector3d(dice.Uniform(0, 1), dice.Uniform(0, 1), dice.Uniform(0, 1))
                        .cwiseProduct(box.sizes());
    AddPoint(p, dice.Direction(), {1, 2}, captured.cloud);
  }
  return captured;
}

void AddTree(const Vector3d& center, double radius, int count, uint64_t seed, Captured& captured) {
  Dice dice(seed);
  for (int i = 0; i < count; ++i) {
    const Vector3d p = center + radius * std::cbrt(dice.Uniform(0, 1)) * dice.Direction();
    AddPoint(p, dice.Direction(), {1, 2}, captured.cloud);
  }
}

void EraseIf(const std::function<bool(const Eigen::Vector3d&)>& gone, Captured& captured) {
  PointCloud& cloud = captured.cloud;
  size_t kept = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    if (gone(cloud.positions[i])) continue;
    cloud.positions[kept] = cloud.positions[i];
    cloud.normals[kept] = cloud.normals[i];
    cloud.colors[kept] = cloud.colors[i];
    cloud.views[kept++] = cloud.views[i];
  }
  cloud.positions.resize(kept);
  cloud.normals.resize(kept);
  cloud.colors.resize(kept);
  cloud.views.resize(kept);
}

void MoveTo(const Eigen::Matrix3d& rotation, double scale, const Vector3d& translation,
            Captured& captured) {
  const Eigen::Matrix3f rotation_f = rotation.cast<float>();
  for (auto& p : captured.cloud.positions) p = scale * (rotation * p) + translation;
  for (auto& n : captured.cloud.normals) n = rotation_f * n;
  const Similarity new_from_old{scale, Eigen::Quaterniond(rotation), translation};
  for (SurveyPhoto& photo : captured.photos) {
    photo.cam_from_world = Transformed(photo.cam_from_world, new_from_old);
  }
}

Eigen::Vector4d PlaneOf(const TruePolygon& polygon) {
  const Frame frame = FrameOfPolygon(polygon);
  Eigen::Vector4d plane;
  plane << frame.normal, frame.normal.dot(frame.origin);
  return plane;
}

}  // namespace stucco::test
