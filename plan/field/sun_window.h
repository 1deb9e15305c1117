// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string_view>
#include <vector>

namespace stucco::plan {

using Date = std::chrono::year_month_day;

// The sun on one day, at 12:00 UTC.
struct SunDay {
  Date date;
  double declination_rad = 0;
  double equation_of_time_min = 0;  // by which a sundial is ahead of a clock
};

// Meeus, "Astronomical Algorithms" (2nd edition, 1998), chapters 25 (low accuracy) and 28, with the
// coefficients of NOAA's Solar Calculator: within 0.01 degrees and some seconds for these years.
SunDay SunOn(const Date& date);

// "2026-06-21" is that day; nothing is 20 March (as good as 22 September), 21 June and 21 December.
// Throws Error (kUsage) for anything but a day of 1950 to 2100.
std::vector<SunDay> SunDays(std::string_view date);

// UTC of the local solar noon, in minutes from midnight.
double SolarNoonUtc(const SunDay& day, double longitude_deg);

// Lower sun is red, and neighbours hide it.
inline constexpr double kLowSun_deg = 5;
// Under a smaller angle to the wall, light rakes over it: every ledge throws a long shadow.
inline constexpr double kGrazing_deg = 10;

// In hours of local solar time, in which the sun is highest at 12.
struct HourSpan {
  double from_h = 0;
  double to_h = 0;
};

struct SunWindow {
  std::vector<HourSpan> hours;  // in which the sun shines on the wall; to the minute
  bool grazes = false;          // it does at no time, but rakes over it
};

// Of a vertical wall that faces `azimuth_deg` (clockwise from north) where nothing else throws a
// shadow.
SunWindow SunOnWall(const SunDay& day, double latitude_deg, double azimuth_deg);

}  // namespace stucco::plan
