// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/place_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SVD>
#include <algorithm>

#include "pipeline/verbs/internal/map_frame.h"

namespace stucco {
namespace {

Eigen::Vector3d MeanCentre(const Reconstruction& model) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& [id, photo] : model.photos) mean += photo.cam_from_world.Center();
  return mean / static_cast<double>(model.photos.size());
}

// Both frames are rigid: three steps along the axes of one say how it lies in the other.
Similarity BetweenPlaces(const Georef& from, const Georef& to) {
  constexpr double kStep_m = 1000;
  const auto moved = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d geodetic = GeodeticFromEnu(from, point);
    return EnuFromGeodetic(to, geodetic[0], geodetic[1], geodetic[2]);
  };
  Similarity result;
  result.translation = moved(Eigen::Vector3d::Zero());
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) {
    axes.col(i) = (moved(kStep_m * Eigen::Vector3d::Unit(i)) - result.translation) / kStep_m;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  result.rotation =
      Eigen::Quaterniond(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose())).normalized();
  return result;
}

// A frame whose origin is far away is level and points north there, not here.
void BringNear(ExchangedModel& source) {
  constexpr double kFar_m = 1000;
  const Eigen::Vector3d mean = MeanCentre(source.model);
  if (mean.head<2>().norm() <= kFar_m) return;
  const Eigen::Vector3d place = GeodeticFromEnu(*source.georef, mean);
  Georef near = *source.georef;
  near.origin_latitude_deg = place[0];
  near.origin_longitude_deg = place[1];
  near.origin_height_m = place[2];
  Transform(BetweenPlaces(*source.georef, near), source.model);
  source.georef = near;
}

// A frame that the file names is believed, and held against what the photos recorded.
void CompareWithFile(PlacedModel& placed) {
  constexpr double kSuspicious_m = 20;
  if (!(placed.differences.median_horizontal_m > kSuspicious_m)) return;
  placed.notes.push_back(
      fmt::format("its cameras are {:.0f} m from the positions that the photos recorded (median, "
                  "horizontal); check the coordinate system that it was exported in",
                  placed.differences.median_horizontal_m));
}

void NoteOutliers(PlacedModel& placed) {
  if (placed.outliers.empty()) return;
  const size_t shown = std::min<size_t>(placed.outliers.size(), 3);
  placed.notes.push_back(fmt::format(
      "{} recorded positions contradict the others and were not used: {}{}", placed.outliers.size(),
      fmt::join(placed.outliers.begin(), placed.outliers.begin() + shown, ", "),
      placed.outliers.size() > shown ? " ..." : ""));
}

void PlaceByPhotos(const Captures* captures, Reconstruction& model, PlacedModel& placed) {
  const ModelPlace place = PlaceByRecords(captures != nullptr ? *captures : Captures(), model);
  placed.georef = place.georef;
  placed.outliers = place.outliers;
  Transform(place.world_from_model, model);
  if (!place.why_not.empty()) {
    placed.notes.push_back(
        fmt::format("it keeps directions{} of its own, and walls get no names from the plan: {}",
                    place.georef.metric ? "" : " and a scale", place.why_not));
  }
}

}  // namespace

PlacedModel PlaceModel(const std::filesystem::path& file, const Captures* captures,
                       ExchangedModel& source) {
  PlacedModel placed;
  const bool file_says_it = source.georef.has_value() || !source.crs.empty();
  if (!source.crs.empty()) {
    source.georef = MoveFromMap(source.crs, file.string(), source.model);
    constexpr size_t kShown = 60;  // WKT is longer than anybody reads
    placed.notes.push_back(
        fmt::format("its positions were taken from the map {}{}, its heights as they are",
                    source.crs.substr(0, kShown), source.crs.size() > kShown ? " ..." : ""));
    source.crs.clear();
  } else if (source.georef) {
    BringNear(source);
  }
  if (source.georef) {
    placed.georef = *source.georef;
  } else {
    PlaceByPhotos(captures, source.model, placed);
  }
  if (placed.georef.frame == "enu" && captures != nullptr) {
    placed.differences =
        CompareWithPositions(*captures, placed.georef, source.model, placed.outliers);
  }
  if (file_says_it) {
    CompareWithFile(placed);
  } else if (placed.differences.rms_horizontal_m >= 0) {
    placed.notes.push_back(
        fmt::format("it was brought to the positions that its photos recorded: they differ by "
                    "{:.2f} m horizontally and {:.2f} m vertically (root mean square); with "
                    "use_positions = false below [calib] it keeps its own frame, for a cloud of "
                    "the same program",
                    placed.differences.rms_horizontal_m, placed.differences.rms_vertical_m));
  }
  NoteOutliers(placed);
  return placed;
}

}  // namespace stucco
