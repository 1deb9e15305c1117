// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/regularise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "survey/attitude.h"
#include "survey/degree.h"

namespace stucco {
namespace {

constexpr double kPi = std::numbers::pi;

// Horizontal axes of the world around `up`.
struct Compass {
  Eigen::Vector3d up, east, north;
  explicit Compass(const Eigen::Vector3d& upwards)
      : up(upwards), east(AnyPerpendicular(upwards)), north(up.cross(east)) {}
  double Azimuth(const Eigen::Vector3d& normal) const {
    return std::atan2(normal.dot(north), normal.dot(east));
  }
  Eigen::Vector3d Direction(double azimuth) const {
    return std::cos(azimuth) * east + std::sin(azimuth) * north;
  }
};

// What turning a plane depends on besides the plane.
struct Surroundings {
  const Samples& samples;
  const Tolerances& tolerances;
  Compass compass;
};

// How far the plane's points lie from the axis through their centre: what turning it around that
// axis moves. The 95 % quantile, so that a few far samples do not forbid everything.
double Reach(const Samples& samples, const Plane& plane, const Eigen::Vector3d& axis) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : plane.points) mean += samples.positions[i];
  mean /= std::max<double>(1, double(plane.points.size()));
  std::vector<double> distances;
  for (const int i : plane.points) {
    distances.push_back((samples.positions[i] - mean).cross(axis).norm());
  }
  if (distances.empty()) return 0;
  const size_t rank = distances.size() * 95 / 100;
  std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(rank), distances.end());
  return distances[rank];
}

// Whether a plane may be turned by the angle around the axis: by up to `tolerance` when no point
// moves by more than the level of detail, by up to 20 degrees when none moves by half of it (the
// direction of a narrow plane is uncertain).
bool MayTurn(const Surroundings& around, const Plane& plane, const Eigen::Vector3d& axis,
             double angle, double tolerance) {
  constexpr double kMost = 20 * kDegree;
  const double detail = around.tolerances.level_of_detail;
  const double move = Reach(around.samples, plane, axis) * std::abs(std::sin(angle));
  if (std::abs(angle) <= tolerance) return move <= detail;
  return tolerance > 0 && std::abs(angle) <= kMost && move <= detail / 2;
}

// How far a plane looks above the horizon, in radians.
double Elevation(const Plane& plane, const Eigen::Vector3d& up) {
  return std::asin(std::clamp(plane.normal.dot(up), -1.0, 1.0));
}

bool MayStandUpright(const Surroundings& around, double tolerance, const Plane& plane) {
  const Eigen::Vector3d& up = around.compass.up;
  const Eigen::Vector3d axis = up.cross(plane.normal).normalized();
  return MayTurn(around, plane, axis, Elevation(plane, up), tolerance);
}

// A wall stands upright when that moves none of its points too far; one that leans keeps its lean.
bool MakeWall(const Surroundings& around, double tolerance, Plane& plane) {
  const Eigen::Vector3d& up = around.compass.up;
  constexpr double kLeansOut = 25 * kDegree;  // roofs do not lean outwards: fronts of dormers do
  const double elevation = Elevation(plane, up);
  const bool upright = MayStandUpright(around, tolerance, plane);
  const bool leans = elevation > -kLeansOut && elevation < tolerance;
  if (!upright && !leans) return false;
  plane.role = PlaneRole::kWall;
  if (upright) plane.normal = (plane.normal - up * plane.normal.dot(up)).normalized();
  return true;
}

void SetRoles(const Surroundings& around, const RegulariseOptions& options,
              std::vector<Plane>& planes) {
  const Eigen::Vector3d& up = around.compass.up;
  const double vertical = options.vertical_tolerance_deg * kDegree;
  const double flat = vertical / 2;
  for (Plane& plane : planes) {
    const double elevation = Elevation(plane, up);
    if (MakeWall(around, vertical, plane)) {
      // Its role is set.
    } else if (std::abs(elevation) > kPi / 2 - 4 * flat) {
      plane.role = elevation > 0 ? PlaneRole::kHorizontal : PlaneRole::kCeiling;
      const Eigen::Vector3d level = elevation > 0 ? up : Eigen::Vector3d(-up);
      const Eigen::Vector3d axis = level.cross(plane.normal);
      const double tilt = AngleBetween(level, plane.normal);
      const bool small = axis.norm() < 1e-12;
      if (small || MayTurn(around, plane, axis.normalized(), tilt, flat)) {
        plane.normal = level;
      } else if (tilt > flat) {
        plane.role = elevation > 0 ? PlaneRole::kSlope : PlaneRole::kCeiling;
      }
    } else {
      plane.role = elevation > 0 ? PlaneRole::kSlope : PlaneRole::kCeiling;
    }
    RefitOffset(around.samples, around.tolerances.epsilon, plane);
  }
}

// The angle of `azimuth` to the nearest of base + k * 90 degrees, in (-45, 45] degrees.
double ToGrid(double azimuth, double base) {
  const double quarter = kPi / 2;
  return std::remainder(azimuth - base, quarter);
}

// Peak of the wall area over azimuths folded to 90 degrees, refined by the mean around it. The
// kernel is narrow, so that walls of another direction do not pull.
double MainAzimuth(std::span<const Plane* const> walls, const Compass& compass) {
  constexpr int kBins = 180;
  constexpr double kWidth = 2 * kDegree;
  double best = -1, base = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double candidate = bin * kPi / 2 / kBins;
    double votes = 0, sum = 0;
    for (const Plane* wall : walls) {
      const double off = ToGrid(compass.Azimuth(wall->normal), candidate);
      if (std::abs(off) > kWidth) continue;
      const double weight = wall->area * (1 - std::abs(off) / kWidth);
      votes += weight;
      sum += weight * off;
    }
    if (votes <= best) continue;
    best = votes;
    base = candidate + (votes > 0 ? sum / votes : 0);
  }
  return base;
}

// Turns a plane around up towards an azimuth when that keeps its points in place.
bool TurnTo(const Surroundings& around, double azimuth, double tolerance, Plane& plane) {
  const Compass& compass = around.compass;
  const double turn = std::remainder(azimuth - compass.Azimuth(plane.normal), 2 * kPi);
  if (!MayTurn(around, plane, compass.up, turn, tolerance)) return false;
  const double along = plane.normal.dot(compass.up);
  plane.normal =
      along * compass.up + std::sqrt(std::max(0.0, 1 - along * along)) * compass.Direction(azimuth);
  plane.normal.normalize();
  RefitOffset(around.samples, around.tolerances.epsilon, plane);
  return true;
}

// Aligns walls to grids of perpendicular directions, the one with most area first; returns the
// grids' base azimuths.
std::vector<double> AlignWalls(const Surroundings& around, double tolerance,
                               std::vector<Plane>& planes) {
  const Compass& compass = around.compass;
  std::vector<Plane*> open;
  for (Plane& plane : planes) {
    if (plane.role == PlaneRole::kWall) open.push_back(&plane);
  }
  std::vector<double> bases;
  while (!open.empty() && tolerance > 0) {
    const double base = MainAzimuth(open, compass);
    bases.push_back(base);
    const size_t before = open.size();
    std::erase_if(open, [&](Plane* wall) {
      const double azimuth = compass.Azimuth(wall->normal);
      const double off = ToGrid(azimuth, base);
      if (TurnTo(around, azimuth - off, tolerance, *wall)) return true;
      return std::abs(off) <= tolerance;
    });
    if (open.size() == before) break;
  }
  return bases;
}

void AlignSlopes(const Surroundings& around, const std::vector<double>& bases, double tolerance,
                 std::vector<Plane>& planes) {
  for (Plane& plane : planes) {
    if (plane.role != PlaneRole::kSlope) continue;
    const double azimuth = around.compass.Azimuth(plane.normal);
    for (const double base : bases) {
      const double off = ToGrid(azimuth, base);
      if (TurnTo(around, azimuth - off, 1.5 * tolerance, plane)) break;
    }
  }
}

// Slopes of nearly one pitch get the mean of their pitches.
void EqualisePitches(const Surroundings& around, double tolerance, std::vector<Plane>& planes) {
  const Compass& compass = around.compass;
  const auto pitch_of = [&](const Plane& plane) {
    return std::asin(std::clamp(plane.normal.dot(compass.up), -1.0, 1.0));
  };
  std::vector<int> open;
  for (size_t i = 0; i < planes.size(); ++i) {
    if (planes[i].role == PlaneRole::kSlope) open.push_back(static_cast<int>(i));
  }
  std::stable_sort(open.begin(), open.end(),
                   [&](int a, int b) { return planes[a].area > planes[b].area; });
  std::vector<bool> done(planes.size(), false);
  for (const int first : open) {
    if (done[first]) continue;
    std::vector<int> group;
    double sum = 0, weight = 0;
    for (const int i : open) {
      if (done[i] || std::abs(pitch_of(planes[i]) - pitch_of(planes[first])) > tolerance / 2) {
        continue;
      }
      group.push_back(i);
      sum += planes[i].area * pitch_of(planes[i]);
      weight += planes[i].area;
    }
    const double pitch = sum / weight;
    for (const int i : group) {
      done[i] = true;
      const Eigen::Vector3d axis = compass.up.cross(planes[i].normal).normalized();
      if (!MayTurn(around, planes[i], axis, pitch - pitch_of(planes[i]), tolerance)) {
        continue;
      }
      planes[i].normal = std::sin(pitch) * compass.up +
                         std::cos(pitch) * compass.Direction(compass.Azimuth(planes[i].normal));
      RefitOffset(around.samples, around.tolerances.epsilon, planes[i]);
    }
  }
}

// Planes of one direction whose offsets differ by less than level_of_detail become one, largest
// first.
void JoinParallel(const Samples& samples, const Tolerances& tolerances,
                  std::vector<Plane>& planes) {
  constexpr double kSameDirection = 0.2 * kDegree;
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.area > b.area; });
  for (size_t a = 0; a < planes.size(); ++a) {
    if (planes[a].points.empty()) continue;
    const double offset = planes[a].offset;
    bool joined = false;
    for (size_t b = a + 1; b < planes.size(); ++b) {
      if (planes[b].points.empty() || planes[b].role != planes[a].role ||
          AngleBetween(planes[a].normal, planes[b].normal) > kSameDirection ||
          std::abs(planes[b].offset - offset) > tolerances.level_of_detail) {
        continue;
      }
      auto& points = planes[a].points;
      points.insert(points.end(), planes[b].points.begin(), planes[b].points.end());
      planes[b].points.clear();
      joined = true;
    }
    if (!joined) continue;
    std::sort(planes[a].points.begin(), planes[a].points.end());
    RefitOffset(samples, tolerances.level_of_detail, planes[a]);
  }
  std::erase_if(planes, [](const Plane& plane) { return plane.points.empty(); });
}

// What turning and joining took off the planes is theirs no more; planes without enough left go.
void DropFarPoints(const Samples& samples, const Tolerances& tolerances,
                   std::vector<Plane>& planes) {
  for (Plane& plane : planes) {
    std::erase_if(plane.points, [&](int i) {
      return std::abs(plane.DistanceTo(samples.positions[i])) > tolerances.level_of_detail;
    });
    Measure(samples, 2.5 * tolerances.spacing, plane);
  }
  std::erase_if(planes, [&](const Plane& plane) { return plane.area < tolerances.min_area; });
}

}  // namespace

void AssignRoles(const Samples& samples, const Tolerances& tolerances, const Eigen::Vector3d& up,
                 const RegulariseOptions& options, std::vector<Plane>& planes) {
  SetRoles({samples, tolerances, Compass(up)}, options, planes);
}

Eigen::Vector3d MainDirection(const Eigen::Vector3d& up, std::span<const Plane* const> planes) {
  std::vector<const Plane*> walls;
  std::ranges::copy_if(planes, std::back_inserter(walls),
                       [](const Plane* plane) { return plane->role == PlaneRole::kWall; });
  const Compass compass(up);
  return compass.Direction(MainAzimuth(walls, compass));
}

void Regularise(const Samples& samples, const Tolerances& tolerances, const Eigen::Vector3d& up,
                const RegulariseOptions& options, std::vector<Plane>& planes) {
  const Surroundings around{samples, tolerances, Compass(up)};
  const double tolerance = options.align_tolerance_deg * kDegree;
  SetRoles(around, options, planes);
  const auto bases = AlignWalls(around, tolerance, planes);
  if (tolerance > 0) {
    AlignSlopes(around, bases, tolerance, planes);
    EqualisePitches(around, tolerance, planes);
  }
  JoinParallel(samples, tolerances, planes);
  DropFarPoints(samples, tolerances, planes);
}

}  // namespace stucco
