// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/field/internal/checklist_sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "plan/output/internal/svg.h"
#include "survey/plan_frame.h"

namespace stucco::plan::internal {
namespace {

// Facades that face the same way within 5 degrees share a row.
constexpr int kDirectionStep_deg = 10;
// What is listed of them; a town has hundreds in a row.
constexpr size_t kMostNamed = 40;
// A pixel may smear over half of another: more shows.
constexpr double kSmear_px = 0.5;
// Metres a second, assumed of a drone that holds its place in a breeze.
constexpr double kDriftSpeed = 0.5;
// A target's centre is found well in a photo from about this size on.
constexpr double kTarget_px = 10;

std::string LatLon(const Plan& plan, const Eigen::Vector2d& at) {
  const Geodetic place = GeodeticFromPlan(plan.origin, at);
  return fmt::format("{:.6f}, {:.6f}", place.latitude_deg, place.longitude_deg);
}

std::string FlightRow(const Plan& plan, size_t index, const FieldFacts& facts) {
  const PlannedFlight& flight = plan.flights[index];
  const FlightFacts& about = facts.flights[index];
  const auto files = std::ranges::find(facts.missions.flights, index, &FlightFiles::flight);
  const PlannedTime& parts = flight.parts;
  std::string html = fmt::format(
      "<tr><td><span class=\"box\"></span>{}</td><td>{}</td><td class=\"n\">{} / {}</td>"
      "<td class=\"n\">{:.0f} m</td>",
      index + 1, LatLon(plan, plan.HomeOf(flight).head<2>()), about.stops, about.photos,
      flight.length_m);
  html += fmt::format(
      "<td>{:.1f} min: {:.1f} transfer, {:.1f} legs, {:.1f} stops, {:.1f} photos</td>"
      "<td class=\"n\">{:.0f} % + {:.0f} %</td>",
      flight.time_min, parts.transfer_min, parts.legs_min, parts.stops_min, parts.photos_min,
      flight.battery_percent, flight.reserve_percent);
  html += fmt::format("<td class=\"n\">{:.0f} to {:.0f} m</td><td class=\"n\">{:.0f} m</td></tr>\n",
                      about.lowest_m, about.highest_m, about.farthest_m);
  if (files == facts.missions.flights.end()) return html;
  return html + fmt::format(
                    "<tr><td></td><td colspan=\"7\" class=\"note\">{}; return height {:.0f} "
                    "m above the take-off point</td></tr>\n",
                    EscapeXml(fmt::format("{}", fmt::join(files->names, ", "))),
                    std::ceil(files->return_height_m));
}

// "S" of 180 degrees, in sixteen winds.
const char* WindName(int azimuth_deg) {
  static constexpr const char* kNames[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                           "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  return kNames[static_cast<int>(std::lround(azimuth_deg / 22.5)) % 16];
}

// Names of facades by the direction that they face.
std::map<int, std::vector<std::string>> ByDirection(const Plan& plan) {
  std::map<int, std::vector<std::string>> out;
  for (const PlannedFacade& facade : plan.facades) {
    const Eigen::Vector2d outwards = facade.outwards();
    const double azimuth = std::atan2(outwards.x(), outwards.y()) * 180 / std::numbers::pi;
    const int step = static_cast<int>(std::lround(azimuth / kDirectionStep_deg));
    constexpr int kSteps = 360 / kDirectionStep_deg;
    out[(step + kSteps) % kSteps * kDirectionStep_deg].push_back(facade.id);
  }
  return out;
}

std::string Named(const std::vector<std::string>& ids) {
  std::string text;
  for (size_t i = 0; i < std::min(ids.size(), kMostNamed); ++i) {
    text += (i == 0 ? "" : " ") + ids[i];
  }
  if (ids.size() > kMostNamed) text += fmt::format(" and {} more", ids.size() - kMostNamed);
  return EscapeXml(text);
}

// Times that nobody takes to the minute: to five.
std::string Clock(double hours) {
  const int minutes = static_cast<int>(std::lround(hours * 12)) * 5;
  return fmt::format("{}:{:02}", minutes / 60, minutes % 60);
}

std::string Hours(const SunWindow& window) {
  std::vector<std::string> spans;
  for (const HourSpan& span : window.hours) {
    spans.push_back(fmt::format("{} to {}", Clock(span.from_h), Clock(span.to_h)));
  }
  if (spans.empty()) return window.grazes ? "grazing" : "never";
  return fmt::format("{}", fmt::join(spans, ", "));
}

std::string DayName(const Date& date) {
  return fmt::format("{}-{:02}-{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

std::string Box(const std::string& text) {
  return fmt::format("<li><span class=\"box\"></span>{}</li>\n", text);
}

std::string Shutter(double pixel_m, double speed_m_per_s) {
  if (!(pixel_m > 0)) return "1/1000";
  return fmt::format("1/{:.0f}", std::ceil(speed_m_per_s / (kSmear_px * pixel_m) / 10) * 10);
}

}  // namespace

double PixelAt(const PlannedCamera& camera, double distance_m) {
  if (!(camera.focal_m > 0) || camera.width_px <= 0) return 0;
  return camera.sensor_width_m / camera.width_px / camera.focal_m * distance_m;
}

std::string FlightsSection(const Plan& plan, const FieldFacts& facts) {
  std::string html =
      "<section><h2>Flights</h2>\n<table><thead><tr><th>No.</th><th>Take-off point (WGS "
      "84)</th><th class=\"n\">Stops / photos</th><th class=\"n\">Length</th><th>Time</th>"
      "<th class=\"n\">Battery + reserve</th><th class=\"n\">Above ground</th>"
      "<th class=\"n\">Farthest</th></tr></thead>\n<tbody>\n";
  for (size_t i = 0; i < plan.flights.size(); ++i) html += FlightRow(plan, i, facts);
  return html +
         fmt::format(
             "</tbody></table>\n<p class=\"note\">Reckoned with {:g} m/s of wind and {:g} m/s "
             "between photos. The reserve is what the way home from the farthest stop takes "
             "against that wind. Heights are those above the ground right below; .kmz is for "
             "DJI Pilot 2, FlightHub 2 and DJI Fly, .csv for Litchi, .plan for "
             "QGroundControl.</p></section>\n",
             plan.pace.wind_m_per_s, plan.pace.speed_m_per_s);
}

std::string CameraSection(const Plan& plan) {
  const PlannedCamera& camera = plan.camera;
  const double finest = PixelAt(camera, plan.d_min_m);
  std::string html = "<section><h2>Camera settings (advice)</h2>\n<ul>\n";
  html += fmt::format(
      "<li>Shutter {} s or shorter: a drone at rest that drifts at {:g} m/s then smears the "
      "nearest "
      "wall ({:g} m, {:.1f} mm a pixel) by half a pixel at most. An app that takes photos in "
      "passing, "
      "at {:g} m/s, needs {} s. Let ISO follow, not the shutter.</li>\n",
      Shutter(finest, kDriftSpeed), kDriftSpeed, plan.d_min_m, 1000 * finest,
      plan.pace.speed_m_per_s, Shutter(finest, plan.pace.speed_m_per_s));
  html +=
      "<li>Mechanical shutter where the camera has one: an electronic one reads line by line and "
      "bends walls when the drone moves.</li>\n";
  html +=
      "<li>White balance fixed (sunny or cloudy), not automatic: the photos of a facade are to "
      "have one colour. Exposure automatic, metered over the whole frame.</li>\n";
  html += fmt::format(
      "<li>Focus once at {:.0f} m, which lies between the nearest and the farthest walls ({:g} to "
      "{:.0f} m), then leave it. No zoom, no digital zoom.</li>\n",
      std::sqrt(plan.d_min_m * std::max(plan.d_min_m, plan.d_max_m)), plan.d_min_m, plan.d_max_m);
  html += fmt::format(
      "<li>JPEG at full size, {} x {} pixels, least compression; correction of distortion "
      "off.</li>\n",
      camera.width_px, camera.height_px);
  return html + "</ul></section>\n";
}

std::string SunSection(const Plan& plan, const FieldFacts& facts) {
  std::string html =
      "<section><h2>Sun on the facades</h2>\n<table><thead><tr><th>Facing</th><th>Facades</th>";
  for (const SunDay& day : facts.days) html += fmt::format("<th>{}</th>", DayName(day.date));
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& [azimuth, ids] : ByDirection(plan)) {
    html += fmt::format("<tr><td>{} ({} degrees)</td><td class=\"ids\">{}</td>", WindName(azimuth),
                        azimuth, Named(ids));
    for (const SunDay& day : facts.days) {
      html += fmt::format("<td>{}</td>", Hours(SunOnWall(day, plan.origin.latitude_deg, azimuth)));
    }
    html += "</tr>\n";
  }
  std::vector<std::string> noons;
  for (const SunDay& day : facts.days) {
    noons.push_back(fmt::format("{} UTC on {}",
                                Clock(SolarNoonUtc(day, plan.origin.longitude_deg) / 60),
                                DayName(day.date)));
  }
  return html +
         fmt::format(
             "</tbody></table>\n<p class=\"note\">Hours of solar time: the sun is highest at "
             "12:00, which is {}. It shines on a wall when it is {:g} degrees up and {:g} "
             "degrees in front of the wall; grazing light makes every ledge throw a long "
             "shadow. Shadows of other buildings are left out. A bright overcast day suits "
             "all walls; in sunshine fly the photos of a facade in one go.</p></section>\n",
             fmt::join(noons, ", "), kLowSun_deg, kGrazing_deg);
}

std::string GroundPointsSection(const Plan& plan, const FieldFacts& facts) {
  std::string html = "<section><h2>Control and check points (advice)</h2>\n";
  html +=
      "<p>With a plain GNSS receiver in the drone, measure five control points (corners and "
      "middle); with RTK or PPK one or two are enough, and the others become check points. Check "
      "points are never used to fit anything: their errors are what you may promise. Listed in "
      "gcp_list.txt with where photos show them, control points hold the model; without them its "
      "place and scale come from the positions in the photos.</p>\n";
  if (facts.ground_points.empty()) {
    return html +
           "<p>No ground that is free and in view of enough photos was found.</p></section>\n";
  }
  html +=
      "<table><thead><tr><th>Point</th><th>Where</th><th>Near (WGS 84)</th><th "
      "class=\"n\">Planned photos</th><th class=\"n\">Target at least</th><th>Measured "
      "(E, N, height)</th></tr></thead>\n<tbody>\n";
  for (const GroundPoint& point : facts.ground_points) {
    html += fmt::format(
        "<tr><td><span class=\"box\"></span>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{:.0f} cm</td><td><span class=\"line\"></span></td></tr>\n",
        EscapeXml(point.name), EscapeXml(point.where),
        LatLon(plan, point.place.position_m.head<2>()), point.place.photos,
        std::ceil(100 * kTarget_px * point.place.gsd_m));
  }
  return html +
         fmt::format(
             "</tbody></table>\n<p class=\"note\">G control, C check. Proposed is the ground "
             "that most photos show, 3 m or more from walls; the map knows no parked cars and "
             "no trees that --obstacles leaves out, so move it to a hard, open place nearby. "
             "A target is {:g} pixels wide in the nearest photo.</p></section>\n",
             kTarget_px);
}

std::string OnSiteSection(const Plan& plan, const FieldFacts& facts) {
  size_t photos = plan.views.size();
  std::string html = "<section><h2>On site</h2>\n<ul class=\"boxes\">\n";
  html += Box("Airspace, permissions and notices checked for today; people on site informed.");
  html +=
      Box(fmt::format("Site walked: cranes, wires, scaffolds, trees that the map does not have. "
                      "The plan keeps {:g} m from the map and from nothing else.",
                      plan.d_min_m));
  html += Box(fmt::format("{} charged batter{}; room for {} photos on the card.",
                          plan.flights.size(), plan.flights.size() == 1 ? "y" : "ies", photos));
  html += Box("Control points laid and measured.");
  html += Box("Take-off point of the flight reached: all heights of a mission count from it.");
  html +=
      Box("Return height set as in the table of flights, above everything; obstacle sensing on "
          "brake; camera set as above; waypoints flown straight, without curved turns.");
  html +=
      Box("Wind below what the flights are reckoned with, or flights planned again with --wind: "
          "<span class=\"line\"></span> m/s");
  html +=
      Box(fmt::format("First stop of the first flight: the drone hangs where the plan puts it, and "
                      "not nearer than {:g} m to the wall. If not, fly home.",
                      plan.d_min_m));
  html +=
      Box("After each flight: as many photos as planned, sharp when seen at full size, equally "
          "bright.");
  std::vector<std::string> counts;
  for (size_t i = 0; i < facts.flights.size(); ++i) {
    counts.push_back(fmt::format("flight {}: <span class=\"line\"></span> of {}", i + 1,
                                 facts.flights[i].photos));
  }
  html += Box(fmt::format("Photos: {}", fmt::join(counts, "; ")));
  html += Box(
      "All cards copied into the survey's folder photos before leaving; check points measured.");
  return html + "</ul></section>\n";
}

}  // namespace stucco::plan::internal
