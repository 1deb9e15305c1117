// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/imported/fit_to_points.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "survey/occluders.h"

namespace stucco {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr double kNear_m = 0.2;
constexpr double kHeightStep_m = 0.5;
constexpr size_t kHeights = 5;       // tried
constexpr double kShiftReach_m = 6;  // of shifts
constexpr double kStep_m = 1.5;      // between them
constexpr double kFar_m = 1.5;       // farther points count as so far
constexpr size_t kFewPoints = 400;   // for the first look
constexpr int kRounds = 25;
constexpr double kLastFar_m = 0.1;  // panes lie farther behind their wall
constexpr size_t kStarts = 3;

// Fans: what of a polygon is not convex hardly matters here.
std::vector<Triangle> TrianglesOf(const SurfaceModel& model) {
  const auto place = [](const Vector3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  std::vector<Triangle> triangles;
  for (const SurfaceObject& object : model.objects) {
    for (const SurfacePolygon& polygon : object.polygons) {
      const auto& ring = polygon.rings.front();
      for (size_t i = 1; i + 1 < ring.size(); ++i) {
        const Triangle triangle(place(ring[0]), place(ring[i]), place(ring[i + 1]));
        if (!triangle.is_degenerate()) triangles.push_back(triangle);
      }
    }
  }
  return triangles;
}

Vector3d ToEigen(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

Occluders TopOf(const std::vector<Triangle>& triangles) {
  std::vector<Vector3d> corners;
  std::vector<std::array<uint32_t, 3>> faces;
  for (const Triangle& triangle : triangles) {
    const auto first = static_cast<uint32_t>(corners.size());
    for (int i = 0; i < 3; ++i) corners.push_back(ToEigen(triangle[i]));
    faces.push_back({first, first + 1, first + 2});
  }
  return {corners, faces};
}

class Fitter {
 public:
  Fitter(const SurfaceModel& model, std::span<const Vector3d> points)
      : points_(points),
        triangles_(TrianglesOf(model)),
        tree_(triangles_.begin(), triangles_.end()) {
    for (const Triangle& triangle : triangles_) {
      for (int i = 0; i < 3; ++i) box_.extend(ToEigen(triangle[i]));
    }
    tree_.accelerate_distance_queries();
  }

  UprightMove Fit() {
    UprightMove still;
    still.centre = box_.center();
    const double before = NearShare(still);
    UprightMove best = still;
    double least = Misfit(still, points_, kNear_m);
    for (const UprightMove& start : Starts(still)) {
      const UprightMove move = Refined(start);
      const double misfit = Misfit(move, points_, kNear_m);
      if (!(misfit < least)) continue;
      least = misfit;
      best = move;
    }
    best.near_after = NearShare(best);
    if (best.near_after <= before) best = still;
    best.near_before = before;
    best.near_after = std::max(best.near_after, before);
    return best;
  }

 private:
  // A point where it would be if the model stood still.
  static Vector3d Back(const UprightMove& move, const Vector3d& p) {
    return Eigen::AngleAxisd(-move.yaw_rad, Vector3d::UnitZ()) * (p - move.shift - move.centre) +
           move.centre;
  }

  double Misfit(const UprightMove& move, std::span<const Vector3d> points, double far) const {
    double sum = 0;
    for (const Vector3d& p : points) {
      const Vector3d at = Back(move, p);
      sum += std::min(far * far, tree_.squared_distance({at.x(), at.y(), at.z()}));
    }
    return sum / static_cast<double>(points.size());
  }

  double NearShare(const UprightMove& move) const {
    const auto near = std::ranges::count_if(points_, [&](const Vector3d& p) {
      const Vector3d at = Back(move, p);
      return tree_.squared_distance({at.x(), at.y(), at.z()}) <= kNear_m * kNear_m;
    });
    return static_cast<double>(near) / static_cast<double>(points_.size());
  }

  // How far above the top of the model points lie: the most frequent differences, and none.
  std::vector<double> Heights() const {
    const Occluders top = TopOf(triangles_);
    const double above = box_.max().z() + 1;
    std::map<int, int> counts;
    for (const Vector3d& p : points_) {
      const auto depth = top.FirstHit({p.x(), p.y(), above}, -Vector3d::UnitZ());
      if (!depth) continue;
      ++counts[static_cast<int>(std::lround((p.z() - (above - *depth)) / kHeightStep_m))];
    }
    std::vector<std::pair<int, int>> most;  // count, bin
    most.reserve(counts.size());
    for (const auto& [bin, count] : counts) most.emplace_back(-count, bin);
    std::ranges::sort(most);
    std::vector<double> heights = {0};
    heights.reserve(1 + kHeights);
    for (size_t i = 0; i < std::min(kHeights, most.size()); ++i) {
      heights.push_back(most[i].second * kHeightStep_m);
    }
    return heights;
  }

  // The best shift at each height, the best of these first.
  std::vector<UprightMove> Starts(const UprightMove& still) const {
    std::vector<Vector3d> few;
    const size_t step = points_.size() / kFewPoints + 1;
    for (size_t i = 0; i < points_.size(); i += step) few.push_back(points_[i]);
    std::vector<std::pair<double, UprightMove>> starts;
    for (const double height : Heights()) {
      std::pair<double, UprightMove> best(std::numeric_limits<double>::infinity(), still);
      for (double x = -kShiftReach_m; x <= kShiftReach_m; x += kStep_m) {
        for (double y = -kShiftReach_m; y <= kShiftReach_m; y += kStep_m) {
          UprightMove move = still;
          move.shift = {x, y, height};
          const double misfit = Misfit(move, few, kFar_m);
          if (misfit < best.first) best = {misfit, move};
        }
      }
      starts.push_back(best);
    }
    std::ranges::stable_sort(starts, {}, &std::pair<double, UprightMove>::first);
    std::vector<UprightMove> out;
    for (size_t i = 0; i < std::min(kStarts, starts.size()); ++i) out.push_back(starts[i].second);
    return out;
  }

  UprightMove Refined(UprightMove move) const {
    for (int round = 0; round < kRounds; ++round) {
      const double share = std::min(1.0, 1.5 * round / kRounds);
      Step(kFar_m * (1 - share) + kLastFar_m * share, move);
    }
    return move;
  }

  // Least squares of the distances from the planes that points are nearest to.
  void Step(double far, UprightMove& move) const {
    Eigen::Matrix4d normal_matrix = 1e-6 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const Vector3d& p : points_) {
      const Vector3d at = Back(move, p);
      const auto nearest = tree_.closest_point_and_primitive({at.x(), at.y(), at.z()});
      const Vector3d foot = ToEigen(nearest.first);
      if ((at - foot).squaredNorm() > far * far) continue;
      const Triangle& triangle = *nearest.second;
      const Vector3d normal = (ToEigen(triangle[1]) - ToEigen(triangle[0]))
                                  .cross(ToEigen(triangle[2]) - ToEigen(triangle[0]))
                                  .normalized();
      Eigen::Vector4d row;
      row.head<3>() = normal;
      row[3] = normal.dot(Vector3d::UnitZ().cross(at - move.centre));
      normal_matrix += row * row.transpose();
      right += row * normal.dot(at - foot);
    }
    const Eigen::Vector4d step = normal_matrix.ldlt().solve(right);
    move.shift += Eigen::AngleAxisd(move.yaw_rad, Vector3d::UnitZ()) * step.head<3>();
    move.yaw_rad += step[3];
  }

  std::span<const Vector3d> points_;
  std::vector<Triangle> triangles_;
  Tree tree_;
  Eigen::AlignedBox3d box_;
};

}  // namespace

Vector3d UprightMove::operator*(const Vector3d& p) const {
  return Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()) * (p - centre) + centre + shift;
}

UprightMove FitToPoints(const SurfaceModel& model, std::span<const Vector3d> points) {
  if (points.empty()) return {};
  return Fitter(model, points).Fit();
}

}  // namespace stucco
