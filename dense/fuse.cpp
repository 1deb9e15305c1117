// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/fuse.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

struct Member {
  int photo = 0;
  size_t pixel = 0;
};

Eigen::Vector3d WorldPoint(const PinholeCamera& camera, float x, float y, float depth) {
  const Eigen::Vector3d in_cam = (camera.Ray(x, y) * depth).cast<double>();
  return camera.rotation.cast<double>().transpose() * (in_cam - camera.translation);
}

class Fusion {
 public:
  Fusion(const FuseInput& input, const FuseOptions& options)
      : input_(input), options_(options), taken_(input.ids.size()) {}

  void AddPhoto(int index) {
    Maps maps = {input_.map(index)};
    for (const int source : input_.sources[index]) maps.push_back(input_.map(source));
    const auto colors = input_.colors(index);
    const DepthMap& map = *maps[0];
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const size_t pixel = map.Index(x, y);
        if (!IsUsable(map, pixel) || IsTaken(index, pixel)) continue;
        const uint8_t* rgb = colors->color.Pixel(x, y);
        AddPixel(index, maps, x, y, {rgb[0], rgb[1], rgb[2]});
      }
    }
  }

  PointCloud Take() { return std::move(cloud_); }

 private:
  using Maps = std::vector<std::shared_ptr<const DepthMap>>;  // of a photo, then of its sources

  // A pixel of a photo and the surface that its map has there.
  struct Seen {
    const PinholeCamera& camera;
    float x = 0;
    float y = 0;
    Eigen::Vector3d point;   // world
    Eigen::Vector3f normal;  // world
  };

  bool IsUsable(const DepthMap& map, size_t pixel) const {
    return map.depths[pixel] > 0 && map.costs[pixel] <= options_.max_cost * 127;
  }

  bool IsTaken(int photo, size_t pixel) const {
    return !taken_[photo].empty() && taken_[photo][pixel];
  }

  void MarkTaken(const Member& member, size_t num_pixels) {
    if (taken_[member.photo].empty()) taken_[member.photo].assign(num_pixels, false);
    taken_[member.photo][member.pixel] = true;
  }

  // The source's pixel that shows the same surface, or nothing.
  std::optional<Member> Confirm(const Seen& seen, int source, const DepthMap& map) const {
    const PinholeCamera& camera = seen.camera;
    const PinholeCamera& other = input_.cameras[source];
    const Eigen::Vector3f p =
        (other.rotation.cast<double>() * seen.point + other.translation).cast<float>();
    if (p.z() <= 0) return std::nullopt;
    const int u = static_cast<int>(std::lround(other.fx * p.x() / p.z() + other.cx));
    const int v = static_cast<int>(std::lround(other.fy * p.y() / p.z() + other.cy));
    if (u < 0 || v < 0 || u >= map.width || v >= map.height) return std::nullopt;
    const size_t pixel = map.Index(u, v);
    if (!IsUsable(map, pixel)) return std::nullopt;
    const float depth = map.depths[pixel];
    if (std::abs(depth - p.z()) > options_.max_depth_difference * p.z()) return std::nullopt;
    const Eigen::Vector3d there =
        WorldPoint(other, static_cast<float>(u), static_cast<float>(v), depth);
    const Eigen::Vector3f back =
        (camera.rotation.cast<double>() * there + camera.translation).cast<float>();
    const float dx = camera.fx * back.x() / back.z() + camera.cx - seen.x;
    const float dy = camera.fy * back.y() / back.z() + camera.cy - seen.y;
    // The source's pixel grid itself moves the point by up to 0.7 of its pixels.
    const float scale = camera.fx * p.z() / (other.fx * std::max(1e-9f, back.z()));
    const float allowed = options_.max_reprojection_px + 0.71f * std::min(2.0f, scale);
    if (dx * dx + dy * dy > allowed * allowed) return std::nullopt;
    const Eigen::Vector3f other_normal = other.rotation.transpose() * map.Normal(pixel);
    if (other_normal.dot(seen.normal) < std::cos(options_.max_normal_angle_rad))
      return std::nullopt;
    return Member{source, pixel};
  }

  void AddPixel(int index, const Maps& maps, int x, int y, std::array<uint8_t, 3> rgb) {
    const PinholeCamera& camera = input_.cameras[index];
    const std::vector<int>& sources = input_.sources[index];
    const float px = static_cast<float>(x);
    const float py = static_cast<float>(y);
    const size_t pixel = maps[0]->Index(x, y);
    const Seen seen{camera, px, py, WorldPoint(camera, px, py, maps[0]->depths[pixel]),
                    camera.rotation.transpose() * maps[0]->Normal(pixel)};
    std::vector<Member> members = {{index, pixel}};
    Eigen::Vector3f normal_sum = seen.normal;
    // Agreeing sources move the point along the reference ray only: across it, their pixel grids
    // would add noise.
    const Eigen::Vector3d center = WorldPoint(camera, px, py, 0);
    const double range = (seen.point - center).norm();
    double range_sum = range;
    const Eigen::Vector3d ray = (seen.point - center) / range;
    for (size_t s = 0; s < sources.size(); ++s) {
      const auto member = Confirm(seen, sources[s], *maps[s + 1]);
      if (!member) continue;
      members.push_back(*member);
      range_sum += RangeAlong(ray, center, *member, *maps[s + 1]);
      normal_sum +=
          input_.cameras[member->photo].rotation.transpose() * maps[s + 1]->Normal(member->pixel);
    }
    if (static_cast<int>(members.size()) - 1 < options_.min_consistent) return;
    cloud_.positions.push_back(center + ray * (range_sum / static_cast<double>(members.size())));
    cloud_.normals.push_back(normal_sum.normalized());
    cloud_.colors.push_back(rgb);
    std::vector<uint32_t> views;
    for (size_t m = 0; m < members.size(); ++m) {
      views.push_back(input_.ids[members[m].photo].value);
      size_t num_pixels = maps[0]->depths.size();
      for (size_t s = 0; s < sources.size(); ++s) {
        if (sources[s] == members[m].photo) num_pixels = maps[s + 1]->depths.size();
      }
      MarkTaken(members[m], num_pixels);
    }
    std::sort(views.begin(), views.end());
    cloud_.views.push_back(std::move(views));
  }

  // Where the source's plane at that pixel cuts the reference ray.
  double RangeAlong(const Eigen::Vector3d& ray, const Eigen::Vector3d& center, const Member& member,
                    const DepthMap& map) const {
    const PinholeCamera& camera = input_.cameras[member.photo];
    const float u = static_cast<float>(member.pixel % map.width);
    const auto row = member.pixel / map.width;
    const float v = static_cast<float>(row);
    const Eigen::Vector3d on_plane = WorldPoint(camera, u, v, map.depths[member.pixel]);
    const Eigen::Vector3d normal =
        (camera.rotation.transpose() * map.Normal(member.pixel)).cast<double>();
    const double along = normal.dot(ray);
    const double direct = ray.dot(on_plane - center);
    if (std::abs(along) < 0.2) return direct;
    const double cut = normal.dot(on_plane - center) / along;
    return std::abs(cut - direct) < options_.max_depth_difference * direct ? cut : direct;
  }

  const FuseInput& input_;
  const FuseOptions& options_;
  std::vector<std::vector<bool>> taken_;
  PointCloud cloud_;
};

}  // namespace

PointCloud Fuse(const FuseInput& input, const FuseOptions& options,
                const std::function<void()>& after_photo) {
  Fusion fusion(input, options);
  for (size_t i = 0; i < input.ids.size(); ++i) {
    fusion.AddPhoto(static_cast<int>(i));
    after_photo();
  }
  return fusion.Take();
}

}  // namespace stucco
