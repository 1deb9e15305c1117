// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/occluders.h"
#include "survey/proxy.h"
#include "survey/survey_photo.h"

namespace stucco {

// All facets of a proxy, in the way of lines of sight.
class OcclusionScene {
 public:
  explicit OcclusionScene(const Proxy& proxy);

  // Whether any facet crosses the segment between the two world points. Thread-safe.
  bool Blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  Occluders occluders_;
};

// Points of a cloud and the ids of the photos that see each.
struct SightedPoints {
  std::vector<Eigen::Vector3d> positions;
  // Those of point i are in `views` from ends[i - 1] (0 for the first) to ends[i]. No ends: not
  // known of any point.
  std::vector<size_t> ends;
  std::vector<uint32_t> views;

  bool IsSeenBy(size_t point, PhotoId photo) const;  // true where it is not known
};

// The same points with views by other photos than those they come from: a photo sees a point where
// one of those that see it looks at it from about the same direction. What these show past the
// border of a wall is past it for that photo, too; where none of them stood it stays unknown to
// it, as unseen. Points of which nothing is known stay so.
SightedPoints SightedByOthers(SightedPoints points, std::span<const SurveyPhoto> of_points,
                              std::span<const SurveyPhoto> others);

// The cloud points nearest to one photo, splatted into a small raster over the photo's picture:
// index into the cloud, -1 where none.
struct NearestPoints {
  int width = 0;
  int height = 0;
  std::vector<int32_t> index;
  std::vector<uint8_t> seen;  // the photo itself sees that point
};

// The raster gets as fine as the points are dense, between 100 and `most_px` cells wide.
NearestPoints SplatNearest(const SurveyPhoto& photo, const SightedPoints& points, int most_px);

// The photos of a survey and what hides surfaces from them. `nearest` is empty or holds one raster
// per photo.
struct SightScene {
  std::span<const SurveyPhoto> photos;
  const OcclusionScene* occlusion = nullptr;
  std::span<const NearestPoints> nearest;
  std::span<const Eigen::Vector3d> points;  // the cloud that `nearest` points into
};

// What the cloud says about a place on a facet as one photo sees it.
enum class CloudView {
  kNoPoints,  // nothing is known: a smooth surface, or the sky
  kSurface,   // the facet, or not clear
  kInFront,   // something stands between the photo and the facet's plane
  kBeyond,    // the photo looks past the facet at things behind its plane
};

// Heights before a facet's plane between which points are the facet's, world units.
struct HeightBand {
  double low = 0;
  double high = 0;
};

// Looks at the photo's splats around `pixel`, where it sees the facet. Points above `band`, nearer
// to the facet than the photo, are in front; it takes two of the nine nearest splats, as one may be
// noise. Beyond means that all points in the twenty-five nearest are below the band, and that the
// photo itself sees three of them: through a wall that has few points (plain plaster, panes) those
// behind it shine, but it hides them from the photo.
CloudView AskCloud(const SightScene& scene, int photo, const Eigen::Vector2d& pixel,
                   const Facet& facet, const HeightBand& band);

}  // namespace stucco
