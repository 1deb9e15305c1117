// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/judge_found.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "proxy/map/floors.h"
#include "proxy/map/registration.h"
#include "proxy/planes/consolidate.h"

namespace stucco {
namespace {

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

std::vector<RoofOver> RoofsOf(const ClosedBuilding& closed, const Eigen::Matrix3d& upright) {
  std::vector<RoofOver> roofs;
  for (const Facet& facet : closed.facets) {
    if (facet.facet_class != FacetClass::kRoof) continue;
    RoofOver& roof = roofs.emplace_back();
    roof.normal = upright * facet.normal;
    roof.offset = facet.offset;
    const auto add = [&](const std::vector<Eigen::Vector3d>& corners) {
      Ring& ring = roof.outline.rings.emplace_back();
      for (const auto& p : corners) ring.push_back((upright * p).head<2>());
    };
    add(facet.outer);
    for (const auto& hole : facet.holes) add(hole);
    roof.box = BoundsOf(roof.outline);
  }
  return roofs;
}

class FoundHouse {
 public:
  FoundHouse(const ClosedBuilding& closed, const PlanarScene& scene, const UprightSurvey& survey)
      : closed_(closed), scene_(scene), survey_(survey), upright_(UprightFromWorld(scene.up)) {}

  // Of the area of its walls, how much leans on its outline.
  double LeaningShare() const {
    double leaning = 0, walls = 0;
    ForEachPlane([&](const Plane& plane) { leaning += Leans(plane) ? plane.area : 0; });
    for (const Facet& facet : closed_.facets) {
      if (facet.facet_class == FacetClass::kWall) walls += facet.area;
    }
    return walls > 0 ? leaning / walls : 0;
  }

  // Of what lies on planes in and around its outline, the share that is well inside of the solid.
  double InsideShare() const {
    constexpr size_t kEnough = 20'000;
    const Eigen::AlignedBox2d box = BoundsOf(closed_.fitted.building, kDeep_m);
    std::vector<int> samples;
    ForEachPlane([&](const Plane& plane) {
      for (const int i : plane.points) {
        if (box.contains(Eigen::Vector2d(Place(i).head<2>()))) samples.push_back(i);
      }
    });
    const std::vector<RoofOver> roofs = RoofsOf(closed_, upright_);
    const size_t step = samples.size() / kEnough + 1;
    size_t of_house = 0, inside = 0;
    for (size_t s = 0; s < samples.size(); s += step) {
      const Eigen::Vector3d& p = Place(samples[s]);
      if (DistanceTo(closed_.fitted.building, p.head<2>()) > kDeep_m) continue;
      ++of_house;
      inside += IsInside(p, roofs);
    }
    return of_house > 0 ? static_cast<double>(inside) / static_cast<double>(of_house) : 0;
  }

 private:
  static constexpr double kDeep_m = 0.6;  // deeper than windows and doors stand back

  template <typename Visit>
  void ForEachPlane(const Visit& visit) const {
    for (const std::vector<Plane>& cluster : scene_.buildings) {
      for (const Plane& plane : cluster) {
        if (NormalScatterDeg(scene_.samples, plane) < scene_.leaf_scatter_deg) visit(plane);
      }
    }
  }

  const Eigen::Vector3d& Place(int sample) const { return survey_.samples.positions[sample]; }

  bool Leans(const Plane& plane) const {
    constexpr double kUpright = 0.01;  // sine: regularised walls stand upright, or lean
    constexpr double kReach_m = 1;
    const Eigen::Vector3d normal = upright_ * plane.normal;
    if (!LooksLikeWall(normal) || std::abs(normal.z()) < kUpright) return false;
    const auto near = std::ranges::count_if(plane.points, [&](int i) {
      return ToOutline(closed_.fitted.building, Place(i).head<2>()) < kReach_m;
    });
    return 2 * static_cast<size_t>(near) > plane.points.size();
  }

  bool IsInside(const Eigen::Vector3d& p, const std::vector<RoofOver>& roofs) const {
    const Eigen::Vector2d place = p.head<2>();
    if (ToOutline(closed_.fitted.building, place) < kDeep_m) return false;
    return std::ranges::any_of(roofs, [&](const RoofOver& roof) {
      return roof.box.contains(place) && Contains(roof.outline, place) &&
             p.z() < roof.HeightAt(place) - kDeep_m;
    });
  }

  const ClosedBuilding& closed_;
  const PlanarScene& scene_;
  const UprightSurvey& survey_;
  Eigen::Matrix3d upright_;
};

}  // namespace

std::string WhyNotOnFootprint(const ClosedBuilding& closed, const PlanarScene& scene,
                              const UprightSurvey& survey) {
  constexpr double kLeastHeld = 0.5;
  constexpr double kMostLeaning = 0.1;
  constexpr double kMostInside = 0.15;
  const bool shows_walls = !survey.samples.camera_centers.empty();
  if (shows_walls && closed.fitted.held < kLeastHeld) {
    return fmt::format("walls were found along {:.0f} % of that", 100 * closed.fitted.held);
  }
  const FoundHouse house(closed, scene, survey);
  if (house.LeaningShare() > kMostLeaning) return "its walls lean";
  const double inside = house.InsideShare();
  if (inside > kMostInside) return fmt::format("it is hollow: {:.0f} % lies inside", 100 * inside);
  return "";
}

}  // namespace stucco
