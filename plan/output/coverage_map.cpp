// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/output/coverage_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "plan/output/internal/svg.h"

namespace stucco::plan {
namespace {

using internal::kMargin;
using internal::kPageWidth;
using internal::kTallestMap;
using internal::MapScale;
using internal::PathData;
using internal::Svg;

constexpr double kCoverageTop = 128;
constexpr double kBelowCoverage = 60;
constexpr double kCoverageKeyRow = 66;  // from the top of the page
constexpr char kUnseen[] = "#d7191c";

// Colours from good (the last class) to bad, and one for what no photo shows.
struct Theme {
  const char* title;
  std::vector<std::string> labels;                // of the classes, from bad to good
  std::function<int(const CoveredPlace&)> place;  // its class; -1: no photo shows it
};

std::string ColorOf(const Theme& theme, int level) {
  if (level < 0) return kUnseen;
  const double last = std::max<double>(1, static_cast<double>(theme.labels.size()) - 1);
  return Hex(QualityColor(level / last));
}

Theme GsdTheme(double asked_m) {
  // In steps of the square root of two: a class is a stop of resolution.
  static constexpr double kFactors[] = {4, 2.83, 2, 1.41, 1, 0.71, 0.5};
  Theme theme{"Finest pixel on the surface", {fmt::format("over {:.0f} mm", 4000 * asked_m)}, {}};
  for (const double factor : kFactors) {
    theme.labels.push_back(fmt::format("to {:.0f} mm", 1000 * factor * asked_m));
  }
  theme.place = [asked_m](const CoveredPlace& place) {
    if (place.photos == 0) return -1;
    int level = 0;
    for (const double factor : kFactors) level += place.gsd_m <= factor * asked_m ? 1 : 0;
    return level;
  };
  return theme;
}

Theme PhotosTheme() {
  static constexpr int kLeast[] = {2, 3, 5, 9, 17};
  return {"Photos that show it",
          {"1", "2", "3, 4", "5 to 8", "9 to 16", "17 or more"},
          [](const CoveredPlace& place) {
            if (place.photos == 0) return -1;
            int level = 0;
            for (const int least : kLeast) level += place.photos >= least ? 1 : 0;
            return level;
          }};
}

// Just outside the footprint, so that walls that face each other stay apart.
Eigen::Vector2d OnPage(const CoveredPlace& place, const MapScale& scale) {
  const Eigen::Vector2d shift = 0.5 * scale.stroke_px / scale.px_per_m * place.normal.head<2>();
  return scale.Page(Eigen::Vector2d(place.position_m.head<2>() + shift));
}

void DrawLevels(const std::map<int, PathData>& levels, const Theme& theme, const char* cap,
                double width, Svg& svg) {
  for (const auto& [level, path] : levels) {
    svg.Path(path, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" "
                               "stroke-linecap=\"{}\"",
                               ColorOf(theme, level), width, cap));
  }
}

// Cells of a grid, which come row by row: neighbours of one class become one stroke.
class Cells {
 public:
  explicit Cells(double size_px) : size_px_(size_px) {}

  void Add(int level, const Eigen::Vector2d& at) {
    const double left = at.x() - size_px_ / 2;
    const bool goes_on = has_run_ && level == level_ && std::abs(at.y() - from_.y()) < kSame_px &&
                         std::abs(left - to_px_) < kSame_px;
    if (!goes_on) {
      Flush();
      level_ = level;
      from_ = {left, at.y()};
      has_run_ = true;
    }
    to_px_ = left + size_px_;
  }
  const std::map<int, PathData>& Finish() {
    Flush();
    return levels_;
  }

 private:
  static constexpr double kSame_px = 0.01;

  void Flush() {
    if (!has_run_) return;
    levels_[level_].MoveTo(from_);
    levels_[level_].LineTo({to_px_, from_.y()});
    has_run_ = false;
  }

  double size_px_;
  std::map<int, PathData> levels_;
  bool has_run_ = false;
  int level_ = 0;
  Eigen::Vector2d from_ = Eigen::Vector2d::Zero();
  double to_px_ = 0;
};

// By place on the page, the class of the worst of its heights.
using WallColumns = std::map<std::pair<double, double>, int>;

void DrawWalls(const WallColumns& columns, const Theme& theme, const MapScale& scale, Svg& svg) {
  std::map<int, PathData> levels;
  PathData all;
  for (const auto& [at, level] : columns) {
    levels[level].Dot({at.first, at.second});
    all.Dot({at.first, at.second});
  }
  const double width = std::clamp(1.3 * scale.px_per_m, 3.0, 9.0);
  svg.Path(all, fmt::format("fill=\"none\" stroke=\"#fff\" stroke-width=\"{:.2f}\" "
                            "stroke-linecap=\"round\"",
                            width + 1.6));
  DrawLevels(levels, theme, "round", width, svg);
}

void DrawPlaces(const PhotoCoverage& coverage, const Theme& theme, const MapScale& scale,
                Svg& svg) {
  constexpr double kSeam_px = 0.3;  // hides hairlines between rows
  const double size_px = coverage.spacing_m * scale.px_per_m;
  Cells cells(size_px);
  WallColumns walls;
  for (const CoveredPlace& place : coverage.places) {
    const Eigen::Vector2d at = OnPage(place, scale);
    const int level = theme.place(place);
    if (place.kind != SurfaceKind::kWall) {
      cells.Add(level, at);
      continue;
    }
    const auto [found, is_new] = walls.try_emplace({at.x(), at.y()}, level);
    if (!is_new) found->second = std::min(found->second, level);
  }
  DrawLevels(cells.Finish(), theme, "butt", size_px + kSeam_px, svg);
  DrawWalls(walls, theme, scale, svg);
}

void DrawOutlines(const Plan& plan, const MapScale& scale, Svg& svg) {
  PathData outlines;
  for (const PlannedFootprint& footprint : plan.footprints) {
    for (const auto& ring : footprint.rings_m) outlines.Ring(scale.Page(ring));
  }
  svg.Path(outlines, "fill=\"none\" stroke=\"#1f2328\" stroke-width=\"0.6\"");
}

void DrawKey(const Theme& theme, const Eigen::Vector2d& corner, Svg& svg) {
  svg.Text(corner, "class=\"heading\"", theme.title);
  Eigen::Vector2d at = corner + Eigen::Vector2d(0, 27);
  for (int level = -1; level < static_cast<int>(theme.labels.size()); ++level) {
    svg.Add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"13\" height=\"13\" fill=\"{}\"/>", at.x(),
            at.y() - 11, ColorOf(theme, level));
    const std::string label = level < 0 ? "none" : theme.labels[level];
    svg.Text(at + Eigen::Vector2d(17, 0), "class=\"entry\"", label);
    at.x() += 34 + 6.6 * static_cast<double>(label.size());
  }
}

void DrawPanel(const Plan& plan, const PhotoCoverage& coverage, const Theme& theme,
               const MapScale& scale, Svg& svg) {
  DrawKey(theme, {scale.corner_px.x(), kCoverageKeyRow}, svg);
  const std::string box =
      fmt::format("x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\"",
                  scale.corner_px.x(), scale.corner_px.y(), scale.Width(), scale.Height());
  svg.Add("<svg {} viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\">", box, scale.corner_px.x(),
          scale.corner_px.y(), scale.Width(), scale.Height());
  svg.Add("<rect {} fill=\"#fbfbf9\"/>", box);
  DrawPlaces(coverage, theme, scale, svg);
  DrawOutlines(plan, scale, svg);
  svg.Add("</svg>");
  svg.Add("<rect {} fill=\"none\" stroke=\"#b9b9bf\"/>", box);
  internal::DrawScaleBar(scale, svg);
}

}  // namespace

std::string CoverageSvg(const Plan& plan, const PhotoCoverage& coverage) {
  const double width = (kPageWidth - 3 * kMargin) / 2;
  MapScale scale = internal::FitMap(plan, {kMargin, kCoverageTop}, {width, kTallestMap});
  const double height = kCoverageTop + scale.Height() + kBelowCoverage;
  const double asked =
      plan.camera.focal_m > 0 && plan.camera.width_px > 0
          ? plan.d_max_m * plan.camera.sensor_width_m / plan.camera.width_px / plan.camera.focal_m
          : 0;
  Svg svg;
  svg.Add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">",
      kPageWidth, height);
  svg.Add("<title>What the planned photos show</title>");
  svg.Add("{}", internal::kMapStyle);
  svg.Add("<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#fff\"/>", kPageWidth, height);
  svg.Text({kMargin, 36}, "class=\"title\"", "What the planned photos show");
  DrawPanel(plan, coverage, GsdTheme(asked), scale, svg);
  scale.corner_px.x() += width + kMargin;
  DrawPanel(plan, coverage, PhotosTheme(), scale, svg);
  svg.Add("</svg>");
  return svg.text();
}

}  // namespace stucco::plan
