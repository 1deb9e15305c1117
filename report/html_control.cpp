// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "report/internal/html_sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

Verdict VerdictOf(const std::string& name) {
  for (const Verdict verdict : {Verdict::kGreen, Verdict::kAmber, Verdict::kRed}) {
    if (Name(verdict) == name) return verdict;
  }
  return Verdict::kUnknown;
}

std::string ToMillimetres(double length_m) {
  return fmt::format("{:.3f}", length_m);
}

std::string ErrorCells(const CalibratedPoint& point) {
  std::string cells;
  for (size_t axis = 0; axis < 3; ++axis) {
    cells += fmt::format("<td class=\"num\">{}</td>",
                         axis < point.error_m.size() ? ToMillimetres(point.error_m[axis]) : "-");
  }
  return cells;
}

std::string PointRow(const CalibratedPoint& point) {
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"state\">{}</td><td class=\"num\">{}</td>"
      "{}<td class=\"num\">{}</td><td>{}</td><td>{}</td></tr>",
      IsolatedHtml(point.name), EscapeHtml(point.role), EscapeHtml(point.state), point.photos,
      ErrorCells(point),
      point.reprojection_error_px < 0 ? "-" : Decimal(point.reprojection_error_px, 2) + " px",
      point.verdict.empty() ? "" : VerdictBadge(VerdictOf(point.verdict)), EscapeHtml(point.why));
}

std::string PointTable(const std::vector<CalibratedPoint>& points) {
  std::string html =
      "<table class=\"plain\"><thead><tr><th scope=\"col\">Point</th><th scope=\"col\">Role</th>"
      "<th scope=\"col\">State</th><th scope=\"col\" class=\"num\">Photos</th>"
      "<th scope=\"col\" class=\"num\">East, m</th><th scope=\"col\" class=\"num\">North, m</th>"
      "<th scope=\"col\" class=\"num\">Up, m</th>"
      "<th scope=\"col\" class=\"num\">Reprojection error</th><th scope=\"col\">Verdict</th>"
      "<th scope=\"col\"></th></tr></thead><tbody>";
  for (const CalibratedPoint& point : points) html += PointRow(point);
  return html + "</tbody></table>";
}

std::string SetFigure(const std::string& name, const CalibratedPointSet& set) {
  return Figure(name,
                fmt::format("{} m {}", ToMillimetres(set.horizontal_rms_m),
                            VerdictBadge(VerdictOf(set.verdict))),
                fmt::format("horizontal rms of {} ({} pixels on the ground); vertical {} m ({}); "
                            "reprojection {} px",
                            set.points, Decimal(set.horizontal_rms_m / set.ground_pixel_m, 1),
                            ToMillimetres(set.vertical_rms_m),
                            Decimal(set.vertical_rms_m / set.ground_pixel_m, 1),
                            Decimal(set.reprojection_error_px, 2)));
}

}  // namespace

std::string GroundControlSection(const PageContent& page) {
  if (!page.data.calibration || page.data.calibration->ground_control.empty()) return "";
  const Calibration& calibration = *page.data.calibration;
  std::string html =
      "<section aria-labelledby=\"ground-control\"><h2 id=\"ground-control\">Ground control</h2>"
      "<dl class=\"measures\">";
  if (calibration.check_rms) html += SetFigure("Check points", *calibration.check_rms);
  if (calibration.control_rms) html += SetFigure("Control points", *calibration.control_rms);
  html +=
      "</dl><p>Errors are where the marks in the photos put a point, minus where it was "
      "surveyed. ";
  html += calibration.check_rms
              ? "Check points took part in nothing: their errors are the accuracy of the model. "
              : "There is no check point: errors of control points only say how well the model "
                "bends to them. ";
  html +=
      "Good is up to two pixels on the ground horizontally and three vertically, or what the "
      "points are known to where that is more; poor is over twice as much.</p>";
  return html + "<div class=\"scroll\">" + PointTable(calibration.ground_control) +
         "</div></section>";
}

}  // namespace stucco::internal
