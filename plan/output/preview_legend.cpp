// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "plan/output/internal/svg.h"

namespace stucco::plan::internal {
namespace {

constexpr double kLine = 21;
constexpr double kSymbol = 34;  // width of the column of symbols
constexpr size_t kMostFlights = 14;

// Writes downwards.
struct Column {
  Svg& svg;
  Eigen::Vector2d at;

  void Down(double px) { at.y() += px; }
  void Heading(std::string_view text) {
    Down(12);
    svg.Text(at, "class=\"heading\"", text);
    Down(kLine);
  }
  void Entry(std::string_view text) {
    svg.Text(at + Eigen::Vector2d(kSymbol, 0), "class=\"entry\"", text);
    Down(kLine);
  }
  void Note(std::string_view text) {
    svg.Text(at, "class=\"note\"", text);
    Down(16);
  }
  double X(double offset) const { return at.x() + offset; }
  double Y(double offset) const { return at.y() + offset; }
};

void DrawQualityBar(Column& column) {
  constexpr double kWidth = 240;
  constexpr int kSteps = 48;
  column.Heading("Facades: predicted quality Q");
  for (int i = 0; i < kSteps; ++i) {
    column.svg.Add("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"11\" fill=\"{}\"/>",
                   column.X(kWidth * i / kSteps), column.Y(-10), kWidth / kSteps + 0.3,
                   Hex(QualityColor((i + 0.5) / kSteps)));
  }
  for (int tick = 0; tick <= 4; ++tick) {
    column.svg.Text({column.X(kWidth * tick / 4), column.Y(14)}, "class=\"tick\"",
                    fmt::format("{}", tick));
  }
  column.Down(32);
  column.Note("Q = Qs + Qd + Qu + Qc: frontal and alike,");
  column.Note("close and evenly so, few photos, complete");
  column.Down(8);
  column.svg.Add("<path d=\"M{:.1f} {:.1f}h26\" stroke=\"#fff\" stroke-width=\"4\"/>", column.X(0),
                 column.Y(-4));
  column.svg.Add(
      "<path d=\"M{:.1f} {:.1f}h26\" stroke=\"#d7191c\" stroke-width=\"4\" "
      "stroke-dasharray=\"4 4\"/>",
      column.X(0), column.Y(-4));
  column.Entry("wall seen from above only, or not at all");
}

// What the match graph adds to the map.
void DrawMatchSymbols(const Plan& plan, Column& column) {
  if (std::ranges::find(plan.views, ViewKind::kLink, &PlannedView::kind) != plan.views.end()) {
    column.svg.Add("<path d=\"M{:.1f} {:.1f}l-9-13a16 16 0 0 1 18 0z\" {}/>", column.X(13),
                   column.Y(0), kLinkLook);
    column.Entry("link photos, between those that would not match");
  }
  const auto loose = std::ranges::count(plan.views, true, &PlannedView::is_loose);
  if (loose == 0) return;
  column.svg.Add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" {}/>", column.X(13), column.Y(-4),
                 kLooseLook);
  column.Entry(fmt::format("{} photo{} that too few should match", loose, loose == 1 ? "" : "s"));
}

void DrawSymbols(const Plan& plan, Column& column) {
  column.Heading("Map");
  const auto swatch = [&](const char* look) {
    column.svg.Add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"26\" height=\"13\" {}/>", column.X(0),
                   column.Y(-11), look);
  };
  swatch("fill=\"#cfd2d8\" stroke=\"#8d929c\" stroke-width=\"0.5\"");
  column.Entry("building");
  if (std::ranges::any_of(plan.footprints, &PlannedFootprint::is_obstacle)) {
    swatch(kObstacleLook);
    column.Entry("obstacle: tree, crane, wire");
  }
  swatch("fill=\"#f6ead6\"");
  column.Entry(fmt::format("nearer than {:g} m: flown above only", plan.d_min_m));
  if (!plan.no_fly_m.empty()) {
    swatch("fill=\"url(#nofly)\" stroke=\"#c0392b\"");
    column.Entry("no-fly area");
  }
  column.svg.Add(
      "<path d=\"M{0:.1f} {1:.1f}l-9-13a16 16 0 0 1 18 0z\" fill=\"#1b1b1f\" "
      "fill-opacity=\"0.28\" stroke=\"#1b1b1f\" stroke-opacity=\"0.6\" "
      "stroke-width=\"0.5\"/><circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"3\" "
      "fill=\"#0072b2\"/>",
      column.X(13), column.Y(0));
  column.Entry("photos at walls, with field of view");
  column.svg.Add(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#fff\" stroke=\"#5b6470\" "
      "stroke-width=\"1.6\"/>",
      column.X(13), column.Y(-4));
  column.Entry("photos from above");
  DrawMatchSymbols(plan, column);
  column.svg.Add(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"#fff\" stroke=\"#111\" "
      "stroke-width=\"1.4\"/>",
      column.X(13), column.Y(-4));
  column.svg.Text({column.X(13), column.Y(-0.6)}, "class=\"home small\"", "H");
  column.Entry("take-off and landing");
}

void DrawFlights(const Plan& plan, Column& column) {
  column.Heading(plan.flights.size() == 1 ? "Flight" : "Flights");
  column.Note("dashed at the safe altitude, solid below it");
  column.Down(5);
  const std::vector<Eigen::Vector3d> homes = plan.Homes();
  for (size_t i = 0; i < std::min(plan.flights.size(), kMostFlights); ++i) {
    const PlannedFlight& flight = plan.flights[i];
    column.svg.Add("<path d=\"M{:.1f} {:.1f}h26\" stroke=\"{}\" stroke-width=\"3\"/>", column.X(0),
                   column.Y(-4), Hex(FlightColor(static_cast<int>(i))));
    const auto home = std::ranges::find(homes, plan.HomeOf(flight)) - homes.begin();
    column.Entry(fmt::format("{}: {:.0f} m, {:.0f} min, {:.0f} % battery{}", i + 1, flight.length_m,
                             flight.time_min, flight.battery_percent,
                             homes.size() > 1 ? fmt::format(", H{}", home + 1) : ""));
  }
  if (plan.flights.size() > kMostFlights) {
    column.Entry(fmt::format("and {} more, colours repeat", plan.flights.size() - kMostFlights));
  }
}

void DrawQualities(const PlanStats& stats, Column& column) {
  constexpr double kBar = 120;
  column.Heading("Means over facades");
  const auto row = [&](const char* name, double value) {
    column.svg.Text(column.at, "class=\"entry\"", name);
    column.svg.Add(
        "<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"9\" "
        "fill=\"#e6e6ea\"/><rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{3:.1f}\" "
        "height=\"9\" fill=\"#44546a\"/>",
        column.X(130), column.Y(-9), kBar, kBar * std::clamp(value, 0.0, 1.0));
    column.svg.Text({column.X(258), column.at.y()}, "class=\"entry\"",
                    fmt::format("{:.2f}", value));
    column.Down(kLine);
  };
  row("Qs frontal, alike", stats.mean.q_s);
  row("Qd close, even", stats.mean.q_d);
  row("Qu few photos", stats.mean.q_u);
  row("Qc complete", stats.mean.q_c);
}

// 1, 2 or 5 times a power of ten, not longer than `longest`.
double RoundLength(double longest) {
  const double power = std::pow(10, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= longest) return factor * power;
  }
  return power;
}

}  // namespace

void DrawLegend(const Plan& plan, const PlanStats& stats, const Eigen::Vector2d& corner_px,
                Svg& svg) {
  Column column = {svg, corner_px};
  DrawQualityBar(column);
  DrawSymbols(plan, column);
  if (!plan.flights.empty()) DrawFlights(plan, column);
  if (!stats.facades.empty()) DrawQualities(stats, column);
  column.Down(10);
  column.Note(fmt::format("Origin {:.5f}, {:.5f} (WGS 84)", plan.origin.latitude_deg,
                          plan.origin.longitude_deg));
}

void DrawScaleBar(const MapScale& scale, Svg& svg) {
  const double length_m = RoundLength(0.2 * scale.Width() / scale.px_per_m);
  const double width = length_m * scale.px_per_m;
  const double y = scale.corner_px.y() + scale.Height() + 24;
  svg.Add(
      "<path d=\"M{:.1f} {:.1f}v6h{:.1f}v-6\" fill=\"none\" stroke=\"#222\" "
      "stroke-width=\"1.6\"/>",
      scale.corner_px.x() + 1, y, width);
  svg.Text({scale.corner_px.x() + width + 8, y + 7}, "class=\"entry\"",
           fmt::format("{:g} m", length_m));
  const double north = scale.corner_px.x() + scale.Width() - 12;
  svg.Add("<path d=\"M{:.1f} {:.1f}l8 24-8-6-8 6z\" fill=\"#222\"/>", north, y - 13);
  svg.Text({north - 20, y + 7}, "class=\"home\"", "N");
}

}  // namespace stucco::plan::internal
