// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/barometer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "calib/records/flights.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr size_t kEnoughReadings = 8;
// Satellite heights that state less are better than a barometer.
constexpr double kByRtk_m = 0.3;
// What a barometer may drift by within a flight beyond a steady drift.
constexpr double kBarometer_m = 1;
constexpr double kLeastScatter_m = 0.05;  // of satellite heights; below, nothing is gained
constexpr double kSureDrift = 3;          // of its own standard deviation
constexpr double kTooFarApart = 3;        // times the satellites' noise
// The standard deviation of a median of normal variables over that of the mean.
constexpr double kMedianOverMean = 1.25;

// A photo with both heights.
struct Reading {
  double time = 0;
  double satellite_m = 0;
  double barometer_m = 0;
  double stated_m = 0;  // standard deviation of the satellite height

  double Apart() const { return satellite_m - barometer_m; }
};

// Satellite height minus barometric height, as a function of time.
struct Offset {
  double at_middle_m = 0;
  double middle = 0;
  double per_time = 0;
  double scatter_m = 0;  // of the satellite heights about it
  double sigma_m = 0;    // of the offset in the middle

  double At(double time) const { return at_middle_m + per_time * (time - middle); }
};

double ScatterAbout(const Offset& offset, const std::vector<Reading>& readings) {
  std::vector<double> off;
  off.reserve(readings.size());
  for (const Reading& reading : readings) {
    off.push_back(std::abs(reading.Apart() - offset.At(reading.time)));
  }
  return *Median(std::move(off)) / kMedianOfNormal;
}

// The median of the slopes between all pairs (Theil 1950, Sen 1968) of readings in different halves
// of the flight: those near in time say nothing of a drift.
double SlopeOf(const std::vector<Reading>& readings) {
  const size_t half = readings.size() / 2;
  std::vector<double> slopes;
  slopes.reserve(half * (readings.size() - half));
  for (size_t i = 0; i < half; ++i) {
    for (size_t k = half; k < readings.size(); ++k) {
      const double passed = readings[k].time - readings[i].time;
      if (passed > 0) slopes.push_back((readings[k].Apart() - readings[i].Apart()) / passed);
    }
  }
  return Median(std::move(slopes)).value_or(0);
}

void SetMiddle(const std::vector<Reading>& readings, Offset& offset) {
  std::vector<double> at_middle;
  at_middle.reserve(readings.size());
  for (const Reading& reading : readings) {
    at_middle.push_back(reading.Apart() - offset.per_time * (reading.time - offset.middle));
  }
  offset.at_middle_m = *Median(std::move(at_middle));
  offset.scatter_m = ScatterAbout(offset, readings);
}

Offset FitOffset(const std::vector<Reading>& readings) {
  const auto count = static_cast<double>(readings.size());
  const double length = readings.back().time - readings.front().time;
  Offset level;
  level.middle = readings.front().time + length / 2;
  SetMiddle(readings, level);
  Offset drifting = level;
  drifting.per_time = SlopeOf(readings);
  SetMiddle(readings, drifting);
  // Of readings spread evenly over the flight.
  const double sigma_of_ends = kMedianOverMean * drifting.scatter_m * std::sqrt(12 / count);
  const bool drifts = std::abs(drifting.per_time) * length > kSureDrift * sigma_of_ends;
  Offset offset = drifts ? drifting : level;
  offset.sigma_m = kMedianOverMean * offset.scatter_m / std::sqrt(count);
  return offset;
}

// How much both heights vary between photos at about one height: of the half of the steps in which
// both together change least, root mean squares over that of two readings.
struct Noise {
  double satellite_m = 0;
  double barometer_m = 0;
};

Noise NoiseOf(const std::vector<Reading>& readings) {
  std::vector<std::pair<double, double>> steps;
  for (size_t i = 1; i < readings.size(); ++i) {
    steps.emplace_back(readings[i].satellite_m - readings[i - 1].satellite_m,
                       readings[i].barometer_m - readings[i - 1].barometer_m);
  }
  std::ranges::stable_sort(steps, {},
                           [](const auto& step) { return std::abs(step.first + step.second); });
  steps.resize((steps.size() + 1) / 2);
  Noise noise;
  for (const auto& [satellite, barometer] : steps) {
    noise.satellite_m += satellite * satellite;
    noise.barometer_m += barometer * barometer;
  }
  const double count = 2 * static_cast<double>(steps.size());
  return {std::sqrt(noise.satellite_m / count), std::sqrt(noise.barometer_m / count)};
}

// Where the barometer's heights lie; nothing where they are no better than the satellites'.
std::optional<Offset> OffsetOf(const std::vector<Reading>& readings) {
  if (readings.size() < kEnoughReadings) return std::nullopt;
  std::vector<double> stated;
  stated.reserve(readings.size());
  for (const Reading& reading : readings) stated.push_back(reading.stated_m);
  if (*Median(std::move(stated)) < kByRtk_m) return std::nullopt;
  const auto [least, most] = std::ranges::minmax_element(readings, {}, &Reading::barometer_m);
  if (least->barometer_m == most->barometer_m) return std::nullopt;
  const Noise noise = NoiseOf(readings);
  const Offset offset = FitOffset(readings);
  if (offset.scatter_m < kLeastScatter_m || noise.barometer_m >= noise.satellite_m) return {};
  if (offset.scatter_m > kTooFarApart * noise.satellite_m) return std::nullopt;
  return offset;
}

}  // namespace

SteadiedHeights SteadyHeights(const Plan* plan, Captures& captures) {
  SteadiedHeights steadied;
  steadied.zero_sigma_m.assign(captures.photos.size(), 0);
  std::vector<CapturedPhoto*> photos;
  std::vector<size_t> index;
  for (size_t i = 0; i < captures.photos.size(); ++i) {
    CapturedPhoto& photo = captures.photos[i];
    if (!photo.usable || !photo.position || !photo.height_above_takeoff_m) continue;
    photos.push_back(&photo);
    index.push_back(i);
  }
  const std::vector<TakenIn> taken = ReadFlights({photos.begin(), photos.end()}, plan);
  std::vector<size_t> order(photos.size());
  int num_flights = 0;
  bool are_timed = true;
  for (size_t i = 0; i < photos.size(); ++i) {
    order[taken[i].order] = i;
    num_flights = std::max(num_flights, taken[i].flight + 1);
    are_timed = are_timed && taken[i].time_s;
  }
  const auto time_of = [&](size_t i) { return are_timed ? *taken[i].time_s : taken[i].order; };
  std::vector<std::vector<Reading>> flights(num_flights);
  for (const size_t i : order) {
    const GeoPosition& position = *photos[i]->position;
    if (!position.has_height) continue;
    flights[taken[i].flight].push_back({time_of(i), position.height_m,
                                        *photos[i]->height_above_takeoff_m,
                                        position.sigma_vertical_m});
  }
  std::vector<std::optional<Offset>> offsets;
  offsets.reserve(flights.size());
  for (const auto& readings : flights) offsets.push_back(OffsetOf(readings));
  for (size_t i = 0; i < photos.size(); ++i) {
    const std::optional<Offset>& offset = offsets[taken[i].flight];
    if (!offset) continue;
    GeoPosition& position = *photos[i]->position;
    const double barometer_m = std::hypot(kBarometer_m, offset->sigma_m);
    position.sigma_vertical_m =
        position.has_height ? std::min(position.sigma_vertical_m, barometer_m) : barometer_m;
    position.height_m = *photos[i]->height_above_takeoff_m + offset->At(time_of(i));
    position.has_height = true;
    steadied.zero_sigma_m[index[i]] = offset->sigma_m;
    ++steadied.num_photos;
    steadied.scatter_m = std::max(steadied.scatter_m, offset->scatter_m);
  }
  return steadied;
}

}  // namespace stucco
