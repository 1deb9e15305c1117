// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/placing.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "survey/attitude.h"
#include "survey/error.h"
#include "survey/median.h"
#include "survey/plan_frame.h"

namespace stucco::simulate {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr char kModelHint[] =
    "use the plan that was made for this scene; for a model from elsewhere, --unit and --up say "
    "what its numbers mean";

std::string_view NameOf(const SceneShape& scene, int element) {
  const bool is_known = element >= 0 && element < static_cast<int>(scene.elements.size());
  return is_known ? std::string_view(scene.elements[element]) : std::string_view();
}

// "G0", "G1": the ground of a scene of ours. In other models names mean nothing.
bool IsGround(const SceneShape& scene, int element) {
  const std::string_view name = NameOf(scene, element);
  return scene.is_ours && name.size() > 1 && name[0] == 'G' &&
         name.find_first_not_of("0123456789", 1) == name.npos;
}

bool IsOccluder(const SceneShape& scene, int element) {
  return scene.is_ours && NameOf(scene, element).starts_with(kOccluderPrefix);
}

// All that a vertical line meets from `from` on; a long way, as scenes have many leaves.
std::vector<RayHit> HitsAlong(const SceneShape& scene, Eigen::Vector3d from,
                              const Eigen::Vector3d& direction) {
  constexpr int kMost = 200;
  constexpr double kStep_m = 1e-3;  // beyond what was hit
  std::vector<RayHit> hits;
  for (int i = 0; i < kMost; ++i) {
    const auto hit = scene.cast(from, direction);
    if (!hit) break;
    hits.push_back(*hit);
    from = hit->point + kStep_m * direction;
  }
  return hits;
}

// What there is at a place, from the top down, without trees and cars.
std::vector<RayHit> SurfacesAt(const SceneShape& scene, const Eigen::Vector2d& place) {
  const Eigen::Vector3d above(place.x(), place.y(), scene.box.max().z() + 1);
  auto hits = HitsAlong(scene, above, -Eigen::Vector3d::UnitZ());
  std::erase_if(hits, [&](const RayHit& hit) { return IsOccluder(scene, hit.element); });
  return hits;
}

// The ground among them: what is called so, else the lowest.
std::optional<double> GroundOf(const SceneShape& scene, const std::vector<RayHit>& surfaces) {
  for (const RayHit& hit : surfaces) {
    if (IsGround(scene, hit.element)) return hit.point.z();
  }
  if (surfaces.empty()) return std::nullopt;
  return surfaces.back().point.z();
}

Eigen::Vector3d WorldAtHeight(const PlacedPlan& placed, const Eigen::Vector2d& position,
                              double height_m) {
  const Geodetic at = GeodeticFromPlan(placed.origin, position);
  return EnuFromGeodetic(placed.world, at.latitude_deg, at.longitude_deg, height_m);
}

Eigen::AlignedBox2d BoxOf(const PlacedPlan& placed, const PlannedFootprint& footprint) {
  Eigen::AlignedBox2d box;
  for (const auto& ring : footprint.rings_m) {
    for (const Eigen::Vector2d& corner : ring) {
      box.extend(WorldAtHeight(placed, corner, placed.world.origin_height_m).head<2>().eval());
    }
  }
  return box;
}

std::string SizeText(const Eigen::AlignedBox2d& box) {
  return fmt::format("{:.4g} x {:.4g} m", box.sizes().x(), box.sizes().y());
}

// The plan's footprints must stand on the scene, and the scene must be of their size.
void RequireSamePlace(const Plan& plan, const PlacedPlan& placed, const SceneShape& scene) {
  const Eigen::AlignedBox2d ground(scene.box.min().head<2>().eval(),
                                   scene.box.max().head<2>().eval());
  Eigen::AlignedBox2d all;
  size_t met = 0;
  size_t buildings = 0;
  for (const PlannedFootprint& footprint : plan.footprints) {
    if (footprint.is_obstacle) continue;
    ++buildings;
    const Eigen::AlignedBox2d box = BoxOf(placed, footprint);
    all.extend(box);
    if (ground.intersects(box)) ++met;
  }
  if (buildings == 0) return;
  constexpr double kTimes = 20;
  const double ratio = ground.diagonal().norm() / std::max(all.diagonal().norm(), 1.0);
  if (!(ratio > 1 / kTimes)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("the scene covers {} and the plan's buildings {}: its unit is not the "
                            "metre, or the plan is for another place",
                            SizeText(ground), SizeText(all)),
                kModelHint);
  }
  if (2 * met >= buildings) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("the plan is for another place: {} of its {} buildings are where the "
                          "scene is; their middle is {:.0f} m from the scene's",
                          met, buildings, (all.center() - ground.center()).norm()),
              kModelHint);
}

std::vector<RayHit> SurfacesAtPlanned(const SceneShape& scene, const PlacedPlan& placed,
                                      const Eigen::Vector2d& place) {
  const double height_m = placed.world.origin_height_m;
  return SurfacesAt(scene, WorldAtHeight(placed, place, height_m).head<2>());
}

// A place of the plan before the middle of a wall, farther than balconies reach.
Eigen::Vector2d BeforeWall(const PlannedFacade& wall) {
  constexpr double kBefore_m = 2;
  return (wall.a_m + wall.b_m) / 2 + kBefore_m * wall.outwards();
}

// Whether something high stands behind a wall of the plan and nothing before it; nothing where the
// scene has no ground.
std::optional<bool> Stands(const PlannedFacade& wall, const PlacedPlan& placed,
                           const SceneShape& scene) {
  constexpr double kBehind_m = 1;
  constexpr double kHigh_m = 2;
  const Eigen::Vector2d middle = (wall.a_m + wall.b_m) / 2;
  const auto before = SurfacesAtPlanned(scene, placed, BeforeWall(wall));
  const auto behind = SurfacesAtPlanned(scene, placed, middle - kBehind_m * wall.outwards());
  const auto ground = GroundOf(scene, before);
  if (!ground || behind.empty()) return std::nullopt;
  const double high = *ground + kHigh_m;
  return behind.front().point.z() > high && before.front().point.z() < high;
}

// Models from elsewhere all lie about their origin, as plans do: that something is there does not
// mean that it is what was planned for. Returns of how many walls that can be said.
int RequireWalls(const Plan& plan, const PlacedPlan& placed, const SceneShape& scene) {
  int known = 0;
  int standing = 0;
  for (const PlannedFacade& wall : plan.facades) {
    const auto stands = Stands(wall, placed, scene);
    if (!stands) continue;
    ++known;
    if (*stands) ++standing;
  }
  if (2 * standing >= known) return known;
  throw Error(ErrorKind::kBadInput,
              fmt::format("the plan is for another place: {} of its {} walls stand in the scene",
                          standing, known),
              kModelHint);
}

// Height of the scene's ground at a place of the plan; the way through geodetic coordinates takes
// the earth's curvature along.
std::optional<double> GroundHeightAt(const SceneShape& scene, const PlacedPlan& placed,
                                     const Eigen::Vector2d& place) {
  const Eigen::Vector3d in_world = WorldAtHeight(placed, place, placed.world.origin_height_m);
  const auto ground = GroundOf(scene, SurfacesAt(scene, in_world.head<2>()));
  if (!ground) return std::nullopt;
  return GeodeticFromEnu(placed.world, {in_world.x(), in_world.y(), *ground}).z();
}

// The height that z = 0 of a plan without terrain means. Before walls there is ground; the plan's
// origin may lie in a house, and models from elsewhere have no ground under their roofs.
double GroundHeight(const Plan& plan, const PlacedPlan& placed, const SceneShape& scene) {
  std::vector<double> heights;
  for (const PlannedFacade& wall : plan.facades) {
    const auto height_m = GroundHeightAt(scene, placed, BeforeWall(wall));
    if (height_m) heights.push_back(*height_m);
  }
  if (const auto height_m = Median(std::move(heights))) return *height_m;
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(0, 0), plan.home_m.head<2>().eval()}) {
    if (const auto height_m = GroundHeightAt(scene, placed, place)) return *height_m;
  }
  throw Error(ErrorKind::kBadInput,
              "the scene has no ground before the plan's walls, at its origin nor at its home, so "
              "that the plan's heights mean nothing",
              kModelHint);
}

// The i-th of n directions that are spread evenly, by the golden angle.
Eigen::Vector3d OnSphere(int i, int n) {
  const double golden = kPi * (3 - std::sqrt(5));
  const double z = 1 - (2 * i + 1.0) / n;
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(i * golden), r * std::sin(i * golden), z};
}

}  // namespace

PlacedPlan PlacePlan(const Plan& plan, const SceneInfo& info, const SceneShape& scene) {
  PlacedPlan placed;
  placed.origin = plan.origin;
  placed.height_m = plan.origin.height_m;
  placed.world = info.georef;
  if (info.georef.frame != "enu") {
    placed.world = Georef{};
    placed.world.frame = "enu";
    placed.world.origin_latitude_deg = plan.origin.latitude_deg;
    placed.world.origin_longitude_deg = plan.origin.longitude_deg;
    placed.world.origin_height_m = plan.origin.height_m;
    placed.world.metric = true;
  }
  RequireSamePlace(plan, placed, scene);
  placed.walls_judged = RequireWalls(plan, placed, scene);
  if (plan.origin.height_m == 0) placed.height_m = GroundHeight(plan, placed, scene);
  return placed;
}

Eigen::Vector3d WorldFromPlan(const PlacedPlan& placed, const Eigen::Vector3d& position_m) {
  return WorldAtHeight(placed, position_m.head<2>(), placed.height_m + position_m.z());
}

Eigen::Matrix3d PlanAxesAt(const PlacedPlan& placed, const Eigen::Vector3d& position_m) {
  constexpr double kStep_m = 1;
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(i);
    axes.col(i) =
        WorldFromPlan(placed, position_m + step) - WorldFromPlan(placed, position_m - step);
  }
  // The nearest rotation.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Pose CameraPose(const PlacedPlan& placed, const Eigen::Vector3d& position_m,
                const GimbalAngles& angles) {
  Pose pose;
  const Eigen::Quaterniond enu_from_plan(PlanAxesAt(placed, position_m));
  pose.rotation = (CamFromEnu(angles) * enu_from_plan.conjugate()).normalized();
  pose.translation = -(pose.rotation * WorldFromPlan(placed, position_m));
  return pose;
}

std::optional<std::string> WhyBlocked(const SceneShape& scene, const Eigen::Vector3d& place) {
  const auto overhead = HitsAlong(scene, place, Eigen::Vector3d::UnitZ());
  const auto solid = std::find_if(overhead.begin(), overhead.end(), [&](const RayHit& hit) {
    return !IsOccluder(scene, hit.element);
  });
  if (solid == overhead.end()) return std::nullopt;
  if (IsGround(scene, solid->element)) return "is below the ground";
  // Under a roof; inside when there are walls on nearly all sides as well. (Counting the surfaces
  // above would fail on models that are not closed.)
  constexpr int kSides = 16;
  constexpr int kOpen = 3;
  constexpr double kFar_m = 100;
  int closed = 0;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * (i + 0.37) / kSides;
    const auto hit = scene.cast(place, {std::cos(angle), std::sin(angle), 0});
    if (hit && hit->distance < kFar_m && !IsOccluder(scene, hit->element)) ++closed;
  }
  if (closed > kSides - kOpen) {
    const std::string_view name = NameOf(scene, solid->element);
    return fmt::format("stands inside {}", name.empty() ? "a building" : name);
  }
  const bool has_floor = scene.cast(place, -Eigen::Vector3d::UnitZ()).has_value();
  if (!has_floor) return "is below the ground";
  return std::nullopt;
}

std::optional<std::string> TreeInTheWay(const SceneShape& scene, const Eigen::Vector3d& place) {
  // Beside a tree, leaves hide at most half of what is around; what looks down may meet the ground
  // between stem and leaves.
  constexpr int kDirections = 256;
  constexpr int kHidden = 180;
  constexpr double kWide_m = 8;
  // From the camera to the tips of the rotors of a drone of 0.9 kg (Mavic 3: 0.38 m from motor to
  // motor, rotors of 0.24 m).
  constexpr double kRotors_m = 0.35;
  int hidden = 0;
  std::string_view name;
  for (int i = 0; i < kDirections; ++i) {
    const auto hit = scene.cast(place, OnSphere(i, kDirections));
    if (!hit || hit->distance > kWide_m || !IsOccluder(scene, hit->element)) continue;
    name = NameOf(scene, hit->element);
    if (hit->distance < kRotors_m) return std::string(name);
    ++hidden;
  }
  if (hidden < kHidden) return std::nullopt;
  return std::string(name);
}

}  // namespace stucco::simulate
