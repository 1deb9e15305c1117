// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/imported/welded_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

#include "survey/triangulate.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

class Welder {
 public:
  explicit Welder(double flat) : flat_(flat) {}

  WeldedModel Weld(const SurfaceModel& model) {
    for (size_t i = 0; i < model.objects.size(); ++i) {
      object_ = static_cast<int>(i);
      for (const SurfacePolygon& polygon : model.objects[i].polygons) {
        if (!model.is_mesh) ++group_;
        Add(polygon);
      }
    }
    return std::move(out_);
  }

 private:
  void Add(const SurfacePolygon& from) {
    WeldedPolygon polygon{{}, object_, group_, from.facet_class, from.id};
    for (const std::vector<Vector3d>& ring : from.rings) {
      std::vector<int> corners = IndicesOf(ring);
      if (corners.size() >= 3) {
        polygon.rings.push_back(std::move(corners));
      } else if (polygon.rings.empty()) {
        break;  // the outer ring
      }
    }
    if (polygon.rings.empty() ||
        !(AreaVector(out_.corners, polygon.rings.front()).norm() > flat_ * flat_)) {
      ++out_.empty;
    } else if (IsThere(polygon.rings.front())) {
      ++out_.doubled;
    } else if (Deviation(polygon) <= flat_) {
      out_.polygons.push_back(std::move(polygon));
    } else {
      AddTriangles(polygon);
    }
  }

  // Without corners that are the one before.
  std::vector<int> IndicesOf(const std::vector<Vector3d>& ring) {
    std::vector<int> indices;
    for (const Vector3d& p : ring) {
      const int index = IndexOf(p);
      if (indices.empty() || indices.back() != index) indices.push_back(index);
    }
    while (indices.size() > 1 && indices.front() == indices.back()) indices.pop_back();
    return indices;
  }

  int IndexOf(const Vector3d& p) {
    const double step = flat_ / 10;
    const std::array<int64_t, 3> cell = {std::llround(p.x() / step), std::llround(p.y() / step),
                                         std::llround(p.z() / step)};
    const auto [at, is_new] = index_.try_emplace(cell, static_cast<int>(out_.corners.size()));
    if (is_new) out_.corners.push_back(p);
    return at->second;
  }

  // Models that are seen from both sides have each polygon twice.
  bool IsThere(std::vector<int> ring) {
    std::ranges::sort(ring);
    return !there_.insert(std::move(ring)).second;
  }

  Facet AsFacet(const WeldedPolygon& polygon) const {
    Facet facet;
    facet.normal = AreaVector(out_.corners, polygon.rings.front()).normalized();
    for (size_t k = 0; k < polygon.rings.size(); ++k) {
      auto& ring = k == 0 ? facet.outer : facet.holes.emplace_back();
      for (const int corner : polygon.rings[k]) ring.push_back(out_.corners[corner]);
    }
    for (const Vector3d& p : facet.outer) {
      facet.offset += facet.normal.dot(p) / static_cast<double>(facet.outer.size());
    }
    return facet;
  }

  double Deviation(const WeldedPolygon& polygon) const {
    const Facet facet = AsFacet(polygon);
    double most = 0;
    for (const std::vector<int>& ring : polygon.rings) {
      for (const int corner : ring) {
        most = std::max(most, std::abs(facet.normal.dot(out_.corners[corner]) - facet.offset));
      }
    }
    return most;
  }

  void AddTriangles(const WeldedPolygon& polygon) {
    Facet facet = AsFacet(polygon);
    std::vector<int> corners;
    for (const std::vector<int>& ring : polygon.rings) {
      corners.insert(corners.end(), ring.begin(), ring.end());
    }
    const auto flatten = [&](std::vector<Vector3d>& ring) {
      for (Vector3d& p : ring) p -= (facet.normal.dot(p) - facet.offset) * facet.normal;
    };
    flatten(facet.outer);
    for (auto& hole : facet.holes) flatten(hole);
    for (const auto& triangle : TriangulateFacet(facet).triangles) {
      WeldedPolygon part = polygon;
      part.rings = {{corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]}};
      if (AreaVector(out_.corners, part.rings.front()).norm() > flat_ * flat_) {
        out_.polygons.push_back(std::move(part));
      }
    }
  }

  double flat_;
  int object_ = 0;
  int group_ = 0;
  WeldedModel out_;
  std::map<std::array<int64_t, 3>, int> index_;
  std::set<std::vector<int>> there_;
};

}  // namespace

Eigen::Vector3d AreaVector(const std::vector<Vector3d>& corners, const std::vector<int>& ring) {
  Vector3d sum = Vector3d::Zero();
  const Vector3d& first = corners[ring.front()];
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += (corners[ring[i]] - first).cross(corners[ring[i + 1]] - first);
  }
  return sum;
}

WeldedModel Weld(const SurfaceModel& model, double flat) {
  return Welder(flat).Weld(model);
}

}  // namespace stucco
