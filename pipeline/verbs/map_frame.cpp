// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/map_frame.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "survey/coordinate_system.h"
#include "survey/error.h"

namespace stucco {
namespace {

constexpr char kRemedy[] = "export it in WGS 84 (EPSG:4326), in UTM, or in local east, north, up";

// A camera and about a metre to each side of it, in the coordinates of the map.
constexpr int kPlacesOfCamera = 5;
constexpr double kStep_m = 1;
constexpr double kStep_deg = 1e-5;

std::vector<Eigen::Vector3d> CentresOf(const Reconstruction& model) {
  std::vector<Eigen::Vector3d> centres;
  for (const auto& [id, photo] : model.photos) centres.push_back(photo.cam_from_world.Center());
  return centres;
}

Georef MiddleOf(const std::vector<Eigen::Vector3d>& centres, const std::vector<Geodetic>& places,
                const std::string& file) {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.source = "file";
  const auto count = static_cast<double>(centres.size());
  for (size_t i = 0; i < centres.size(); ++i) {
    // Also metres that were taken for degrees.
    if (!(std::abs(places[i].latitude_deg) <= 90)) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: a camera at ({:.0f}, {:.0f}) has no place in its coordinate "
                              "system",
                              file, centres[i].x(), centres[i].y()),
                  kRemedy);
    }
    georef.origin_latitude_deg += places[i].latitude_deg / count;
    georef.origin_longitude_deg += places[i].longitude_deg / count;
    georef.origin_height_m += centres[i].z() / count;
  }
  return georef;
}

Eigen::Vector3d EnuOf(const Georef& georef, const Geodetic& place, double height_m) {
  return EnuFromGeodetic(georef, place.latitude_deg, place.longitude_deg, height_m);
}

// The map's directions at a camera, as columns. `places` are its own, east, west, north, south.
Eigen::Matrix3d DirectionsAt(const Georef& georef, const Geodetic* places, double height_m) {
  Eigen::Matrix3d axes;
  axes.col(0) =
      (EnuOf(georef, places[1], height_m) - EnuOf(georef, places[2], height_m)).normalized();
  axes.col(1) =
      (EnuOf(georef, places[3], height_m) - EnuOf(georef, places[4], height_m)).normalized();
  axes.col(2) = (EnuOf(georef, places[0], height_m + 1) - EnuOf(georef, places[0], height_m - 1))
                    .normalized();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

void MoveCameras(const std::string& crs, const std::string& file, const Georef& georef, double step,
                 Reconstruction& model) {
  std::vector<Eigen::Vector2d> around;
  for (const Eigen::Vector3d& centre : CentresOf(model)) {
    const Eigen::Vector2d at = centre.head<2>();
    const Eigen::Vector2d east(step, 0);
    const Eigen::Vector2d north(0, step);
    around.insert(around.end(), {at, at + east, at - east, at + north, at - north});
  }
  const std::vector<Geodetic> places = GeodeticFromCrs(crs, around, file);
  const Geodetic* next = places.data();
  for (auto& [id, photo] : model.photos) {
    const double height_m = photo.cam_from_world.Center().z();
    const Eigen::Matrix3d enu_from_map = DirectionsAt(georef, next, height_m);
    Pose& pose = photo.cam_from_world;
    pose.rotation = (pose.rotation * Eigen::Quaterniond(Eigen::Matrix3d(enu_from_map.transpose())))
                        .normalized();
    pose.translation = -(pose.rotation * EnuOf(georef, *next, height_m));
    next += kPlacesOfCamera;
  }
}

void MovePoints(const std::string& crs, const std::string& file, const Georef& georef,
                Reconstruction& model) {
  std::vector<Eigen::Vector2d> around;
  for (const auto& [id, point] : model.points) around.emplace_back(point.position.head<2>());
  const std::vector<Geodetic> places = GeodeticFromCrs(crs, around, file);
  auto place = places.begin();
  for (auto& [id, point] : model.points) {
    point.position = EnuOf(georef, *place++, point.position.z());
    if (point.position.allFinite()) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: point {} has no place in its coordinate system", file, id.value),
                kRemedy);
  }
}

}  // namespace

Georef MoveFromMap(const std::string& crs, const std::string& file, Reconstruction& model) {
  const std::vector<Eigen::Vector3d> centres = CentresOf(model);
  std::vector<Eigen::Vector2d> around;
  around.reserve(centres.size());
  for (const Eigen::Vector3d& centre : centres) around.emplace_back(centre.head<2>());
  const std::vector<Geodetic> places = GeodeticFromCrs(crs, around, file);
  Georef georef = MiddleOf(centres, places, file);
  MoveCameras(crs, file, georef, IsCrsGeographic(crs) ? kStep_deg : kStep_m, model);
  MovePoints(crs, file, georef, model);
  return georef;
}

void MovePointsFromMap(const std::string& crs, const std::string& file, const Georef& georef,
                       std::span<Eigen::Vector3d> points) {
  const CrsUnits units = UnitsOfCrs(crs);
  const double metres_per_unit = units.vertical_m.value_or(units.horizontal_m);
  std::vector<Eigen::Vector2d> in_map;
  in_map.reserve(points.size());
  for (const Eigen::Vector3d& p : points) in_map.emplace_back(p.head<2>());
  const std::vector<Geodetic> places = GeodeticFromCrs(crs, in_map, file);
  const bool degrees = IsCrsGeographic(crs);
  for (size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector3d& p = points[i];
    p = EnuOf(georef, places[i], p.z() * metres_per_unit);
    // Metres that were taken for degrees become some place, too.
    if (p.allFinite() && std::abs(places[i].latitude_deg) <= 90 &&
        (!degrees || std::abs(in_map[i].y()) <= 90)) {
      continue;
    }
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: point {} at ({:.0f}, {:.0f}) has no place in {}", file, i,
                            in_map[i].x(), in_map[i].y(), crs),
                "check --crs");
  }
}

}  // namespace stucco
