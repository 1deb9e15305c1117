// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/place_part.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>

#include "survey/median.h"

namespace stucco {
namespace {

// Where photos look at, in the middle.
struct Sight {
  double distance_m = 0;  // along the optical axis
  double pixel_m = 0;     // what a pixel covers there
  double spacing_m = 0;   // between the points of a photo
};

Sight MiddleSight(const Scene& scene) {
  std::vector<double> distances;
  std::vector<double> pixels;
  std::vector<double> spacings;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (!scene.photos[i].pose) continue;
    std::vector<double> depths;
    for (const int track : TracksSeenBy(scene, i)) {
      depths.push_back((*scene.photos[i].pose * *scene.tracks[track].position).z());
    }
    if (depths.empty()) continue;
    const auto count = static_cast<double>(depths.size());
    const Camera& camera = scene.CameraOf(i);
    const double depth = *Median(std::move(depths));
    distances.push_back(depth);
    pixels.push_back(depth / camera.FocalX());
    spacings.push_back(depth / camera.FocalX() *
                       std::sqrt(static_cast<double>(camera.width_px) * camera.height_px / count));
  }
  return {Median(std::move(distances)).value_or(0), Median(std::move(pixels)).value_or(0),
          Median(std::move(spacings)).value_or(0)};
}

// Sums over the photos of a part that have a pose and a position.
struct RecordSums {
  int count = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  // of positions by axis, mean
  Eigen::Vector3d stated = Eigen::Vector3d::Zero();    // likewise, as stated
  int gimbals = 0;
};

Eigen::Vector3d VarianceOf(double horizontal, double vertical) {
  return {horizontal * horizontal, horizontal * horizontal, vertical * vertical};
}

RecordSums SumRecords(const std::vector<PoseRecord>& records, const RecordErrors* errors,
                      const Scene& part) {
  RecordSums sums;
  for (size_t i = 0; i < records.size(); ++i) {
    const ScenePhoto& photo = part.photos[i];
    if (!photo.pose || !records[i].position) continue;
    ++sums.count;
    sums.gimbals += records[i].gimbal.has_value();
    sums.middle += photo.pose->Center();
    const PositionPrior& stated = *records[i].position;
    sums.stated += VarianceOf(stated.sigma_horizontal_m, stated.sigma_vertical_m);
    if (errors != nullptr) {
      const FlightErrors& flight = errors->flights[records[i].flight];
      sums.variance += VarianceOf(flight.sigma_horizontal_m, flight.sigma_vertical_m);
    } else {
      sums.variance += (photo.pose->Center() - stated.position).cwiseAbs2();
    }
  }
  if (sums.count == 0) return sums;
  const double count = sums.count;
  sums.middle /= count;
  sums.stated /= count;
  sums.variance /= count;
  // Distances that a similarity was fitted to are too small.
  if (errors == nullptr) sums.variance *= 3 * count / std::max(1.0, 3 * count - 7);
  return sums;
}

bool ShareAFlight(const std::vector<PoseRecord>& records, const Scene& a, const Scene& b) {
  std::set<int> flights;
  for (size_t i = 0; i < records.size(); ++i) {
    if (a.photos[i].pose && records[i].position) flights.insert(records[i].flight);
  }
  for (size_t i = 0; i < records.size(); ++i) {
    if (b.photos[i].pose && records[i].position && flights.contains(records[i].flight)) return true;
  }
  return false;
}

using Cell = std::tuple<int64_t, int64_t, int64_t>;

Cell CellOf(const Eigen::Vector3d& point, double size_m) {
  const Eigen::Vector3d cell = (point / size_m).array().floor();
  return {static_cast<int64_t>(cell.x()), static_cast<int64_t>(cell.y()),
          static_cast<int64_t>(cell.z())};
}

bool HasNeighbour(const std::set<Cell>& cells, const Cell& at) {
  const auto& [x, y, z] = at;
  for (int i = 0; i < 27; ++i) {
    if (cells.contains({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1})) return true;
  }
  return false;
}

double SharedSurface(const Scene& part, const Scene& other, double size_m) {
  std::set<Cell> cells;
  for (const SceneTrack& track : other.tracks) {
    if (track.position) cells.insert(CellOf(*track.position, size_m));
  }
  int points = 0;
  int shared = 0;
  for (const SceneTrack& track : part.tracks) {
    if (!track.position) continue;
    ++points;
    shared += HasNeighbour(cells, CellOf(*track.position, size_m));
  }
  return points > 0 ? static_cast<double>(shared) / points : 0;
}

}  // namespace

PartPlace PlaceOfPart(const std::vector<PoseRecord>& records, const RecordErrors* errors,
                      const Scene& part, const Scene& other) {
  assert(records.size() == part.photos.size() && records.size() == other.photos.size());
  PartPlace place;
  const RecordSums sums = SumRecords(records, errors, part);
  if (sums.count == 0) return place;
  // A turn about each axis moves two coordinates of every place, and every gimbal sees it.
  double information = 0;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!part.photos[i].pose || !records[i].position) continue;
    information += 2.0 / 3 * (part.photos[i].pose->Center() - sums.middle).squaredNorm() /
                   (sums.variance.sum() / 3);
  }
  if (errors != nullptr && errors->sigma_attitude_rad > 0) {
    information += sums.gimbals / std::pow(errors->sigma_attitude_rad, 2);
  }
  if (!(information > 0)) return place;
  place.rotation_sigma_rad = std::sqrt(3 / information);
  Eigen::Vector3d variance = sums.variance / sums.count;
  if (!ShareAFlight(records, part, other)) variance += sums.stated;
  place.position_sigma_m = std::sqrt(variance.sum());
  const Sight sight = MiddleSight(part);
  place.surface_sigma_m =
      std::hypot(place.position_sigma_m, place.rotation_sigma_rad * sight.distance_m);
  place.surface_sigma_px = place.surface_sigma_m / sight.pixel_m;
  const double size_m = std::max(2 * place.surface_sigma_m, sight.spacing_m);
  place.shared_surface = SharedSurface(part, other, size_m);
  return place;
}

}  // namespace stucco
