// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/fuse.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dense/internal/source_geometry.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// A pixel at most this much larger on the surface than another sees it about as finely.
constexpr float kAboutAsFine = 1.25f;
constexpr int kRowsOfTask = 16;

// A pixel of another photo that shows the same surface.
struct Member {
  size_t neighbour = 0;  // place in the list of the photo that is fused
  size_t pixel = 0;
  float spacing = 0;  // of its pixels on the surface
};

// One of the photos that the one being fused is held against.
struct Neighbour {
  int photo = 0;
  const PinholeCamera& camera;
  std::shared_ptr<const DepthMap> map;
  SourceGeometry to;    // from the photo being fused
  SourceGeometry back;  // to it
};

// A photo with what it takes to fuse it; the same for all its pixels.
struct Fused {
  int photo = 0;
  const PinholeCamera& camera;
  Eigen::Vector3d center;
  std::shared_ptr<const DepthMap> map;
  std::shared_ptr<const ViewPyramid> colors;
  std::vector<Neighbour> neighbours;
};

// A pixel of the photo being fused and the surface that its map has there.
struct Seen {
  int x = 0;
  int y = 0;
  Eigen::Vector3f point;   // camera frame
  Eigen::Vector3f normal;  // likewise
  float spacing = 0;
};

// What the pixels of some rows become.
struct Rows {
  FusedPoints points;
  std::vector<std::pair<int, size_t>> used;  // photo, pixel
};

class Fusion {
 public:
  Fusion(const FuseInput& input, const FuseOptions& options)
      : input_(input), options_(options), taken_(input.ids.size()) {}

  FusedPoints AddPhoto(int index) {
    const Fused photo = Prepare(index);
    const auto height = static_cast<size_t>(photo.map->height);
    std::vector<Rows> tasks((height + kRowsOfTask - 1) / kRowsOfTask);
    // Pixels of one photo do not depend on each other.
    ParallelFor(tasks.size(), options_.threads, [&](size_t task) {
      const int first = static_cast<int>(task) * kRowsOfTask;
      for (int y = first; y < std::min(photo.map->height, first + kRowsOfTask); ++y) {
        for (int x = 0; x < photo.map->width; ++x) AddPixel(photo, x, y, tasks[task]);
      }
    });
    FusedPoints points;
    for (const Rows& rows : tasks) {
      points.Add(rows.points);
      for (const auto& [other, pixel] : rows.used) MarkTaken(other, pixel);
    }
    return points;
  }

 private:
  Fused Prepare(int index) const {
    const PinholeCamera& camera = input_.cameras[index];
    const Eigen::Vector3d center =
        -(camera.rotation.cast<double>().transpose() * camera.translation);
    Fused photo{index, camera, center, input_.map(index), input_.colors(index), {}};
    for (const int other : input_.neighbours[index]) {
      const PinholeCamera& there = input_.cameras[other];
      photo.neighbours.push_back({other, there, input_.map(other), SourceGeometry(camera, there),
                                  SourceGeometry(there, camera)});
    }
    return photo;
  }

  bool IsUsable(const DepthMap& map, size_t pixel) const {
    return map.depths[pixel] > 0 && map.costs[pixel] <= options_.max_cost * 127;
  }

  bool IsTaken(int photo, size_t pixel) const {
    return !taken_[photo].empty() && taken_[photo][pixel];
  }

  void MarkTaken(int photo, size_t pixel) {
    if (taken_[photo].empty()) {
      const PinholeCamera& camera = input_.cameras[photo];
      taken_[photo].assign(static_cast<size_t>(camera.width) * camera.height, false);
    }
    taken_[photo][pixel] = true;
  }

  // The neighbour's pixel that shows the same surface, or nothing.
  std::optional<Member> Confirm(const Fused& photo, const Seen& seen, size_t index) const {
    const Neighbour& neighbour = photo.neighbours[index];
    const PinholeCamera& other = neighbour.camera;
    const DepthMap& map = *neighbour.map;
    const Eigen::Vector3f p =
        neighbour.to.source_from_reference * seen.point + neighbour.to.translation;
    if (p.z() <= 0) return std::nullopt;
    const float px = other.fx * p.x() / p.z() + other.cx;
    const float py = other.fy * p.y() / p.z() + other.cy;
    if (!(px > -0.5f && py > -0.5f && px < static_cast<float>(map.width) - 0.5f &&
          py < static_cast<float>(map.height) - 0.5f)) {
      return std::nullopt;
    }
    const int u = std::min(map.width - 1, static_cast<int>(std::lround(px)));
    const int v = std::min(map.height - 1, static_cast<int>(std::lround(py)));
    const size_t pixel = map.Index(u, v);
    if (!IsUsable(map, pixel)) return std::nullopt;
    const float depth = map.depths[pixel];
    if (std::abs(depth - p.z()) > options_.max_depth_difference * p.z()) return std::nullopt;
    const SourceGeometry& back = neighbour.back;
    const Eigen::Vector3f there = other.Ray(static_cast<float>(u), static_cast<float>(v)) * depth;
    const Eigen::Vector3f q = back.source_from_reference * there + back.translation;
    if (q.z() <= 0) return std::nullopt;
    const PinholeCamera& camera = photo.camera;
    const float dx = camera.fx * q.x() / q.z() + camera.cx - static_cast<float>(seen.x);
    const float dy = camera.fy * q.y() / q.z() + camera.cy - static_cast<float>(seen.y);
    // The neighbour's pixel grid itself moves the point by up to 0.7 of its pixels.
    const float spacing = p.z() / other.fx;
    const float scale = std::min(2.0f, spacing / seen.spacing);
    const float allowed = options_.max_reprojection_px + 0.71f * scale;
    if (dx * dx + dy * dy > allowed * allowed) return std::nullopt;
    const Eigen::Vector3f normal = back.source_from_reference * map.Normal(pixel);
    if (normal.dot(seen.normal) < std::cos(options_.max_normal_angle_rad)) return std::nullopt;
    return Member{index, pixel, spacing};
  }

  void AddPixel(const Fused& photo, int x, int y, Rows& rows) const {
    const DepthMap& map = *photo.map;
    const size_t pixel = map.Index(x, y);
    if (!IsUsable(map, pixel) || IsTaken(photo.photo, pixel)) return;
    const float depth = map.depths[pixel];
    const Eigen::Vector3f ray = photo.camera.Ray(static_cast<float>(x), static_cast<float>(y));
    const Seen seen{x, y, ray * depth, map.Normal(pixel), depth / photo.camera.fx};
    std::vector<Member> members;
    for (size_t n = 0; n < photo.neighbours.size(); ++n) {
      const auto member = Confirm(photo, seen, n);
      if (!member) continue;
      // The surface has its point there, and gets no finer by another one.
      if (member->spacing <= kAboutAsFine * seen.spacing &&
          IsTaken(photo.neighbours[n].photo, member->pixel)) {
        return;
      }
      members.push_back(*member);
    }
    if (static_cast<int>(members.size()) < options_.min_consistent) return;
    rows.used.emplace_back(photo.photo, pixel);
    for (const Member& member : members) {
      rows.used.emplace_back(photo.neighbours[member.neighbour].photo, member.pixel);
    }
    AddPoint(photo, seen, members, rows.points);
  }

  // The mean of all that agree. They move the point along the photo's own ray only: across it,
  // their pixel grids would add noise. What sees the surface from near knows better where it is.
  void AddPoint(const Fused& photo, const Seen& seen, const std::vector<Member>& members,
                FusedPoints& points) const {
    const Eigen::Vector3f ray = seen.point.normalized();
    const float own_range = seen.point.norm();
    float weight_sum = 1;
    float range_sum = own_range;
    Eigen::Vector3f normal_sum = seen.normal;
    float spacing = seen.spacing;
    std::vector<uint32_t> views = {input_.ids[photo.photo].value};
    for (const Member& member : members) {
      const Neighbour& neighbour = photo.neighbours[member.neighbour];
      const float finer = seen.spacing / member.spacing;
      const float weight = finer * finer;
      weight_sum += weight;
      range_sum += weight * RangeAlong(ray, neighbour, member.pixel);
      normal_sum +=
          weight * (neighbour.back.source_from_reference * neighbour.map->Normal(member.pixel));
      spacing = std::min(spacing, member.spacing);
      views.push_back(input_.ids[neighbour.photo].value);
    }
    std::ranges::sort(views);
    const Eigen::Vector3d in_cam = (ray * (range_sum / weight_sum)).cast<double>();
    const Eigen::Matrix3f world_from_cam = photo.camera.rotation.transpose();
    const uint8_t* rgb = photo.colors->color.Pixel(seen.x, seen.y);
    FusedPoint fused;
    fused.point.position = photo.center + world_from_cam.cast<double>() * in_cam;
    fused.point.normal = (world_from_cam * normal_sum).normalized();
    fused.point.color = {rgb[0], rgb[1], rgb[2]};
    fused.point.views = views;
    fused.spacing = spacing;
    points.Add(fused);
  }

  // Where the neighbour's plane at that pixel cuts the ray of the photo being fused.
  float RangeAlong(const Eigen::Vector3f& ray, const Neighbour& neighbour, size_t pixel) const {
    const DepthMap& map = *neighbour.map;
    const auto u = static_cast<float>(pixel % map.width);
    const size_t row = pixel / map.width;
    const auto v = static_cast<float>(row);
    const SourceGeometry& back = neighbour.back;
    const Eigen::Vector3f on_plane =
        back.source_from_reference * (neighbour.camera.Ray(u, v) * map.depths[pixel]) +
        back.translation;
    const Eigen::Vector3f normal = back.source_from_reference * map.Normal(pixel);
    const float along = normal.dot(ray);
    const float direct = ray.dot(on_plane);
    if (std::abs(along) < 0.2f) return direct;
    const float cut = normal.dot(on_plane) / along;
    return std::abs(cut - direct) < options_.max_depth_difference * direct ? cut : direct;
  }

  const FuseInput& input_;
  const FuseOptions& options_;
  std::vector<std::vector<bool>> taken_;
};

}  // namespace

void Fuse(const FuseInput& input, const FuseOptions& options,
          const std::function<void(const FusedPoints&)>& after_photo) {
  Fusion fusion(input, options);
  for (size_t i = 0; i < input.ids.size(); ++i) after_photo(fusion.AddPhoto(static_cast<int>(i)));
}

}  // namespace stucco
