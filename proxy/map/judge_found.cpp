// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/judge_found.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "proxy/map/floors.h"
#include "proxy/map/registration.h"

namespace stucco {
namespace {

constexpr double kOnOutline_m = 1;  // of a wall to an outline that it stands on
constexpr double kDeep_m = 0.6;     // deeper than windows and doors stand back

// A roof as a plane over a polygon of the ground plan.
struct RoofOver {
  Polygon outline;
  Eigen::AlignedBox2d box;
  Eigen::Vector3d normal;
  double offset = 0;

  double HeightAt(const Eigen::Vector2d& p) const {
    return (offset - normal.head<2>().dot(p)) / normal.z();
  }
};

std::vector<RoofOver> RoofsOf(const ClosedBuilding& closed,
                              const Eigen::Matrix3d& upright_from_world) {
  std::vector<RoofOver> roofs;
  for (const Facet& facet : closed.facets) {
    if (facet.facet_class != FacetClass::kRoof) continue;
    const Polygon outline = InGroundPlan(facet, upright_from_world);
    roofs.push_back({outline, BoundsOf(outline), upright_from_world * facet.normal, facet.offset});
  }
  return roofs;
}

bool IsBelow(const std::vector<RoofOver>& roofs, const Eigen::Vector3d& p) {
  const Eigen::Vector2d place = p.head<2>();
  return std::ranges::any_of(roofs, [&](const RoofOver& roof) {
    return roof.box.contains(place) && Contains(roof.outline, place) &&
           p.z() < roof.HeightAt(place) - kDeep_m;
  });
}

}  // namespace

FoundHouses::FoundHouses(const PlanarScene& scene, const UprightSurvey& survey)
    : survey_(survey), upright_from_world_(UprightFromWorld(scene.up)) {
  constexpr double kUpright = 0.01;  // sine: regularised walls stand upright, or lean
  for (const std::vector<Plane>& cluster : scene.buildings) {
    for (const Plane& plane : cluster) {
      if (IsOfLeaves(scene, plane)) continue;
      Surface surface{.plane = &plane, .box = {}};
      for (const int i : plane.points) surface.box.extend(survey.samples.positions[i].head<2>());
      const Eigen::Vector3d normal = upright_from_world_ * plane.normal;
      surface.leans = LooksLikeWall(normal) && std::abs(normal.z()) >= kUpright;
      surfaces_.push_back(surface);
    }
  }
}

// Of the area of its walls, how much leans on its outline.
double FoundHouses::LeaningShare(const ClosedBuilding& closed) const {
  const Eigen::AlignedBox2d box = BoundsOf(closed.fitted.building, kOnOutline_m);
  double leaning = 0, walls = 0;
  for (const Surface& surface : surfaces_) {
    if (!surface.leans || !box.intersects(surface.box)) continue;
    const auto near = std::ranges::count_if(surface.plane->points, [&](int i) {
      const Eigen::Vector2d place = survey_.samples.positions[i].head<2>();
      return ToOutline(closed.fitted.building, place) < kOnOutline_m;
    });
    if (2 * static_cast<size_t>(near) > surface.plane->points.size()) {
      leaning += surface.plane->area;
    }
  }
  for (const Facet& facet : closed.facets) {
    if (facet.facet_class == FacetClass::kWall) walls += facet.area;
  }
  return walls > 0 ? leaning / walls : 0;
}

// Of what lies on planes in and around its outline, the share that is well inside of the solid.
double FoundHouses::InsideShare(const ClosedBuilding& closed) const {
  constexpr size_t kEnough = 20'000;
  const Eigen::AlignedBox2d box = BoundsOf(closed.fitted.building, kDeep_m);
  std::vector<int> samples;
  for (const Surface& surface : surfaces_) {
    if (!box.intersects(surface.box)) continue;
    for (const int i : surface.plane->points) {
      if (box.contains(survey_.samples.positions[i].head<2>())) samples.push_back(i);
    }
  }
  const std::vector<RoofOver> roofs = RoofsOf(closed, upright_from_world_);
  const size_t step = samples.size() / kEnough + 1;
  size_t of_house = 0, inside = 0;
  for (size_t s = 0; s < samples.size(); s += step) {
    const Eigen::Vector3d& p = survey_.samples.positions[samples[s]];
    if (DistanceTo(closed.fitted.building, p.head<2>()) > kDeep_m) continue;
    ++of_house;
    const bool deep = ToOutline(closed.fitted.building, p.head<2>()) >= kDeep_m;
    inside += deep && IsBelow(roofs, p);
  }
  return of_house > 0 ? static_cast<double>(inside) / static_cast<double>(of_house) : 0;
}

std::string FoundHouses::WhyNot(const ClosedBuilding& closed) const {
  constexpr double kLeastHeld = 0.5;
  constexpr double kMostLeaning = 0.1;
  constexpr double kMostInside = 0.15;
  const bool shows_walls = !survey_.samples.camera_centers.empty();
  if (shows_walls && closed.fitted.held < kLeastHeld) {
    return fmt::format("walls were found along {:.0f} % of that", 100 * closed.fitted.held);
  }
  if (LeaningShare(closed) > kMostLeaning) return "its walls lean";
  const double inside = InsideShare(closed);
  if (inside > kMostInside) return fmt::format("it is hollow: {:.0f} % lies inside", 100 * inside);
  return "";
}

}  // namespace stucco
