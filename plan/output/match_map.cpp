// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/output/match_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plan/match/ties.h"
#include "plan/output/internal/svg.h"

namespace stucco::plan {
namespace {

using internal::kMargin;
using internal::kPageWidth;
using internal::kTallestMap;
using internal::MapScale;
using internal::PathData;
using internal::Svg;

constexpr double kTop = 128;
constexpr double kBelowMap = 60;
constexpr double kKeyRow = 71;  // from the top of the page

// How surely two photos match, by what flown surveys show (docs/benchmarks.md): of pairs below the
// second limit nine in ten come to share 15 points, of those above the third all do.
struct Level {
  double from;  // strength
  const char* color;
  const char* label;
  double line_px;
};
constexpr Level kLevels[] = {
    {0, "#d7191c", "too few partners", 0},
    {kEnoughStrength, "#f08a24", "nine in ten such pairs match", 1.3},
    {0.1, "#4a90c2", "nearly all do", 0.9},
    {0.16, "#b4bac2", "all do", 0.6},
};

// Of a pair that counts: never that of too few partners.
int LevelOf(double strength) {
  int level = 1;
  for (int i = 2; i < static_cast<int>(std::size(kLevels)); ++i) {
    if (strength >= kLevels[i].from) level = i;
  }
  return level;
}

// Where photos are taken from, the first of several above each other on top.
struct Stop {
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  int level = 0;  // of its worst photo
};

std::map<int, Stop> StopsOf(const Plan& plan) {
  std::map<int, Stop> stops;
  for (const PlannedView& view : plan.views) {
    const bool is_tied = !view.is_loose && view.partners.size() >= kFewestPartners;
    const int level = is_tied ? LevelOf(view.partners[kFewestPartners - 1].strength) : 0;
    const auto [found, is_new] =
        stops.try_emplace(view.hover, Stop{view.position_m.head<2>(), level});
    if (!is_new) found->second.level = std::min(found->second.level, level);
  }
  return stops;
}

// By pair of stops, the strength of the strongest pair of their photos.
std::map<std::pair<int, int>, double> LinesOf(const Plan& plan) {
  std::unordered_map<std::string, int> hover_of;
  for (const PlannedView& view : plan.views) hover_of.emplace(view.id, view.hover);
  std::map<std::pair<int, int>, double> lines;
  for (const PlannedView& view : plan.views) {
    for (const PlannedPartner& partner : view.partners) {
      const auto other = hover_of.find(partner.view);
      if (other == hover_of.end() || other->second == view.hover) continue;
      double& strength = lines[std::minmax(view.hover, other->second)];
      strength = std::max(strength, partner.strength);
    }
  }
  return lines;
}

void DrawGround(const Plan& plan, const MapScale& scale, Svg& svg) {
  PathData outlines;
  PathData obstacles;
  for (const PlannedFootprint& footprint : plan.footprints) {
    PathData& path = footprint.is_obstacle ? obstacles : outlines;
    for (const auto& ring : footprint.rings_m) path.Ring(scale.Page(ring));
  }
  svg.Path(obstacles, internal::kObstacleLook);
  svg.Path(outlines,
           "fill=\"#e3e5e9\" fill-rule=\"evenodd\" stroke=\"#8d929c\" stroke-width=\"0.5\"");
}

// What is sure first, so that what is not lies on top.
void DrawGraph(const Plan& plan, const MapScale& scale, Svg& svg) {
  const std::map<int, Stop> stops = StopsOf(plan);
  std::map<int, PathData> lines;
  for (const auto& [pair, strength] : LinesOf(plan)) {
    PathData& path = lines[LevelOf(strength)];
    path.MoveTo(scale.Page(stops.at(pair.first).at_m));
    path.LineTo(scale.Page(stops.at(pair.second).at_m));
  }
  std::map<int, PathData> dots;
  for (const auto& [hover, stop] : stops) dots[stop.level].Dot(scale.Page(stop.at_m));
  for (auto level = lines.rbegin(); level != lines.rend(); ++level) {
    svg.Path(level->second,
             fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"",
                         kLevels[level->first].color, kLevels[level->first].line_px));
  }
  const double width = std::clamp(0.8 * scale.px_per_m, 3.0, 7.0);
  for (auto level = dots.rbegin(); level != dots.rend(); ++level) {
    svg.Path(level->second, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" "
                                        "stroke-linecap=\"round\"",
                                        kLevels[level->first].color, width));
  }
}

void DrawKey(Svg& svg) {
  svg.Text({kMargin, kKeyRow}, "class=\"entry\"",
           "Lines: stops with photos that should match, by the best pair. Dots: stops, by the "
           "third-best "
           "partner of their worst photo.");
  Eigen::Vector2d at(kMargin, kKeyRow + 27);
  for (const Level& level : kLevels) {
    svg.Add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"13\" height=\"13\" fill=\"{}\"/>", at.x(),
            at.y() - 11, level.color);
    svg.Text(at + Eigen::Vector2d(17, 0), "class=\"entry\"", level.label);
    at.x() += 290;
  }
}

}  // namespace

std::string MatchSvg(const Plan& plan) {
  const MapScale scale =
      internal::FitMap(plan, {kMargin, kTop}, {kPageWidth - 2 * kMargin, kTallestMap});
  const double height = kTop + scale.Height() + kBelowMap;
  Svg svg;
  svg.Add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">",
      kPageWidth, height);
  svg.Add("<title>Which photos should match</title>");
  svg.Add("{}", internal::kMapStyle);
  svg.Add("<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#fff\"/>", kPageWidth, height);
  svg.Text({kMargin, 36}, "class=\"title\"", "Which photos should match");
  DrawKey(svg);
  DrawGround(plan, scale, svg);
  DrawGraph(plan, scale, svg);
  svg.Add(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#b9b9bf\"/>",
      scale.corner_px.x(), scale.corner_px.y(), scale.Width(), scale.Height());
  internal::DrawScaleBar(scale, svg);
  svg.Add("</svg>");
  return svg.text();
}

}  // namespace stucco::plan
