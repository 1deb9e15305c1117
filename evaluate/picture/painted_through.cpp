// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/painted_through.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "evaluate/geometry/moved.h"
#include "evaluate/geometry/seen.h"
#include "evaluate/picture/facade_picture.h"
#include "survey/image.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;
using simulate::FlownPhoto;

constexpr double kSpacing_m = 0.1;
// What a photo shows so much before a place is something else: trees and cars are farther off.
constexpr double kBefore_m = 0.1;

enum class Shown { kNotAtAll, kFreely, kThroughOther, kThroughOwn };

struct Place {
  Vector3d position;
  Vector3d normal;
};

Shown WhatShows(const FlownPhoto& photo, const Place& place, const TextureComparison& comparison,
                const std::vector<bool>& not_of_building) {
  if (!IsInPhoto(photo, place.position, place.normal)) return Shown::kNotAtAll;
  const Vector3d centre = photo.cam_from_world.Center();
  const Vector3d from_centre = place.position - centre;
  const auto hit = comparison.scene.Cast(centre, from_centre);
  if (!hit || hit->distance > from_centre.norm() - kBefore_m) return Shown::kFreely;
  return not_of_building[hit->element] ? Shown::kThroughOther : Shown::kThroughOwn;
}

// The texels in the middle of spots of an odd number of texels, and the plane of the spots.
struct Spots {
  int texels = 1;  // along a side
  simulate::PicturePlane plane;
};

Spots SpotsOn(const simulate::PicturePlane& plane) {
  Spots spots{1, plane};
  spots.texels = 2 * static_cast<int>(kSpacing_m / plane.metres_per_texel / 2) + 1;
  spots.plane.metres_per_texel *= spots.texels;
  spots.plane.width_px = plane.width_px / spots.texels;
  spots.plane.height_px = plane.height_px / spots.texels;
  return spots;
}

std::vector<const FlownPhoto*> Painters(const TexturedFacet& texture,
                                        const std::vector<const FlownPhoto*>& photos) {
  std::vector<const FlownPhoto*> painters;
  for (const std::string& path : texture.photos) {
    const auto found = std::ranges::find(photos, path, &FlownPhoto::path);
    painters.push_back(found != photos.end() ? *found : nullptr);
  }
  return painters;
}

bool AnyShowsFreely(const std::vector<const FlownPhoto*>& photos, const Place& place,
                    const TextureComparison& comparison, const std::vector<bool>& not_of_building) {
  return std::ranges::any_of(photos, [&](const FlownPhoto* photo) {
    return WhatShows(*photo, place, comparison, not_of_building) == Shown::kFreely;
  });
}

}  // namespace

OccludedArea PaintedThrough(const TextureComparison& comparison, const PaintedWall& wall) {
  OccludedArea area;
  if (wall.texture.label_image.empty()) return area;
  FacadePicture picture =
      ReadFacadePicture(wall.texture, comparison.texture_folder, comparison.truth_from_world);
  KeepInside(wall.truth, picture);
  KeepInside(Moved(wall.result, comparison.truth_from_world), picture);
  const Image labels = ReadImage(comparison.texture_folder / wall.texture.label_image);
  const auto photos = DeliveredPhotos(comparison.flight);
  const auto painters = Painters(wall.texture, photos);
  const auto [texels, plane] = SpotsOn(picture.plane);
  if (plane.width_px == 0 || plane.height_px == 0) return area;
  const std::vector<float> heights =
      comparison.scene.Heights(plane, {.threads = 1, .left_out = wall.not_of_building});
  const Vector3d towards_us = plane.v_axis.cross(plane.u_axis).normalized();
  const double spot_m2 = plane.metres_per_texel * plane.metres_per_texel;
  for (size_t spot = 0; spot < heights.size(); ++spot) {
    const size_t column = spot % plane.width_px;
    const size_t row = spot / plane.width_px;
    const size_t texel =
        (row * texels + texels / 2) * picture.plane.width_px + column * texels + texels / 2;
    const size_t label = labels.data[texel];
    if (picture.known[texel] == 0 || std::isnan(heights[spot]) || label > painters.size()) continue;
    const FlownPhoto* painter = painters[label - 1];
    if (painter == nullptr) continue;
    const Place place{
        plane.origin +
            plane.metres_per_texel * ((static_cast<double>(column) + 0.5) * plane.u_axis +
                                      (static_cast<double>(row) + 0.5) * plane.v_axis) +
            heights[spot] * towards_us,
        wall.truth.normal};
    const Shown shown = WhatShows(*painter, place, comparison, wall.not_of_building);
    if (shown != Shown::kFreely &&
        !AnyShowsFreely(photos, place, comparison, wall.not_of_building)) {
      continue;
    }
    area.free_m2 += spot_m2;
    if (shown == Shown::kThroughOther) area.through_m2 += spot_m2;
  }
  return area;
}

}  // namespace stucco::evaluate
