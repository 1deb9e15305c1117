// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/ground_control.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "simulate/random.h"

namespace stucco::simulate {
namespace {

constexpr uint64_t kStream = 0x6763705f6c697374u;  // nothing else draws from it
constexpr int kTriedPerPoint = 40;
constexpr size_t kLeastPhotos = 3;
constexpr int kCheckEvery = 4;
constexpr double kMarkNoise_px = 0.5;
// Points at the edge of a picture are marked by nobody.
constexpr double kMargin = 0.03;
// What hides a point stands at least this far before it.
constexpr double kVisible_m = 0.02;

bool IsInSurvey(const FlownPhoto& photo) {
  return !photo.held_out && !photo.lost && photo.duplicate_of.empty();
}

bool IsWellInside(const Eigen::Vector2d& pixel, const Camera& camera) {
  const double x = kMargin * camera.width_px;
  const double y = kMargin * camera.height_px;
  return pixel.x() > x && pixel.x() < camera.width_px - x && pixel.y() > y &&
         pixel.y() < camera.height_px - y;
}

// Where a photo shows a point; nothing where it does not.
std::optional<Eigen::Vector2d> PixelOf(const FlownPhoto& photo, const Eigen::Vector3d& point,
                                       const CastRay& cast) {
  auto pixel = photo.camera.Project(photo.cam_from_world * point);
  if (!pixel || !IsWellInside(*pixel, photo.camera)) return std::nullopt;
  const Eigen::Vector3d center = photo.cam_from_world.Center();
  const auto hit = cast(center, (point - center).normalized());
  if (!hit || hit->distance < (point - center).norm() - kVisible_m) return std::nullopt;
  return pixel;
}

SurveyedPoint MarkPoint(const Flight& flight, const Eigen::Vector3d& point, const CastRay& cast,
                        Random& random) {
  SurveyedPoint surveyed;
  const Eigen::Vector3d geodetic = GeodeticFromEnu(flight.georef, point);
  surveyed.coordinates = {geodetic.y(), geodetic.x(), geodetic.z()};
  for (const FlownPhoto& photo : flight.photos) {
    if (!IsInSurvey(photo)) continue;
    const auto pixel = PixelOf(photo, point, cast);
    if (!pixel) continue;
    const double x = pixel->x() + kMarkNoise_px * random.Normal();
    surveyed.markings.push_back({photo.path, {x, pixel->y() + kMarkNoise_px * random.Normal()}, 0});
  }
  return surveyed;
}

// What a random pixel of a random photo shows.
std::optional<Eigen::Vector3d> AnyPoint(const std::vector<const FlownPhoto*>& photos,
                                        const CastRay& cast, Random& random) {
  const FlownPhoto& photo = *photos[random.Index(static_cast<int>(photos.size()))];
  const double column = random.Uniform(0.1, 0.9) * photo.camera.width_px;
  const auto ray =
      photo.camera.Unproject({column, random.Uniform(0.1, 0.9) * photo.camera.height_px});
  if (!ray) return std::nullopt;
  const auto hit =
      cast(photo.cam_from_world.Center(),
           (photo.cam_from_world.rotation.conjugate() * ray->homogeneous()).normalized());
  if (!hit) return std::nullopt;
  return hit->point;
}

struct CandidatePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double distance = std::numeric_limits<double>::infinity();  // to the nearest one chosen
  size_t num_photos = 0;
};

std::vector<CandidatePoint> FindCandidates(const Flight& flight, const CastRay& cast, int tries,
                                           Random& random) {
  std::vector<const FlownPhoto*> photos;
  for (const FlownPhoto& photo : flight.photos) {
    if (IsInSurvey(photo)) photos.push_back(&photo);
  }
  std::vector<CandidatePoint> candidates;
  for (int i = 0; i < tries && !photos.empty(); ++i) {
    const auto point = AnyPoint(photos, cast, random);
    if (!point) continue;
    CandidatePoint candidate{*point};
    for (const FlownPhoto* photo : photos) {
      candidate.num_photos += PixelOf(*photo, *point, cast) ? 1 : 0;
    }
    if (candidate.num_photos >= kLeastPhotos) candidates.push_back(candidate);
  }
  return candidates;
}

}  // namespace

GroundControlList SurveyPoints(const Flight& flight, const CastRay& cast, int count) {
  Random random(flight.seed, kStream);
  std::vector<CandidatePoint> candidates =
      FindCandidates(flight, cast, kTriedPerPoint * count, random);
  GroundControlList list;
  list.crs = "EPSG:4326";
  // The next point is the one farthest from those there are; the first is seen by most photos.
  while (!candidates.empty() && static_cast<int>(list.points.size()) < count) {
    const auto best = std::ranges::max_element(candidates, [](const auto& a, const auto& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.num_photos < b.num_photos;
    });
    if (!(best->distance > 0)) break;
    const Eigen::Vector3d position = best->position;
    for (CandidatePoint& candidate : candidates) {
      candidate.distance = std::min(candidate.distance, (candidate.position - position).norm());
    }
    SurveyedPoint point = MarkPoint(flight, position, cast, random);
    const size_t number = list.points.size() + 1;
    point.name = fmt::format("G{}", number);
    point.role = number % kCheckEvery == 0 ? PointRole::kCheck : PointRole::kControl;
    list.points.push_back(std::move(point));
  }
  return list;
}

}  // namespace stucco::simulate
