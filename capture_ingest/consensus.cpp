// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/consensus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr size_t kFewest = 5;       // fewer photos have no majority to go by
constexpr double kMajority = 0.8;   // share of photos that must agree before one is doubted
constexpr double kNear_deg = 0.05;  // of latitude: about 5 km, more than any survey of buildings
constexpr double kFar_deg = 0.5;    // about 50 km
constexpr double kTypicalSpread_m = 150;  // of heights in one survey
constexpr double kWrongHeight_m = 400;    // from the median

// Records with a position, so that a test of the majority is one loop.
std::vector<PhotoRecord*> Positioned(std::vector<PhotoRecord>& records, bool with_height) {
  std::vector<PhotoRecord*> positioned;
  for (PhotoRecord& record : records) {
    const auto& position = record.photo.position;
    if (record.photo.usable && position && (!with_height || position->has_height)) {
      positioned.push_back(&record);
    }
  }
  return positioned;
}

bool IsMajority(size_t agreeing, size_t all) {
  return all >= kFewest && static_cast<double>(agreeing) >= kMajority * static_cast<double>(all);
}

// Longitudes that differ by a whole turn are equal.
double LongitudeDifference(double a_deg, double b_deg) {
  return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

void QuarantinePositions(std::vector<PhotoRecord>& records) {
  const auto positioned = Positioned(records, /*with_height=*/false);
  if (positioned.size() < kFewest) return;
  std::vector<double> latitudes;
  std::vector<double> longitudes;
  for (const PhotoRecord* record : positioned) {
    latitudes.push_back(record->photo.position->latitude_deg);
    longitudes.push_back(record->photo.position->longitude_deg);
  }
  const double latitude = *Median(latitudes);
  const double longitude = *Median(longitudes);
  const auto distance_deg = [&](const PhotoRecord& record) {
    const GeoPosition& at = *record.photo.position;
    const double shrink = std::cos(latitude * std::numbers::pi / 180);
    return std::hypot(at.latitude_deg - latitude,
                      LongitudeDifference(at.longitude_deg, longitude) * shrink);
  };
  const size_t near = std::count_if(positioned.begin(), positioned.end(), [&](const auto* record) {
    return distance_deg(*record) < kNear_deg;
  });
  if (!IsMajority(near, positioned.size())) return;
  for (PhotoRecord* record : positioned) {
    if (distance_deg(*record) < kFar_deg) continue;
    record->doubts.push_back(fmt::format("position {:.5f}, {:.5f} is far from all others",
                                         record->photo.position->latitude_deg,
                                         record->photo.position->longitude_deg));
    record->photo.position.reset();
  }
}

void QuarantineHeights(std::vector<PhotoRecord>& records) {
  const auto positioned = Positioned(records, /*with_height=*/true);
  if (positioned.size() < kFewest) return;
  std::vector<double> heights;
  heights.reserve(positioned.size());
  for (const PhotoRecord* record : positioned) heights.push_back(record->photo.position->height_m);
  const double median = *Median(heights);
  const size_t near = std::count_if(heights.begin(), heights.end(), [&](double height) {
    return std::abs(height - median) < kTypicalSpread_m;
  });
  if (!IsMajority(near, heights.size())) return;
  for (PhotoRecord* record : positioned) {
    GeoPosition& position = *record->photo.position;
    if (std::abs(position.height_m - median) < kWrongHeight_m) continue;
    record->doubts.push_back(
        fmt::format("height {:.1f} m is far from the median {:.1f} m", position.height_m, median));
    position.height_m = 0;
    position.has_height = false;
  }
}

}  // namespace

void QuarantineOutliers(std::vector<PhotoRecord>& records) {
  QuarantinePositions(records);
  QuarantineHeights(records);
}

bool UseHeightAboveTakeoff(std::vector<PhotoRecord>& records) {
  const auto positioned = Positioned(records, /*with_height=*/false);
  if (positioned.empty() || !Positioned(records, /*with_height=*/true).empty()) return false;
  bool used = false;
  for (PhotoRecord* record : positioned) {
    if (!record->photo.height_above_takeoff_m) continue;
    record->photo.position->height_m = *record->photo.height_above_takeoff_m;
    record->photo.position->has_height = true;
    used = true;
  }
  return used;
}

}  // namespace stucco
