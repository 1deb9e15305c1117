// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/not_shown.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "proxy/facets/raster.h"
#include "survey/geometry2d.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

namespace bg = boost::geometry;
using Corner3 = bg::model::point<double, 3, bg::cs::cartesian>;
using Box3 = bg::model::box<Corner3>;

constexpr double kSameWay = 0.7;       // cosine of 45 degrees
constexpr double kOnFacet = 2;         // levels of detail
constexpr double kBesideBuilding = 6;  // likewise
constexpr double kWorthNaming = 4;     // smallest facets

Corner3 CornerOf(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

// A facet laid out in its own plane.
struct LaidOut {
  const Facet* facet;
  const Building* building;
  PlaneFrame frame;
  Polygon polygon;
  Eigen::AlignedBox3d box;

  // Inside, or within `reach` of its border.
  bool Covers(const Eigen::Vector3d& p, double reach) const {
    if (std::abs(facet->normal.dot(p) - facet->offset) > reach) return false;
    return Distance(polygon, frame.ToPlane(p)) <= reach;
  }
};

class ShownParts {
 public:
  ShownParts(const PlanarScene& scene, std::span<const Building> buildings) : scene_(scene) {
    for (const Building& building : buildings) {
      if (building.id == "G0") continue;
      for (const Facet& facet : building.facets) facets_.push_back(LayOut(facet, building));
    }
    std::vector<std::pair<Box3, size_t>> entries;
    for (size_t f = 0; f < facets_.size(); ++f) {
      const Eigen::AlignedBox3d& box = facets_[f].box;
      entries.emplace_back(Box3(CornerOf(box.min()), CornerOf(box.max())), f);
    }
    boxes_ = Index(entries);
  }

  std::vector<NotShown> MissingOf(const Plane& plane) const {
    const Tolerances& tolerances = scene_.tolerances;
    std::vector<NotShown> missing;
    if (plane.area < kWorthNaming * tolerances.min_area || IsOfLeaves(scene_, plane)) {
      return missing;
    }
    Plane bare = plane;
    std::erase_if(bare.points, [&](int i) { return IsShown(plane, i); });
    if (bare.points.size() < 3) return missing;
    const PlaneFrame frame = FrameOf(bare, scene_.up, scene_.main_direction,
                                     scene_.samples.positions[bare.points.front()]);
    const double cell = std::max(2 * tolerances.spacing, tolerances.level_of_detail / 2);
    const double width = std::sqrt(tolerances.min_area);
    const PlaneRaster raster = RasteriseHits(scene_.samples, bare, frame, cell, width);
    cv::Mat seen(raster.height, raster.width, CV_8U);
    for (size_t i = 0; i < raster.hits.size(); ++i) seen.data[i] = raster.IsSeen(i) ? 1 : 0;
    cv::morphologyEx(seen, seen, cv::MORPH_CLOSE, cv::Mat());
    const int side = std::max(1, static_cast<int>(std::lround(width / raster.cell)));
    cv::morphologyEx(seen, seen, cv::MORPH_OPEN,
                     cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
    cv::Mat pieces, figures, middles;
    const int count = cv::connectedComponentsWithStats(seen, pieces, figures, middles, 8);
    for (int piece = 1; piece < count; ++piece) {
      NotShown found{"", {}, 0, plane.role};
      found.area = figures.at<int>(piece, cv::CC_STAT_AREA) * raster.cell * raster.cell;
      if (found.area < kWorthNaming * tolerances.min_area) continue;
      const Eigen::Vector2d at(middles.at<double>(piece, 0) + 0.5,
                               middles.at<double>(piece, 1) + 0.5);
      found.middle = frame.ToWorld(raster.origin + raster.cell * at);
      // The frame passes through the first point, the plane through all.
      found.middle -= plane.DistanceTo(found.middle) * plane.normal;
      const Building* building = BuildingBeside(found.middle, std::sqrt(found.area));
      if (building == nullptr || IsGround(plane, found.middle, *building)) continue;
      found.building = building->id;
      missing.push_back(std::move(found));
    }
    return missing;
  }

 private:
  using Index = bg::index::rtree<std::pair<Box3, size_t>, bg::index::rstar<16>>;

  LaidOut LayOut(const Facet& facet, const Building& building) const {
    Plane plane;
    plane.normal = facet.normal;
    plane.offset = facet.offset;
    LaidOut out{&facet, &building, {}, {}, {}};
    for (const Eigen::Vector3d& p : facet.outer) out.box.extend(p);
    out.frame = FrameOf(plane, scene_.up, scene_.main_direction, facet.outer.front());
    const auto add = [&](const std::vector<Eigen::Vector3d>& ring) {
      Ring& flat = out.polygon.rings.emplace_back();
      for (const Eigen::Vector3d& p : ring) flat.push_back(out.frame.ToPlane(p));
    };
    add(facet.outer);
    for (const auto& hole : facet.holes) add(hole);
    return out;
  }

  std::vector<std::pair<Box3, size_t>> Near(const Eigen::Vector3d& p, double reach) const {
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
    std::vector<std::pair<Box3, size_t>> near;
    boxes_.query(bg::index::intersects(Box3(CornerOf(p - margin), CornerOf(p + margin))),
                 std::back_inserter(near));
    return near;
  }

  bool IsShown(const Plane& plane, int sample) const {
    const Eigen::Vector3d& p = scene_.samples.positions[sample];
    const double reach = kOnFacet * scene_.tolerances.level_of_detail;
    return std::ranges::any_of(Near(p, reach), [&](const auto& entry) {
      const LaidOut& facet = facets_[entry.second];
      return facet.facet->normal.dot(plane.normal) > kSameWay && facet.Covers(p, reach);
    });
  }

  // By boxes: whose facets come within reach of a piece of this size.
  const Building* BuildingBeside(const Eigen::Vector3d& middle, double size) const {
    const double reach = kBesideBuilding * scene_.tolerances.level_of_detail + size / 2;
    const auto near = Near(middle, reach);
    if (near.empty()) return nullptr;
    const auto nearest = std::ranges::min_element(near, {}, [&](const auto& entry) {
      return std::pair(facets_[entry.second].box.squaredExteriorDistance(middle), entry.second);
    });
    return facets_[nearest->second].building;
  }

  // What is level and at the foot of the building.
  bool IsGround(const Plane& plane, const Eigen::Vector3d& middle, const Building& building) const {
    constexpr double kLevel = 0.9;
    if (plane.normal.dot(scene_.up) < kLevel) return false;
    double foot = std::numeric_limits<double>::max();
    for (const Facet& facet : building.facets) {
      for (const Eigen::Vector3d& p : facet.outer) foot = std::min(foot, scene_.up.dot(p));
    }
    return scene_.up.dot(middle) < foot + kBesideBuilding * scene_.tolerances.level_of_detail;
  }

  const PlanarScene& scene_;
  std::vector<LaidOut> facets_;
  Index boxes_;
};

}  // namespace

std::vector<NotShown> FindNotShown(const PlanarScene& scene, std::span<const Plane> planes,
                                   std::span<const Building> buildings, int threads) {
  const ShownParts shown(scene, buildings);
  std::vector<std::vector<NotShown>> missing(planes.size());
  ParallelFor(planes.size(), threads, [&](size_t p) { missing[p] = shown.MissingOf(planes[p]); });
  std::vector<NotShown> all;
  for (auto& of_plane : missing) std::ranges::move(of_plane, std::back_inserter(all));
  std::ranges::stable_sort(all, std::greater(), &NotShown::area);
  return all;
}

}  // namespace stucco
