// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/record_findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

constexpr double kMuchYaw_deg = 2;
constexpr double kMuchMount_deg = 1;
constexpr double kMuchShift_m = 1;
// Good gimbals hold 0.2 degrees, consumer ones 0.5; GPS without corrections 1.5 m.
constexpr double kMuchAttitude_deg = 1.2;
constexpr double kMuchScatter_m = 2.5;
constexpr int kEnoughPhotos = 8;  // that a flight's deviation is its own
// Positions that lie so far off are named whatever their flight scatters by.
constexpr double kElsewhere_m = 3;
constexpr size_t kMostNamed = 4;
// What maps are off by themselves.
constexpr double kMuchOffMap_m = 0.3;
constexpr double kSureSigmas = 3;

void AddFlight(const CalibratedFlight& flight, size_t number, std::vector<std::string>& out) {
  const double shift =
      std::hypot(flight.shift_m[0], std::hypot(flight.shift_m[1], flight.shift_m[2]));
  if (std::abs(flight.yaw_deg) > kMuchYaw_deg) {
    out.push_back(
        fmt::format("flight {}: its recorded yaw is {:.1f} degrees off; calibrate the compass",
                    number, std::abs(flight.yaw_deg)));
  }
  if (shift > kMuchShift_m) {
    out.push_back(
        fmt::format("flight {}: its positions are shifted by {:.1f} m against those of the "
                    "other flights, which was taken into account",
                    number, shift));
  }
  if (flight.photos >= kEnoughPhotos && flight.sigma_horizontal_m > kMuchScatter_m) {
    out.push_back(
        fmt::format("flight {}: its recorded positions scatter by {:.1f} m; where the model "
                    "has to be in place, fly with RTK or give control points",
                    number, flight.sigma_horizontal_m));
  }
}

void AddElsewhere(std::span<const CalibratedPhoto> photos, std::vector<std::string>& out) {
  std::vector<const CalibratedPhoto*> elsewhere;
  size_t recorded = 0;
  for (const CalibratedPhoto& photo : photos) {
    recorded += photo.prior_residual_m >= 0;
    if (photo.prior_outlier && photo.prior_residual_m > kElsewhere_m) elsewhere.push_back(&photo);
  }
  if (elsewhere.empty()) return;
  std::ranges::stable_sort(elsewhere, std::ranges::greater{}, &CalibratedPhoto::prior_residual_m);
  std::vector<std::string> names;
  for (size_t i = 0; i < std::min(elsewhere.size(), kMostNamed); ++i) {
    names.push_back(elsewhere[i]->path);
  }
  out.push_back(
      fmt::format("{} of {} recorded positions are not where the photos were taken, by up to "
                  "{:.0f} m ({}{}); they were not used",
                  elsewhere.size(), recorded, elsewhere.front()->prior_residual_m,
                  fmt::join(names, ", "), elsewhere.size() > kMostNamed ? " ..." : ""));
}

}  // namespace

std::vector<std::string> MapFindings(const CalibratedMap& map) {
  const double shift = std::hypot(map.shift_m[0], map.shift_m[1]);
  const std::string where = fmt::format(
      "{:.2f} m from where the photos' positions put the model ({:.2f} m east, {:.2f} m north, "
      "{:.2f} degrees; {} walls, good to {:.2f} m)",
      shift, map.shift_m[0], map.shift_m[1], map.turn_deg, map.walls, map.sigma_m);
  if (map.moved) return {"the model was moved onto the map, whose walls are " + where};
  if (shift < std::max(kMuchOffMap_m, kSureSigmas * map.sigma_m)) return {};
  return {"the map's walls are " + where +
          "; where the map is known better, set calib.georef to map"};
}

std::vector<std::string> RecordFindings(const CalibratedRecords& records,
                                        std::span<const CalibratedPhoto> photos) {
  std::vector<std::string> out;
  for (size_t f = 0; f < records.flights.size(); ++f) AddFlight(records.flights[f], f + 1, out);
  if (records.mount_deg > kMuchMount_deg) {
    out.push_back(fmt::format(
        "the camera looks {:.1f} degrees beside what the gimbal says; calibrate the gimbal",
        records.mount_deg));
  }
  if (records.attitude_sigma_deg > kMuchAttitude_deg) {
    out.push_back(
        fmt::format("the gimbal's angles scatter by {:.1f} degrees; they guide little then: "
                    "calibrate the gimbal, and see that nothing touches it",
                    records.attitude_sigma_deg));
  }
  AddElsewhere(photos, out);
  return out;
}

}  // namespace stucco
