// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/output/preview.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/output/internal/svg.h"

namespace stucco::plan {
namespace {

using internal::kMargin;
using internal::kPageWidth;
using internal::kTallestMap;
using internal::MapScale;
using internal::Svg;

constexpr double kTitle = 92;
constexpr double kWarningLine = 19;
constexpr size_t kWarningLetters = 190;  // in a line
constexpr double kLegend = 330;
constexpr double kBelowPlan = 48;
constexpr double kMapWidth = kPageWidth - 3 * kMargin - kLegend;
constexpr double kLowestPage = 960;  // the legend needs it

std::string Title(const Plan& plan, const PlanStats& stats) {
  const auto buildings = std::ranges::count(plan.footprints, false, &PlannedFootprint::is_obstacle);
  return fmt::format("Flight plan: {} building{}, {} facades ({}, {})", buildings,
                     buildings == 1 ? "" : "s", plan.facades.size(), stats.method, stats.camera);
}

std::string Figures(const Plan& plan, const PlanStats& stats) {
  std::string text = fmt::format(
      "{} photos at {} hovers  ·  {:.2f} km  ·  {:.0f} min  ·  {} flight{}, {:.0f} % of a battery"
      "  ·  mean Q {:.2f} of 4",
      stats.photos, stats.hovers, stats.length_m / 1000, stats.time_min,
      stats.battery_by_flight.size(), stats.battery_by_flight.size() == 1 ? "" : "s",
      stats.battery_percent, stats.mean.sum());
  if (stats.unobservable_m > 0) {
    text += fmt::format("  ·  {:.0f} of {:.0f} m of wall from above only", stats.unobservable_m,
                        stats.wall_m);
  }
  return text + fmt::format("  ·  safe altitude {:.0f} m", plan.safe_altitude_m);
}

// Broken where they are too long for the page.
std::vector<std::string> WarningLines(const PlanStats& stats) {
  std::vector<std::string> lines;
  for (const std::string& warning : stats.warnings) {
    std::string text = "Warning: " + warning;
    while (text.size() > kWarningLetters) {
      const size_t end = text.rfind(' ', kWarningLetters);
      if (end == std::string::npos || end < kWarningLetters / 2) break;
      lines.push_back(text.substr(0, end));
      text = "     " + text.substr(end);
    }
    lines.push_back(text);
  }
  return lines;
}

}  // namespace

std::string PreviewSvg(const Plan& plan, const PlanStats& stats) {
  const std::vector<std::string> warnings = WarningLines(stats);
  const double top = kTitle + kWarningLine * static_cast<double>(warnings.size());
  const Eigen::Vector2d corner(kMargin, top);
  const MapScale scale = internal::FitMap(plan, corner, {kMapWidth, kTallestMap});
  const double height = std::max(scale.Height() + kBelowPlan, kLowestPage - kTitle) + top;
  Svg svg;
  svg.Add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">",
      kPageWidth, height);
  svg.Add("<title>{}</title>", internal::EscapeXml(Title(plan, stats)));
  svg.Add("{}", internal::kMapStyle);
  svg.Add("<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#fff\"/>", kPageWidth, height);
  svg.Text({kMargin, 42}, "class=\"title\"", Title(plan, stats));
  svg.Text({kMargin, 71}, "class=\"figures\"", Figures(plan, stats));
  for (size_t i = 0; i < warnings.size(); ++i) {
    svg.Text({kMargin, kTitle + kWarningLine * static_cast<double>(i)},
             "class=\"warning\" xml:space=\"preserve\"", warnings[i]);
  }
  internal::DrawMap(plan, scale, svg);
  internal::DrawScaleBar(scale, svg);
  internal::DrawLegend(plan, stats, {2 * kMargin + kMapWidth, top}, svg);
  svg.Add("</svg>");
  return svg.text();
}

}  // namespace stucco::plan
