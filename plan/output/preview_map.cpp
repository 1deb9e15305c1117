// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "plan/output/internal/svg.h"
#include "survey/geometry2d.h"

namespace stucco::plan::internal {
namespace {

constexpr double kBestQuality = 4;  // the sum of four terms
constexpr int kQualityClasses = 24;
constexpr double kMarginShare = 0.03;
constexpr double kSmallestSite = 20;  // metres, so that a plan without buildings has a map
// Below this share of the safe altitude a flight counts as below it.
constexpr double kLow = 0.98;

struct Box {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  void Add(const Eigen::Vector2d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

// No-fly areas may be as large as a city: the map shows what the flights are about.
Box ExtentOf(const Plan& plan) {
  Box box;
  for (const PlannedFootprint& footprint : plan.footprints) {
    for (const auto& ring : footprint.rings_m)
      std::ranges::for_each(ring, [&](const auto& p) { box.Add(p); });
  }
  for (const PlannedView& view : plan.views) box.Add(view.position_m.head<2>());
  for (const PlannedFlight& flight : plan.flights) {
    for (const PlannedWaypoint& waypoint : flight.waypoints) {
      box.Add(waypoint.position_m.head<2>());
    }
  }
  for (const Eigen::Vector3d& home : plan.Homes()) box.Add(home.head<2>());
  return box;
}

// Sizes follow the map as long as they stay readable and do not cover it.
double SizeOf(double metres, const MapScale& scale, double least_px, double most_px) {
  return std::clamp(metres * scale.px_per_m, least_px, most_px);
}

void DrawGround(const Plan& plan, const MapScale& scale, Svg& svg) {
  PathData outlines;
  PathData obstacles;
  for (const PlannedFootprint& footprint : plan.footprints) {
    PathData& path = footprint.is_obstacle ? obstacles : outlines;
    for (const auto& ring : footprint.rings_m) path.Ring(scale.Page(ring));
  }
  // A stroke with round joins is the dilation itself.
  const std::string dilated = fmt::format(
      "fill=\"#f6ead6\" fill-rule=\"evenodd\" stroke=\"#f6ead6\" stroke-linejoin=\"round\" "
      "stroke-width=\"{:.2f}\"",
      2 * plan.d_min_m * scale.px_per_m);
  svg.Path(outlines, dilated);
  svg.Path(obstacles, dilated);
  svg.Path(obstacles, kObstacleLook);
  svg.Path(outlines,
           "fill=\"#cfd2d8\" fill-rule=\"evenodd\" stroke=\"#8d929c\" "
           "stroke-width=\"0.5\"");
  PathData no_fly;
  for (const auto& ring : plan.no_fly_m) no_fly.Ring(scale.Page(ring));
  svg.Path(no_fly, "fill=\"url(#nofly)\" stroke=\"#c0392b\" stroke-width=\"1.2\"");
}

// Ids of buildings, where they fit and are not too many to read.
void DrawNames(const Plan& plan, const MapScale& scale, Svg& svg) {
  constexpr size_t kMost = 150;
  constexpr double kWidthPerLetter = 5.4;
  if (plan.footprints.size() > kMost) return;
  std::set<std::string> named;
  for (const PlannedFootprint& footprint : plan.footprints) {
    if (footprint.is_obstacle || footprint.rings_m.empty()) continue;
    if (!named.insert(footprint.building).second) continue;
    Box box;
    for (const Eigen::Vector2d& corner : footprint.rings_m.front()) box.Add(corner);
    const Eigen::Vector2d size = scale.px_per_m * (box.high - box.low);
    const double letters = static_cast<double>(footprint.building.size());
    const bool fits = size.x() > kWidthPerLetter * letters + 8 && size.y() > 20;
    const Eigen::Vector2d middle = (box.low + box.high) / 2;
    if (!fits || !Contains(footprint.rings_m.front(), middle)) continue;
    if (footprint.rings_m.size() > 1) continue;  // its middle is a courtyard
    svg.Text(scale.Page(middle) + Eigen::Vector2d(0, 3), "class=\"name\"", footprint.building);
  }
}

void DrawPaths(const Plan& plan, const MapScale& scale, Svg& svg) {
  const double width = SizeOf(0.25, scale, 0.6, 1.6);
  const double low_z = plan.home_m.z() + kLow * plan.safe_altitude_m;
  for (size_t i = 0; i < plan.flights.size(); ++i) {
    PathData low;
    PathData high;
    const auto& waypoints = plan.flights[i].waypoints;
    for (size_t k = 1; k < waypoints.size(); ++k) {
      const Eigen::Vector3d& from = waypoints[k - 1].position_m;
      const Eigen::Vector3d& to = waypoints[k].position_m;
      if ((from - to).head<2>().norm() < 0.01) continue;  // up or down
      PathData& path = std::min(from.z(), to.z()) < low_z ? low : high;
      path.MoveTo(scale.Page(from.head<2>()));
      path.LineTo(scale.Page(to.head<2>()));
    }
    const std::string color = Hex(FlightColor(static_cast<int>(i)));
    const std::string look =
        fmt::format("fill=\"none\" stroke=\"{}\" stroke-linecap=\"round\"", color);
    svg.Path(high, fmt::format("{} stroke-width=\"{:.2f}\" stroke-opacity=\"0.45\" "
                               "stroke-dasharray=\"{:.1f} {:.1f}\"",
                               look, 0.8 * width, 4 * width, 3 * width));
    svg.Path(low, fmt::format("{} stroke-width=\"{:.2f}\" stroke-opacity=\"0.85\"", look, width));
  }
}

// Just outside the footprint, so that walls that face each other stay apart.
void DrawFacades(const Plan& plan, const MapScale& scale, Svg& svg) {
  std::map<int, PathData> by_quality;
  PathData all;
  PathData unseen;
  for (const PlannedFacade& facade : plan.facades) {
    const Eigen::Vector2d shift = 0.5 * scale.stroke_px / scale.px_per_m * facade.outwards();
    PathData& path = by_quality[static_cast<int>(
        std::lround(facade.predicted.sum() / kBestQuality * kQualityClasses))];
    for (PathData* lines : {&path, &all}) {
      lines->MoveTo(scale.Page(Eigen::Vector2d(facade.a_m + shift)));
      lines->LineTo(scale.Page(Eigen::Vector2d(facade.b_m + shift)));
    }
    for (const Interval& part : facade.unobservable_m) {
      unseen.MoveTo(scale.Page(Eigen::Vector2d(facade.a_m + shift + part.from_m * facade.along())));
      unseen.LineTo(scale.Page(Eigen::Vector2d(facade.a_m + shift + part.to_m * facade.along())));
    }
  }
  // A dark rim, because good walls are as bright as the page.
  svg.Path(all, fmt::format("fill=\"none\" stroke=\"#33363d\" stroke-linecap=\"round\" "
                            "stroke-width=\"{:.2f}\"",
                            scale.stroke_px + std::min(0.5 * scale.stroke_px, 1.4)));
  for (const auto& [level, path] : by_quality) {
    svg.Path(path, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"",
                               Hex(QualityColor(static_cast<double>(level) / kQualityClasses)),
                               scale.stroke_px));
  }
  svg.Path(unseen,
           fmt::format("fill=\"none\" stroke=\"#fff\" stroke-width=\"{:.2f}\"", scale.stroke_px));
  svg.Path(unseen, fmt::format("fill=\"none\" stroke=\"#d7191c\" stroke-width=\"{:.2f}\" "
                               "stroke-dasharray=\"{:.2f} {:.2f}\"",
                               scale.stroke_px, 2 * scale.stroke_px, 1.5 * scale.stroke_px));
}

bool IsDipping(const PlannedView& view) {
  return view.kind == ViewKind::kDipping || view.kind == ViewKind::kDippingFoot ||
         view.kind == ViewKind::kSurface || view.kind == ViewKind::kLink;
}

// A slice of the field of view, which shows direction and angle of a photo.
void AddWedge(const Eigen::Vector2d& at, double yaw_deg, double half_angle, double radius_px,
              PathData& path) {
  constexpr int kArcSteps = 4;
  const double yaw = yaw_deg * std::numbers::pi / 180;
  path.MoveTo(at);
  for (int i = 0; i <= kArcSteps; ++i) {
    const double angle = yaw + half_angle * (2.0 * i / kArcSteps - 1);
    path.LineTo(at + radius_px * Eigen::Vector2d(std::sin(angle), -std::cos(angle)));
  }
  path.Close();
}

double HalfFov(const PlannedCamera& camera) {
  if (!(camera.focal_m > 0) || !(camera.sensor_width_m > 0)) return std::numbers::pi / 6;
  return std::atan(camera.sensor_width_m / camera.focal_m / 2);
}

// Views above each other fall together on a map: one wedge for all that look the same way.
using Seen = std::set<std::tuple<long, long, long>>;
bool IsNew(const PlannedView& view, double yaw_deg, Seen& seen) {
  const auto decimetres = [](double value) { return std::lround(10 * value); };
  return seen
      .emplace(decimetres(view.position_m.x()), decimetres(view.position_m.y()),
               std::lround(yaw_deg))
      .second;
}

void DrawViews(const Plan& plan, const MapScale& scale, Svg& svg) {
  const double radius = SizeOf(2.5, scale, 5, 18);
  const double half_fov = HalfFov(plan.camera);
  PathData wedges;
  PathData links;
  PathData planar;
  std::map<int, PathData> dots;
  Seen seen_wedges;
  Seen seen_dots;
  for (const PlannedView& view : plan.views) {
    const Eigen::Vector2d at = scale.Page(view.position_m.head<2>());
    if (!IsDipping(view)) {
      if (IsNew(view, 720, seen_dots)) planar.Dot(at);
      continue;
    }
    if (IsNew(view, view.yaw_deg, seen_wedges)) {
      AddWedge(at, view.yaw_deg, half_fov, radius, view.kind == ViewKind::kLink ? links : wedges);
    }
    if (IsNew(view, 0, seen_dots)) dots[view.flight].Dot(at);
  }
  const double dot = SizeOf(0.8, scale, 1.8, 5);
  const auto round = [](const char* color, double width) {
    return fmt::format(
        "fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" "
        "stroke-linecap=\"round\"",
        color, width);
  };
  svg.Path(planar, round("#5b6470", 0.9 * dot));
  svg.Path(planar, round("#fff", 0.5 * dot));
  svg.Path(wedges,
           "fill=\"#1b1b1f\" fill-opacity=\"0.28\" stroke=\"#1b1b1f\" "
           "stroke-opacity=\"0.6\" stroke-width=\"0.35\"");
  svg.Path(links, kLinkLook);
  for (const auto& [flight, path] : dots) {
    svg.Path(path, round("#fff", dot + 1));
    svg.Path(path, round(Hex(FlightColor(flight)).c_str(), dot));
  }
}

// A ring around each place with a photo that calibration may lose.
void DrawLoose(const Plan& plan, const MapScale& scale, Svg& svg) {
  const double radius = SizeOf(1.6, scale, 3.5, 9);
  Seen seen;
  for (const PlannedView& view : plan.views) {
    if (!view.is_loose || !IsNew(view, 0, seen)) continue;
    const Eigen::Vector2d at = scale.Page(view.position_m.head<2>());
    svg.Add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>", at.x(), at.y(), radius,
            kLooseLook);
  }
}

void DrawHome(const Plan& plan, const MapScale& scale, Svg& svg) {
  const std::vector<Eigen::Vector3d> homes = plan.Homes();
  for (size_t i = 0; i < homes.size(); ++i) {
    const Eigen::Vector2d at = scale.Page(homes[i].head<2>());
    svg.Add(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" fill=\"#fff\" stroke=\"#111\" "
        "stroke-width=\"1.6\"/>",
        at.x(), at.y());
    if (homes.size() == 1) {
      svg.Text(at + Eigen::Vector2d(0, 4.2), "class=\"home\"", "H");
    } else {
      svg.Text(at + Eigen::Vector2d(0, 3.4), "class=\"home small\"", fmt::format("H{}", i + 1));
    }
  }
}

}  // namespace

MapScale FitMap(const Plan& plan, const Eigen::Vector2d& corner_px,
                const Eigen::Vector2d& largest_px) {
  const Box box = ExtentOf(plan);
  const Eigen::Vector2d middle = (box.low + box.high) / 2;
  Eigen::Vector2d size = (box.high - box.low).cwiseMax(kSmallestSite);
  size.array() += 2 * std::max(kMarginShare * size.maxCoeff(), 4.0);
  MapScale scale;
  scale.px_per_m = (largest_px.array() / size.array()).minCoeff();
  // A narrow site gets a wider map rather than an empty page.
  size.x() = largest_px.x() / scale.px_per_m;
  scale.south_west_m = middle - size / 2;
  scale.north_east_m = middle + size / 2;
  scale.corner_px = corner_px;
  scale.stroke_px = SizeOf(0.5, scale, 1.3, 4.5);
  return scale;
}

void DrawMap(const Plan& plan, const MapScale& scale, Svg& svg) {
  svg.Add(
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" "
      "viewBox=\"{0:.1f} {1:.1f} {2:.1f} {3:.1f}\">",
      scale.corner_px.x(), scale.corner_px.y(), scale.Width(), scale.Height());
  svg.Add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#fbfbf9\"/>",
          scale.corner_px.x(), scale.corner_px.y(), scale.Width(), scale.Height());
  DrawGround(plan, scale, svg);
  DrawPaths(plan, scale, svg);
  DrawFacades(plan, scale, svg);
  DrawViews(plan, scale, svg);
  DrawLoose(plan, scale, svg);
  DrawNames(plan, scale, svg);
  DrawHome(plan, scale, svg);
  svg.Add("</svg>");
  svg.Add(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#b9b9bf\"/>",
      scale.corner_px.x(), scale.corner_px.y(), scale.Width(), scale.Height());
}

}  // namespace stucco::plan::internal
