// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "report/internal/html_sections.h"
#include "report/photo_trust.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

std::string LeftOutTable(const std::vector<LeftOutPhoto>& photos) {
  std::string html =
      "<table class=\"plain\"><thead><tr><th scope=\"col\">Photo</th><th scope=\"col\"></th>"
      "<th scope=\"col\">Why, and what to do</th></tr></thead><tbody>";
  for (const LeftOutPhoto& photo : photos) {
    html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"state\">{}</td><td>{}</td></tr>",
                        IsolatedHtml(photo.path), photo.what, EscapeHtml(photo.why));
  }
  return html + "</tbody></table>";
}

std::string PhotoTable(const Calibration& calibration, bool metric) {
  std::string html =
      "<table class=\"plain\"><thead><tr><th scope=\"col\">Photo</th>"
      "<th scope=\"col\" class=\"num\">Reprojection error</th>"
      "<th scope=\"col\" class=\"num\">Observations</th>"
      "<th scope=\"col\" class=\"num\">Picture covered</th><th scope=\"col\">State</th>"
      "<th scope=\"col\" class=\"num\">In its picture</th>"
      "<th scope=\"col\" class=\"num\">From its GPS position</th></tr></thead><tbody>";
  for (const CalibratedPhoto& photo : calibration.photos) {
    if (!IsInMainModel(calibration, photo)) continue;
    const std::string residual =
        photo.prior_residual_m < 0 ? "-" : Length(photo.prior_residual_m, metric);
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"num\">{} px</td><td class=\"num\">{}</td>"
        "<td class=\"num\">{}</td><td>{}</td><td class=\"num\">{}</td>"
        "<td class=\"num\">{}{}</td></tr>",
        IsolatedHtml(photo.path), Decimal(photo.reprojection_error_px, 2), photo.observations,
        Percent(photo.coverage), Name(photo.state),
        photo.picture_sigma_px < 0 ? "-" : "± " + Decimal(photo.picture_sigma_px, 1) + " px",
        residual, photo.prior_outlier ? " (not used)" : "");
  }
  return html + "</tbody></table>";
}

bool IsHeld(const CalibratedCamera& camera, const std::string& name) {
  for (const std::string& held : camera.held) {
    if (held == name) return true;
  }
  return false;
}

std::string CameraTable(const CalibratedCamera& camera) {
  std::string head;
  std::string values;
  std::string sigmas;
  for (size_t i = 0; i < camera.names.size() && i < camera.params.size(); ++i) {
    const bool is_pixels = std::abs(camera.params[i]) >= 10;
    head += fmt::format("<th scope=\"col\" class=\"num\">{}</th>", EscapeHtml(camera.names[i]));
    values +=
        fmt::format("<td class=\"num\">{}</td>", Decimal(camera.params[i], is_pixels ? 2 : 5));
    const bool known = i < camera.sigma.size() && camera.sigma[i] > 0;
    const std::string sigma = IsHeld(camera, camera.names[i]) ? "held"
                              : known ? "± " + Decimal(camera.sigma[i], is_pixels ? 2 : 5)
                                      : "";
    sigmas += fmt::format("<td class=\"num quiet\">{}</td>", sigma);
  }
  return fmt::format(
      "<h4>{} <span class=\"quiet\">{}</span></h4><div class=\"scroll\"><table class=\"plain\">"
      "<thead><tr>{}</tr></thead><tbody><tr>{}</tr><tr>{}</tr></tbody></table></div>",
      IsolatedHtml(camera.label), EscapeHtml(camera.model), head, values, sigmas);
}

std::string_view PositionsOf(const Georef& georef) {
  if (georef.source == kGroundControlSource) return "ground control points";
  if (georef.source == "plan") return "the positions of the plan, to some metres";
  if (georef.source == "file") return "the model that was imported";
  return georef.source == "rtk" ? "RTK positions" : "GPS positions";
}

std::string GeorefText(const PageContent& page) {
  const SurveyData& data = page.data;
  if (!data.georef) return "";
  if (!data.metric) {
    return "Nothing in the photos fixes scale, place and north: lengths are in units of the model, "
           "and only ratios of lengths mean something.";
  }
  if (data.georef->frame == "enu") {
    return fmt::format(
        "Lengths are metres; east, north and up are known from {}{}. Origin: latitude {:.7f}, "
        "longitude {:.7f}, height {:.2f} m.",
        PositionsOf(*data.georef), data.georef->on_map ? ", moved onto the map's walls" : "",
        data.georef->origin_latitude_deg, data.georef->origin_longitude_deg,
        data.georef->origin_height_m);
  }
  return "Lengths are metres.";
}

}  // namespace

std::string PhotosSection(const PageContent& page) {
  const auto left_out = LeftOutPhotos(page.data);
  if (left_out.empty()) return "";
  return fmt::format(
      "<section aria-labelledby=\"left-out\"><h2 id=\"left-out\">{} left out, and why</h2>{}"
      "</section>",
      Count(static_cast<int>(left_out.size()), "photo", "photos"), LeftOutTable(left_out));
}

std::string CalibrationSection(const PageContent& page) {
  if (!page.data.calibration) return "";
  const Calibration& calibration = *page.data.calibration;
  const bool metric = page.data.metric;
  std::string html =
      "<section aria-labelledby=\"calibration\"><h2 id=\"calibration\">Calibration</h2>"
      "<dl class=\"measures\">";
  html += Figure("Photos posed",
                 fmt::format("{} of {}", calibration.photos_posed, calibration.photos_total));
  html += Figure("Reprojection error", Decimal(calibration.reprojection_error_px, 2) + " px",
                 "mean over all observations");
  html += Figure("Points", fmt::format("{}", calibration.points),
                 "seen in " + Decimal(calibration.mean_track_length, 1) + " photos on average");
  if (calibration.prior_rms_horizontal_m >= 0) {
    html +=
        Figure("From the GPS positions", Length(calibration.prior_rms_horizontal_m, metric),
               "horizontal rms; vertical " + (calibration.prior_rms_vertical_m >= 0
                                                  ? Length(calibration.prior_rms_vertical_m, metric)
                                                  : std::string("not known")));
  }
  html += "</dl>";
  if (!calibration.findings.empty()) {
    html += "<ul class=\"findings\">";
    for (const std::string& finding : calibration.findings) {
      html += fmt::format("<li>{}</li>", EscapeHtml(finding));
    }
    html += "</ul>";
  }
  html += fmt::format(
      "<p>{} These figures say how well the photos agree with each other; {}</p>", GeorefText(page),
      calibration.check_rms ? "what was compared with independent measurements stands under ground "
                              "control."
                            : "nothing here was compared with independent measurements.");
  for (const CalibratedCamera& camera : calibration.cameras) html += CameraTable(camera);
  if (!calibration.photos.empty()) {
    html +=
        fmt::format("<details><summary>All {}</summary><div class=\"scroll\">{}</div></details>",
                    Count(CountInMainModel(calibration), "posed photo", "posed photos"),
                    PhotoTable(calibration, metric));
  }
  return html + "</section>";
}

}  // namespace stucco::internal
