// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/consolidate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

namespace stucco {
namespace {

double CosDeg(double angle_deg) {
  return std::cos(angle_deg * std::numbers::pi / 180);
}

bool IsOn(const Samples& samples, int i, const Plane& plane, double distance, double min_cos) {
  return std::abs(plane.DistanceTo(samples.positions[i])) <= distance &&
         plane.normal.dot(samples.normals[i]) >= min_cos;
}

bool LiesOn(const Samples& samples, const Plane& small, const Plane& large, double epsilon,
            double min_cos) {
  // The rough test first: most pairs fail it.
  if (large.normal.dot(small.normal) < min_cos) return false;
  constexpr size_t kProbes = 400;
  constexpr double kShare = 0.85;
  const size_t stride = std::max<size_t>(1, small.points.size() / kProbes);
  size_t near = 0, tried = 0;
  for (size_t k = 0; k < small.points.size(); k += stride, ++tried) {
    near += IsOn(samples, small.points[k], large, epsilon, min_cos);
  }
  return near >= kShare * static_cast<double>(tried);
}

void SortBySize(std::vector<Plane>& planes) {
  std::stable_sort(planes.begin(), planes.end(), [](const Plane& a, const Plane& b) {
    return a.points.size() > b.points.size();
  });
}

void MovePoints(Plane& from, Plane& to) {
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  from.points.clear();
}

constexpr int kNoPlane = -1;

// The plane of each sample.
std::vector<int> PlaneOfEach(const Samples& samples, const std::vector<Plane>& planes) {
  std::vector<int> plane_of(samples.size(), kNoPlane);
  for (size_t p = 0; p < planes.size(); ++p) {
    for (const int i : planes[p].points) plane_of[i] = static_cast<int>(p);
  }
  return plane_of;
}

double AdoptionCos(double normal_angle_deg) {
  return CosDeg(std::min(85.0, 1.3 * normal_angle_deg));
}

// The points of one plane that lie on another one.
std::vector<int> PointsOn(const Samples& samples, const Plane& plane, const Plane& other,
                          double distance, double min_cos) {
  std::vector<int> on;
  std::copy_if(plane.points.begin(), plane.points.end(), std::back_inserter(on),
               [&](int i) { return IsOn(samples, i, other, distance, min_cos); });
  return on;
}

// The planes of the samples near a plane's own.
std::set<int> Beside(const Samples& samples, const GridIndex& index, double radius,
                     const std::vector<int>& plane_of, const Plane& plane) {
  std::set<int> beside;
  for (const int i : plane.points) {
    index.ForEachNear(samples.positions[i], radius, [&](int j) {
      if (plane_of[j] != plane_of[i] && plane_of[j] != kNoPlane) beside.insert(plane_of[j]);
    });
  }
  return beside;
}

}  // namespace

void MergeCoplanar(const Samples& samples, const Tolerances& tolerances, double normal_angle_deg,
                   std::vector<Plane>& planes) {
  const double min_cos = CosDeg(normal_angle_deg);
  for (bool merged = true; merged;) {
    merged = false;
    SortBySize(planes);
    for (size_t a = 0; a < planes.size(); ++a) {
      const size_t before = planes[a].points.size();
      for (size_t b = a + 1; b < planes.size(); ++b) {
        if (planes[b].points.empty()) continue;
        if (!LiesOn(samples, planes[b], planes[a], tolerances.epsilon, min_cos)) continue;
        MovePoints(planes[b], planes[a]);
      }
      if (planes[a].points.size() == before) continue;
      std::sort(planes[a].points.begin(), planes[a].points.end());
      Refit(samples, planes[a]);
      merged = true;
    }
    std::erase_if(planes, [](const Plane& plane) { return plane.points.empty(); });
  }
}

void AdoptNeighbours(const Samples& samples, const GridIndex& index, const Tolerances& tolerances,
                     double normal_angle_deg, std::vector<Plane>& planes) {
  constexpr int kRounds = 3;
  const double min_cos = AdoptionCos(normal_angle_deg);
  std::vector<int> plane_of = PlaneOfEach(samples, planes);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::pair<int, int>> adopted;  // sample, plane
    for (size_t i = 0; i < samples.size(); ++i) {
      if (plane_of[i] != kNoPlane) continue;
      int best = kNoPlane;
      double best_distance = tolerances.epsilon;
      int last = kNoPlane;
      index.ForEachNear(samples.positions[i], tolerances.radius, [&](int j) {
        const int p = plane_of[j];
        if (p == kNoPlane || p == last) return;
        last = p;
        const double distance = std::abs(planes[p].DistanceTo(samples.positions[i]));
        if (distance > best_distance || planes[p].normal.dot(samples.normals[i]) < min_cos) return;
        if (distance == best_distance && p >= best && best != kNoPlane) return;
        best_distance = distance;
        best = p;
      });
      if (best != kNoPlane) adopted.emplace_back(static_cast<int>(i), best);
    }
    for (const auto& [i, p] : adopted) {
      plane_of[i] = p;
      planes[p].points.push_back(i);
    }
    if (adopted.empty()) break;
  }
  for (Plane& plane : planes) std::sort(plane.points.begin(), plane.points.end());
}

void TakeApartIdle(const Samples& samples, const Tolerances& tolerances, double normal_angle_deg,
                   const PlaneUse& use, std::vector<Plane>& planes) {
  assert(use.idle.size() == planes.size() && use.building.size() == planes.size());
  constexpr double kLeastShare = 0.5;
  const double min_cos = AdoptionCos(normal_angle_deg);
  const GridIndex index(samples.positions, tolerances.radius);
  std::vector<int> plane_of = PlaneOfEach(samples, planes);
  const auto take_apart = [&](size_t p) {
    Plane& plane = planes[p];
    std::vector<int> most;
    int host = kNoPlane;
    for (const int q : Beside(samples, index, tolerances.radius, plane_of, plane)) {
      if (use.idle[q] || use.building[q] != use.building[p]) continue;
      auto on = PointsOn(samples, plane, planes[q], tolerances.level_of_detail, min_cos);
      if (on.size() <= most.size()) continue;
      most = std::move(on);
      host = q;
    }
    if (double(most.size()) < kLeastShare * double(plane.points.size())) return false;
    for (const int i : plane.points) plane_of[i] = kNoPlane;
    for (const int i : most) plane_of[i] = host;
    plane.points = std::move(most);
    MovePoints(plane, planes[host]);
    return true;
  };
  // What goes may bring the next one beside a plane.
  for (bool any = true; any;) {
    any = false;
    for (size_t p = 0; p < planes.size(); ++p) {
      if (use.idle[p] && !planes[p].points.empty()) any |= take_apart(p);
    }
  }
  for (Plane& plane : planes) {
    std::sort(plane.points.begin(), plane.points.end());
    Measure(samples, 2.5 * tolerances.spacing, plane);
  }
}

double NormalScatterDeg(const Samples& samples, const Plane& plane) {
  double sum = 0;
  for (const int i : plane.points) {
    sum += std::acos(std::clamp(plane.normal.dot(samples.normals[i]), -1.0, 1.0));
  }
  return plane.points.empty() ? 0 : sum / double(plane.points.size()) * 180 / std::numbers::pi;
}

double LeafScatterDeg(const Samples& samples, std::span<const std::vector<Plane>> buildings) {
  constexpr double kMore_deg = 6;
  constexpr double kSmoothest = 0.25;               // the rest may be trees
  std::vector<std::pair<double, double>> scatters;  // with areas
  double area = 0;
  for (const std::vector<Plane>& building : buildings) {
    for (const Plane& plane : building) {
      scatters.emplace_back(NormalScatterDeg(samples, plane), plane.area);
      area += plane.area;
    }
  }
  std::ranges::sort(scatters);
  double below = 0;
  for (const auto& [scatter, of_plane] : scatters) {
    below += of_plane;
    if (below >= kSmoothest * area) return scatter + kMore_deg;
  }
  return std::numeric_limits<double>::infinity();
}

void DropClutter(const Samples& samples, const Tolerances& tolerances, double normal_angle_deg,
                 std::vector<Plane>& planes) {
  // Points spread evenly over [-epsilon, epsilon] have an rms of 0.577 epsilon.
  constexpr double kLargestRms = 0.52;
  constexpr double kLargestScatter = 0.62;  // of normal_angle_deg
  for (Plane& plane : planes) Measure(samples, 2.5 * tolerances.spacing, plane);
  std::erase_if(planes, [&](const Plane& plane) {
    if (plane.area < tolerances.min_area) return true;
    const double scatter = NormalScatterDeg(samples, plane);
    const bool thick = plane.rms > kLargestRms * tolerances.epsilon;
    const bool rough = scatter > kLargestScatter * normal_angle_deg;
    return rough || (thick && scatter > 0.45 * normal_angle_deg);
  });
}

}  // namespace stucco
