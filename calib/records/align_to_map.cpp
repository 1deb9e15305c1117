// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/align_to_map.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "calib/records/georeference.h"
#include "survey/geometry2d.h"
#include "survey/median.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr size_t kMostPoints = 1000000;
constexpr int kWallRounds = 5;
// Of walls one by one.
constexpr double kAboutWall_m = 1;
constexpr double kWallDepth_m = 0.25;  // panes, frames and sills stand so far back and forth
constexpr double kLeastShare = 0.5;    // so deep a quarter lies of what is scattered about
constexpr size_t kLeastPoints = 20;
constexpr int kLeastWalls = 4;
constexpr double kLeastWallSigma_m = 0.05;
constexpr double kTurnSigma_rad = 0.3 * std::numbers::pi / 180;
constexpr double kTukey = 4.685;
constexpr double kNormalMad = 1.4826;
constexpr double kLeastAcross = 0.02;  // of what walls tell along their main direction

// What the points about a wall say of where it stands.
struct WallSeen {
  Vector2d normal = Vector2d::UnitX();
  Vector2d middle = Vector2d::Zero();
  double distance_m = 0;  // of the middle one of its points before the map's
};

struct WallsSeen {
  std::vector<WallSeen> planes;
  size_t with_points = 0;  // about them, whether these look like a plane or not
};

class WallFit {
 public:
  WallFit(std::span<const Vector3d> points, const SiteMap& map)
      : points_(points), walls_(map.walls), step_(points.size() / kMostPoints + 1) {
    for (const PlannedFacade& wall : walls_) motion_.center += (wall.a_m + wall.b_m) / 2;
    motion_.center /= std::max<double>(1, static_cast<double>(walls_.size()));
    motion_.shift = ShiftOntoMap(points, map);
  }

  std::optional<MapAlignment> Run() {
    WallsSeen seen;
    for (int round = 0; round < kWallRounds; ++round) {
      seen = See();
      if (seen.planes.size() < kLeastWalls || 2 * seen.planes.size() < seen.with_points) {
        return std::nullopt;
      }
      if (!Improve(seen.planes)) return std::nullopt;
    }
    MapAlignment alignment;
    alignment.shift_m = motion_.shift;
    alignment.turn_rad = motion_.turn_rad;
    alignment.sigma_m = sigma_m_;
    alignment.walls = static_cast<int>(seen.planes.size());
    Similarity& motion = alignment.map_from_scene;
    motion.rotation = Eigen::AngleAxisd(motion_.turn_rad, Vector3d::UnitZ());
    motion.translation.head<2>() = motion_.Transform().translation();
    return alignment;
  }

 private:
  WallsSeen See() const {
    const Eigen::Isometry2d moved = motion_.Transform();
    std::vector<std::vector<double>> about(walls_.size());
    for (size_t i = 0; i < points_.size(); i += step_) {
      Vector3d point = points_[i];
      point.head<2>() = moved * point.head<2>();
      for (size_t w = 0; w < walls_.size(); ++w) {
        const auto distance = BeforeWall(walls_[w], point);
        if (distance && std::abs(*distance) < kAboutWall_m) about[w].push_back(*distance);
      }
    }
    WallsSeen seen;
    for (size_t w = 0; w < walls_.size(); ++w) AddWall(walls_[w], std::move(about[w]), seen);
    return seen;
  }

  static void AddWall(const PlannedFacade& wall, std::vector<double> distances, WallsSeen& seen) {
    if (distances.size() < kLeastPoints) return;
    ++seen.with_points;
    const double middle = *Median(distances);
    const auto on_it = static_cast<double>(std::ranges::count_if(
        distances, [&](double d) { return std::abs(d - middle) < kWallDepth_m; }));
    if (on_it < kLeastShare * static_cast<double>(distances.size())) return;
    seen.planes.push_back({wall.outwards(), (wall.a_m + wall.b_m) / 2, middle});
  }

  // One step of Gauss and Newton. False where the walls leave the shift open.
  bool Improve(const std::vector<WallSeen>& walls) {
    std::vector<double> sizes;
    sizes.reserve(walls.size());
    for (const WallSeen& wall : walls) sizes.push_back(std::abs(wall.distance_m));
    const double sigma = std::max(kLeastWallSigma_m, kNormalMad * *Median(std::move(sizes)));
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (const WallSeen& wall : walls) {
      const double over = wall.distance_m / (kTukey * sigma);
      if (std::abs(over) >= 1) continue;
      const double weight = std::pow(1 - over * over, 2) / (sigma * sigma);
      const Vector3d row = motion_.RowOf(wall.normal, wall.middle);
      normals += weight * row * row.transpose();
      right -= weight * wall.distance_m * row;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(normals.topLeftCorner<2, 2>());
    if (!(axes.eigenvalues()[0] > kLeastAcross * axes.eigenvalues()[1])) return false;
    normals(2, 2) += 1 / std::pow(kTurnSigma_rad, 2);
    right[2] -= motion_.turn_rad / std::pow(kTurnSigma_rad, 2);
    const Eigen::LDLT<Eigen::Matrix3d> solver(normals);
    const Vector3d step = solver.solve(right);
    motion_.shift += step.head<2>();
    motion_.turn_rad += step.z();
    const Eigen::Matrix3d covariance = solver.solve(Eigen::Matrix3d::Identity());
    sigma_m_ = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
    return true;
  }

  std::span<const Vector3d> points_;
  std::span<const PlannedFacade> walls_;
  size_t step_;
  LevelMotion motion_;
  double sigma_m_ = 0;
};

}  // namespace

SiteMap MapInScene(const Plan& plan, const Georef& georef,
                   const std::vector<std::optional<Pose>>& expected, const Scene& scene) {
  assert(georef.frame == "enu" && expected.size() == scene.photos.size());
  std::vector<double> above;
  for (size_t i = 0; i < expected.size(); ++i) {
    if (!expected[i] || !scene.photos[i].pose) continue;
    above.push_back(expected[i]->Center().z() - scene.photos[i].pose->Center().z());
  }
  const double plan_above = Median(std::move(above)).value_or(0);
  SiteMap map{plan.facades, plan.footprints};
  for (PlannedFacade& wall : map.walls) {
    wall.a_m = EnuFromPlan(plan.origin, georef, wall.a_m);
    wall.b_m = EnuFromPlan(plan.origin, georef, wall.b_m);
    wall.z_m.from_m -= plan_above;
    wall.z_m.to_m -= plan_above;
  }
  for (PlannedFootprint& footprint : map.footprints) {
    for (Ring& ring : footprint.rings_m) {
      for (Vector2d& corner : ring) corner = EnuFromPlan(plan.origin, georef, corner);
    }
    footprint.z_m.from_m -= plan_above;
    footprint.z_m.to_m -= plan_above;
  }
  return map;
}

std::optional<MapAlignment> AlignToWalls(std::span<const Vector3d> points, const SiteMap& map) {
  return WallFit(points, map).Run();
}

void MoveToMap(const MapAlignment& alignment, std::vector<PoseRecord>& records, Scene& scene) {
  const Similarity& motion = alignment.map_from_scene;
  Transform(motion, scene);
  for (PoseRecord& record : records) {
    if (record.position) record.position->position = motion * record.position->position;
    if (record.gimbal) *record.gimbal = *record.gimbal * motion.rotation.conjugate();
  }
}

}  // namespace stucco
