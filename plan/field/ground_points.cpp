// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/field/ground_points.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

constexpr double kAround_m = 15;
constexpr double kFromWalls_m = 3;
constexpr int kFewestPhotos = 4;

// A third of the box in each direction, from 0 in the south and west to 2.
struct Part {
  int column;
  int row;
  const char* where;
};
constexpr Part kControl[] = {{0, 0, "south-west corner"},
                             {2, 0, "south-east corner"},
                             {2, 2, "north-east corner"},
                             {0, 2, "north-west corner"},
                             {1, 1, "middle"}};
constexpr Part kCheckWide[] = {{0, 1, "west side"}, {2, 1, "east side"}};
constexpr Part kCheckTall[] = {{1, 0, "south side"}, {1, 2, "north side"}};

Eigen::AlignedBox2d BoxOf(const Plan& plan) {
  Eigen::AlignedBox2d box;
  for (const PlannedFacade& facade : plan.facades) {
    box.extend(facade.a_m);
    box.extend(facade.b_m);
  }
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(kAround_m);
  return box.isEmpty() ? box : Eigen::AlignedBox2d(box.min() - around, box.max() + around);
}

bool IsFree(const Plan& plan, const Eigen::Vector2d& at) {
  return std::ranges::all_of(plan.footprints, [&](const PlannedFootprint& footprint) {
    return Distance(Polygon{footprint.rings_m}, at) >= kFromWalls_m;
  });
}

// The places of a part, those that most photos show first, and of these the nearest to its middle.
std::vector<const CoveredPlace*> PlacesIn(const Eigen::AlignedBox2d& part,
                                          const PhotoCoverage& coverage) {
  std::vector<const CoveredPlace*> out;
  for (const CoveredPlace& place : coverage.places) {
    const bool fits = place.kind == SurfaceKind::kGround && place.photos >= kFewestPhotos &&
                      part.contains(place.position_m.head<2>());
    if (fits) out.push_back(&place);
  }
  const auto away = [&](const CoveredPlace* place) {
    return (place->position_m.head<2>() - part.center()).squaredNorm();
  };
  std::ranges::stable_sort(out, [&](const CoveredPlace* a, const CoveredPlace* b) {
    return a->photos != b->photos ? a->photos > b->photos : away(a) < away(b);
  });
  return out;
}

}  // namespace

std::vector<GroundPoint> ProposeGroundPoints(const Plan& plan, const PhotoCoverage& coverage) {
  std::vector<GroundPoint> out;
  const Eigen::AlignedBox2d box = BoxOf(plan);
  if (box.isEmpty()) return out;
  const Eigen::Vector2d third = box.sizes() / 3;
  const auto propose = [&](const auto& parts, char letter) {
    int number = 0;
    for (const Part& part : parts) {
      const Eigen::Vector2d low =
          box.min() + third.cwiseProduct(Eigen::Vector2d(part.column, part.row));
      const auto places = PlacesIn({low, low + third}, coverage);
      const auto found = std::ranges::find_if(places, [&](const CoveredPlace* place) {
        return IsFree(plan, place->position_m.head<2>());
      });
      if (found == places.end()) continue;
      out.push_back({fmt::format("{}{}", letter, ++number), part.where, **found});
    }
  };
  propose(kControl, 'G');
  if (third.x() >= third.y()) {
    propose(kCheckWide, 'C');
  } else {
    propose(kCheckTall, 'C');
  }
  return out;
}

}  // namespace stucco::plan
