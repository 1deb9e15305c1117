// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/field/sun_window.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>

#include "survey/degree.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

constexpr int kFirstYear = 1950;
constexpr int kLastYear = 2100;

// Towards the sun (east, north, up) at an hour of solar time.
Eigen::Vector3d SunDirection(const SunDay& day, double latitude_rad, double hour) {
  const double angle = 15 * (hour - 12) * kDegree;
  const double sin_d = std::sin(day.declination_rad), cos_d = std::cos(day.declination_rad);
  const double sin_l = std::sin(latitude_rad), cos_l = std::cos(latitude_rad);
  return {-cos_d * std::sin(angle), cos_l * sin_d - sin_l * cos_d * std::cos(angle),
          sin_l * sin_d + cos_l * cos_d * std::cos(angle)};
}

Date ParseDate(std::string_view text) {
  const auto bad = [&](const char* why) {
    return Error(ErrorKind::kUsage, fmt::format("date = \"{}\": {}", text, why),
                 "write year, month and day, as in 2026-06-21");
  };
  const bool has_form = text.size() == 10 && text[4] == '-' && text[7] == '-';
  if (!has_form) throw bad("is no date");
  int parts[3] = {};
  const std::string_view digits[3] = {text.substr(0, 4), text.substr(5, 2), text.substr(8, 2)};
  for (int i = 0; i < 3; ++i) {
    for (const char c : digits[i]) {
      if (c < '0' || c > '9') throw bad("is no date");
      parts[i] = 10 * parts[i] + (c - '0');
    }
  }
  const Date date = std::chrono::year(parts[0]) / parts[1] / parts[2];
  if (!date.ok()) throw bad("is a day that no calendar has");
  if (parts[0] < kFirstYear || parts[0] > kLastYear) throw bad("lies outside 1950 to 2100");
  return date;
}

}  // namespace

SunDay SunOn(const Date& date) {
  // Days from 2000-01-01 12:00.
  const std::chrono::sys_days j2000 =
      Date(std::chrono::year(2000), std::chrono::January, std::chrono::day(1));
  const double t = static_cast<double>((std::chrono::sys_days(date) - j2000).count()) / 36525;
  const double mean_longitude = (280.46646 + t * (36000.76983 + 0.0003032 * t)) * kDegree;
  const double anomaly = (357.52911 + t * (35999.05029 - 0.0001537 * t)) * kDegree;
  const double eccentricity = 0.016708634 - t * (0.000042037 + 0.0000001267 * t);
  const double center =
      (std::sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t)) +
       std::sin(2 * anomaly) * (0.019993 - 0.000101 * t) + std::sin(3 * anomaly) * 0.000289) *
      kDegree;
  const double node = (125.04 - 1934.136 * t) * kDegree;
  const double longitude = mean_longitude + center - (0.00569 + 0.00478 * std::sin(node)) * kDegree;
  const double obliquity = (23.43929111 - 0.0130042 * t + 0.00256 * std::cos(node)) * kDegree;
  const double y = std::pow(std::tan(obliquity / 2), 2);
  const double equation = y * std::sin(2 * mean_longitude) - 2 * eccentricity * std::sin(anomaly) +
                          4 * eccentricity * y * std::sin(anomaly) * std::cos(2 * mean_longitude) -
                          0.5 * y * y * std::sin(4 * mean_longitude) -
                          1.25 * eccentricity * eccentricity * std::sin(2 * anomaly);
  return {date, std::asin(std::sin(obliquity) * std::sin(longitude)), 4 * equation / kDegree};
}

std::vector<SunDay> SunDays(std::string_view date) {
  if (!date.empty()) return {SunOn(ParseDate(date))};
  // Of any year: the sun is at the same place within 0.3 degrees.
  const std::chrono::year year(2026);
  return {SunOn(year / std::chrono::March / 20), SunOn(year / std::chrono::June / 21),
          SunOn(year / std::chrono::December / 21)};
}

double SolarNoonUtc(const SunDay& day, double longitude_deg) {
  const double noon = 720 - 4 * longitude_deg - day.equation_of_time_min;
  return noon - 1440 * std::floor(noon / 1440);
}

SunWindow SunOnWall(const SunDay& day, double latitude_deg, double azimuth_deg) {
  constexpr int kMinutes = 24 * 60;
  const Eigen::Vector2d outwards(std::sin(azimuth_deg * kDegree), std::cos(azimuth_deg * kDegree));
  SunWindow window;
  bool shone = false;
  for (int minute = 0; minute <= kMinutes; ++minute) {
    const double hour = minute / 60.0;
    const Eigen::Vector3d sun = SunDirection(day, latitude_deg * kDegree, hour);
    const double on_wall = sun.head<2>().dot(outwards);
    const bool is_up = sun.z() >= std::sin(kLowSun_deg * kDegree);
    const bool shines = is_up && on_wall >= std::sin(kGrazing_deg * kDegree);
    window.grazes = window.grazes || (is_up && on_wall > 0);
    if (shines && !shone) window.hours.push_back({hour, hour});
    if (shines) window.hours.back().to_h = hour;
    shone = shines;
  }
  std::erase_if(window.hours, [](const HourSpan& span) { return !(span.to_h > span.from_h); });
  window.grazes = window.grazes && window.hours.empty();
  return window;
}

}  // namespace stucco::plan
