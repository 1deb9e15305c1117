// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/field/checklist.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/field/internal/checklist_sections.h"
#include "plan/output/internal/svg.h"

namespace stucco::plan {
namespace {

using internal::EscapeXml;

constexpr char kHead[] = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>Checklist of the flight</title>
<style>
@page{size:A4;margin:14mm}
body{font:10.5pt/1.4 "Helvetica Neue",Helvetica,Arial,"DejaVu Sans",sans-serif;color:#1f2328;
max-width:182mm;margin:8mm auto;padding:0 4mm}
h1{font-size:17pt;margin:0 0 1mm}
h2{font-size:12.5pt;margin:7mm 0 2mm;break-after:avoid}
p,ul{margin:1mm 0 2mm}
ul{padding-left:5mm}
table{border-collapse:collapse;width:100%;font-size:9.5pt}
th{text-align:left;font-weight:600;border-bottom:0.4mm solid #59636e}
th,td{padding:0.8mm 2mm 0.8mm 0;vertical-align:top}
td{border-bottom:0.2mm solid #d0d7de}
tr{break-inside:avoid}
thead{display:table-header-group}
.n{text-align:right;white-space:nowrap}
.note{color:#59636e;font-size:9pt}
.ids{font-size:8pt}
.warnings{border:0.5mm solid #b3261e;padding:2mm 3mm;break-inside:avoid}
.warnings h2{margin:0;color:#b3261e}
.boxes{list-style:none;padding:0}
.boxes li{break-inside:avoid;padding-left:7mm;text-indent:-7mm;margin:1.2mm 0}
.box{display:inline-block;width:3.4mm;height:3.4mm;border:0.3mm solid #1f2328;margin-right:3.2mm;
vertical-align:-0.4mm;text-indent:0}
.line{display:inline-block;min-width:22mm;border-bottom:0.2mm solid #1f2328}
@media print{body{margin:0;padding:0;max-width:none}}
</style>
</head>
<body>
)html";

std::string Row(const char* name, const std::string& value) {
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, EscapeXml(value));
}

std::string Title(const Plan& plan) {
  const auto buildings = std::ranges::count(plan.footprints, false, &PlannedFootprint::is_obstacle);
  return fmt::format(
      "<h1>Checklist of the flight</h1>\n<p>{} building{}, {} facades around {:.5f}, {:.5f} (WGS "
      "84); method {}</p>\n",
      buildings, buildings == 1 ? "" : "s", plan.facades.size(), plan.origin.latitude_deg,
      plan.origin.longitude_deg, EscapeXml(plan.method));
}

std::string Warnings(const PlanStats& stats) {
  if (stats.warnings.empty()) return {};
  std::string html = "<section class=\"warnings\"><h2>Warnings</h2>\n<ul>\n";
  for (const std::string& warning : stats.warnings) {
    html += fmt::format("<li>{}</li>\n", EscapeXml(warning));
  }
  return html + "</ul></section>\n";
}

std::string FactsTable(const Plan& plan, const PlanStats& stats) {
  std::string html = "<section><h2>The plan</h2>\n<table>\n";
  html += Row("Camera", stats.camera);
  const double coarsest_mm = 1000 * internal::PixelAt(plan.camera, plan.d_max_m);
  html +=
      Row("Pixel on walls", fmt::format("at most {:.1f} mm, as asked: walls count up to {:.1f} m "
                                        "(d_max)",
                                        coarsest_mm, plan.d_max_m));
  html += Row("Distance to the map",
              fmt::format("{:g} m (d_min), of which errors of map and drone "
                          "may use up {:.1f} m, and {:.1f} m in height",
                          plan.d_min_m, stats.horizontal_error_m, stats.vertical_error_m));
  html += Row(
      "Safe altitude H",
      fmt::format("{:.0f} m above the ground, over everything on the map", plan.safe_altitude_m));
  html += Row("Lowest flight", fmt::format("{:g} m above the ground", plan.min_altitude_m));
  html +=
      Row("Ground", stats.flat_within_m
                        ? fmt::format("taken to be flat; may rise by {:.1f} m above the take-off "
                                      "point",
                                      *stats.flat_within_m)
                        : "as the terrain that was given");
  html +=
      Row("To be taken",
          fmt::format("{} photos at {} stops in {} flight{}, {:.2f} km, {:.0f} min", stats.photos,
                      stats.hovers, plan.flights.size(), plan.flights.size() == 1 ? "" : "s",
                      stats.length_m / 1000, stats.time_min));
  return html + "</table></section>\n";
}

std::string Apps(const FieldFacts& facts) {
  if (facts.missions.notes.empty()) return {};
  std::string html = "<section><h2>In the app</h2>\n<ul>\n";
  for (const std::string& note : facts.missions.notes) {
    html += fmt::format("<li>{}</li>\n", EscapeXml(note));
  }
  return html + "</ul></section>\n";
}

}  // namespace

std::string ChecklistHtml(const Plan& plan, const PlanStats& stats, const FieldFacts& facts) {
  std::string html = kHead + Title(plan) + Warnings(stats) + FactsTable(plan, stats);
  html += internal::FlightsSection(plan, facts) + internal::CameraSection(plan) + Apps(facts);
  html += internal::SunSection(plan, facts) + internal::GroundPointsSection(plan, facts);
  return html + internal::OnSiteSection(plan, facts) + "</body>\n</html>\n";
}

}  // namespace stucco::plan
