// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/ground_around.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr size_t kSectors = 8;
constexpr size_t kFewestSectors = 5;
constexpr double kOnPlane_m = 0.3;
constexpr double kSteepest = 0.7;  // 35 degrees

// What looks up next to a building.
std::vector<Eigen::Vector3d> RingAround(const UprightSurvey& survey, const MapBuilding& building) {
  constexpr double kUpwards = 0.8;  // 37 degrees
  std::vector<Eigen::Vector3d> ring;
  for (const int i : survey.bins.In(BoundsOf(building, kRing_m))) {
    const Eigen::Vector3d& p = survey.samples.positions[i];
    if (survey.samples.normals[i].z() < kUpwards) continue;
    const double distance = DistanceTo(building, p.head<2>());
    if (distance > 0 && distance < kRing_m) ring.push_back(p);
  }
  return ring;
}

using Sectors = std::array<std::vector<Eigen::Vector3d>, kSectors>;

Sectors LookAround(const UprightSurvey& survey, const MapBuilding& building) {
  const Eigen::Vector2d middle = BoundsOf(building, 0).center();
  Sectors sectors;
  for (const Eigen::Vector3d& p : RingAround(survey, building)) {
    const double turn = std::atan2(p.y() - middle.y(), p.x() - middle.x()) / std::numbers::pi;
    const auto sector = static_cast<size_t>((turn + 1) / 2 * kSectors);
    sectors[std::min(sector, kSectors - 1)].push_back(p);
  }
  return sectors;
}

// The middle of the lowest samples; strays lie below all ground.
std::optional<Eigen::Vector3d> LowestOf(std::vector<Eigen::Vector3d> samples) {
  constexpr size_t kFewest = 8;
  constexpr double kLowest = 0.05;
  if (samples.size() < kFewest) return std::nullopt;
  std::ranges::sort(samples, {}, [](const Eigen::Vector3d& p) { return p.z(); });
  const double low =
      samples[static_cast<size_t>(kLowest * static_cast<double>(samples.size()))].z();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Eigen::Vector3d& p : samples) {
    if (std::abs(p.z() - low) > kOnPlane_m) continue;
    sum += p;
    ++count;
  }
  return Eigen::Vector3d(sum / count);
}

// The plane closest to some points, least squares of heights; nothing where they lie in a line.
std::optional<GroundSlope> PlaneOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::MatrixX3d places(points.size(), 3);
  Eigen::VectorXd heights(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) << points[i].x(), points[i].y(), 1;
    heights[static_cast<Eigen::Index>(i)] = points[i].z();
  }
  const auto solver = places.colPivHouseholderQr();
  if (solver.rank() < 3) return std::nullopt;
  const Eigen::Vector3d plane = solver.solve(heights);
  return GroundSlope{.rise = plane.head<2>(), .height = plane.z()};
}

// Of the points those on the plane; none where one lies below it.
std::vector<Eigen::Vector3d> OnPlane(const std::vector<Eigen::Vector3d>& points,
                                     const GroundSlope& plane) {
  std::vector<Eigen::Vector3d> on;
  for (const Eigen::Vector3d& p : points) {
    const double above = p.z() - plane.At(p.head<2>());
    if (above < -kOnPlane_m) return {};
    if (above < kOnPlane_m) on.push_back(p);
  }
  return on;
}

constexpr double kThickness_m = 0.3;  // of ground with grass and noise

}  // namespace

std::optional<double> GroundAround(const UprightSurvey& survey, const MapBuilding& building) {
  constexpr size_t kFewest = 20;
  constexpr double kLowest = 0.05;  // share; strays lie below all ground
  std::vector<double> heights;
  for (const Eigen::Vector3d& p : RingAround(survey, building)) heights.push_back(p.z());
  if (heights.size() < kFewest) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  const double low = heights[static_cast<size_t>(kLowest * static_cast<double>(heights.size()))];
  std::erase_if(heights, [&](double z) { return std::abs(z - low) > kThickness_m; });
  return Median(heights);
}

bool LiesOnNeighbours(const UprightSurvey& survey, const MapBuilding& building, double height,
                      std::span<const MapBuilding* const> neighbours) {
  constexpr double kBeside_m = 1;  // maps lie that much beside what they show
  constexpr double kMost = 0.8;
  int all = 0, on = 0;
  for (const Eigen::Vector3d& p : RingAround(survey, building)) {
    if (std::abs(p.z() - height) > kThickness_m) continue;
    ++all;
    on += std::ranges::any_of(neighbours, [&](const MapBuilding* neighbour) {
      return DistanceTo(*neighbour, p.head<2>()) < kBeside_m;
    });
  }
  return on > kMost * all;
}

std::optional<GroundSlope> SlopeAround(const UprightSurvey& survey, const MapBuilding& building) {
  std::vector<Eigen::Vector3d> lowest;
  for (auto& sector : LookAround(survey, building)) {
    if (const auto low = LowestOf(std::move(sector))) lowest.push_back(*low);
  }
  if (lowest.size() < kFewestSectors) return std::nullopt;
  std::vector<Eigen::Vector3d> best;
  for (size_t a = 0; a < lowest.size(); ++a) {
    for (size_t b = a + 1; b < lowest.size(); ++b) {
      for (size_t c = b + 1; c < lowest.size(); ++c) {
        const auto plane = PlaneOf({lowest[a], lowest[b], lowest[c]});
        if (!plane || plane->rise.norm() > kSteepest) continue;
        std::vector<Eigen::Vector3d> on = OnPlane(lowest, *plane);
        if (on.size() > best.size()) best = std::move(on);
      }
    }
  }
  if (best.size() < kFewestSectors) return std::nullopt;
  return PlaneOf(best);
}

}  // namespace stucco
