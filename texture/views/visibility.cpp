// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "survey/triangulate.h"

namespace stucco {
namespace {

constexpr int kFewestInFront = 2;
constexpr int kFewestBeyond = 3;
// A raster is so coarse that surfaces get about this many points per cell, else they look open.
constexpr double kSplatsPerCell = 1.5;
constexpr int kNarrowest = 100;
// Cosine of 3 degrees, between directions in which two photos see the same of what stands before a
// point: as far apart as positions of one view by two flights are.
constexpr double kSameSight = 0.99863;

Occluders OccludersOf(const Proxy& proxy) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      const FacetTriangles part = TriangulateFacet(facet);
      const auto first = static_cast<uint32_t>(vertices.size());
      vertices.insert(vertices.end(), part.vertices.begin(), part.vertices.end());
      for (const auto& t : part.triangles) {
        triangles.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
  }
  return {vertices, triangles};
}

}  // namespace

OcclusionScene::OcclusionScene(const Proxy& proxy) : occluders_(OccludersOf(proxy)) {}

bool OcclusionScene::Blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  return occluders_.Block(from, to - from, 1);
}

bool SightedPoints::IsSeenBy(size_t point, PhotoId photo) const {
  if (ends.empty()) return true;
  const auto first = views.begin() + static_cast<std::ptrdiff_t>(point > 0 ? ends[point - 1] : 0);
  const auto last = views.begin() + static_cast<std::ptrdiff_t>(ends[point]);
  return std::find(first, last, photo.value) != last;
}

SightedPoints SightedByOthers(SightedPoints points, std::span<const SurveyPhoto> of_points,
                              std::span<const SurveyPhoto> others) {
  std::map<uint32_t, Eigen::Vector3d> centres;
  for (const SurveyPhoto& photo : of_points) {
    centres[photo.id.value] = photo.cam_from_world.Center();
  }
  SightedPoints out;
  size_t first = 0;
  std::vector<Eigen::Vector3d> sights;
  for (size_t i = 0; i < points.ends.size(); ++i) {
    sights.clear();
    for (; first < points.ends[i]; ++first) {
      const auto centre = centres.find(points.views[first]);
      if (centre == centres.end()) continue;
      sights.push_back((points.positions[i] - centre->second).normalized());
    }
    for (const SurveyPhoto& other : others) {
      const Eigen::Vector3d sight =
          (points.positions[i] - other.cam_from_world.Center()).normalized();
      const auto is_near = [&](const Eigen::Vector3d& s) { return s.dot(sight) > kSameSight; };
      if (std::ranges::any_of(sights, is_near)) out.views.push_back(other.id.value);
    }
    out.ends.push_back(out.views.size());
  }
  out.positions = std::move(points.positions);
  return out;
}

NearestPoints SplatNearest(const SurveyPhoto& photo, const SightedPoints& points, int most_px) {
  struct Splat {
    Eigen::Vector2d pixel;
    float depth;
    int32_t index;
  };
  std::vector<Splat> splats;
  for (size_t i = 0; i < points.positions.size(); ++i) {
    const auto pixel = ProjectIntoPhoto(photo, points.positions[i]);
    if (!pixel) continue;
    const auto depth = static_cast<float>((photo.cam_from_world * points.positions[i]).z());
    splats.push_back({*pixel, depth, static_cast<int32_t>(i)});
  }
  NearestPoints out;
  const double aspect = static_cast<double>(photo.camera.width_px) / photo.camera.height_px;
  const double dense_enough =
      std::sqrt(static_cast<double>(splats.size()) * aspect / kSplatsPerCell);
  out.width = std::min(std::clamp(static_cast<int>(dense_enough), kNarrowest, most_px),
                       photo.camera.width_px);
  out.height = std::max(1, static_cast<int>(out.width / aspect));
  out.index.assign(static_cast<size_t>(out.width) * out.height, -1);
  std::vector<float> nearest(out.index.size(), std::numeric_limits<float>::max());
  for (const Splat& splat : splats) {
    const int x = std::min(out.width - 1,
                           static_cast<int>(splat.pixel.x() * out.width / photo.camera.width_px));
    const int y = std::min(out.height - 1,
                           static_cast<int>(splat.pixel.y() * out.height / photo.camera.height_px));
    const size_t cell = static_cast<size_t>(y) * out.width + x;
    if (splat.depth < nearest[cell]) {
      nearest[cell] = splat.depth;
      out.index[cell] = splat.index;
    }
  }
  out.seen.assign(out.index.size(), 0);
  for (size_t cell = 0; cell < out.index.size(); ++cell) {
    const int32_t i = out.index[cell];
    out.seen[cell] = i >= 0 && points.IsSeenBy(static_cast<size_t>(i), photo.id);
  }
  return out;
}

CloudView AskCloud(const SightScene& scene, int photo_index, const Eigen::Vector2d& pixel,
                   const Facet& facet, const HeightBand& band) {
  const SurveyPhoto& photo = scene.photos[photo_index];
  const NearestPoints& nearest = scene.nearest[photo_index];
  const double camera_height = facet.normal.dot(photo.cam_from_world.Center()) - facet.offset;
  const int x = static_cast<int>(pixel.x() * nearest.width / photo.camera.width_px);
  const int y = static_cast<int>(pixel.y() * nearest.height / photo.camera.height_px);
  int in_front = 0;
  int beyond = 0;
  int beyond_and_seen = 0;
  int near = 0;
  int all = 0;
  for (int row = std::max(0, y - 2); row <= std::min(nearest.height - 1, y + 2); ++row) {
    for (int column = std::max(0, x - 2); column <= std::min(nearest.width - 1, x + 2); ++column) {
      const size_t cell = static_cast<size_t>(row) * nearest.width + column;
      const int32_t i = nearest.index[cell];
      if (i < 0) continue;
      ++all;
      const double height = facet.normal.dot(scene.points[i]) - facet.offset;
      const bool close = std::abs(row - y) <= 1 && std::abs(column - x) <= 1;
      near += close;
      in_front += close && height > band.high && height < camera_height;
      if (!(height < band.low)) continue;
      ++beyond;
      beyond_and_seen += nearest.seen[cell];
    }
  }
  if (in_front >= kFewestInFront) return CloudView::kInFront;
  if (beyond_and_seen >= kFewestBeyond && beyond == all) return CloudView::kBeyond;
  return near == 0 ? CloudView::kNoPoints : CloudView::kSurface;
}

}  // namespace stucco
