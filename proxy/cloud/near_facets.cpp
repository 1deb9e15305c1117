// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/near_facets.h"

#include <Eigen/Geometry>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <utility>
#include <vector>

namespace stucco {
namespace {

namespace bg = boost::geometry;
using Place = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Place>;
using Entry = std::pair<Box, size_t>;

Place PlaceOf(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Entry EntryOf(const Facet& facet, double reach, size_t index) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : facet.outer) box.extend(p);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  return {{PlaceOf(box.min() - margin), PlaceOf(box.max() + margin)}, index};
}

}  // namespace

void ForEachPointNear(const PointStream& cloud, std::span<const Facet* const> facets, double reach,
                      size_t most_points,
                      const std::function<void(size_t, const CloudPoint&)>& visit) {
  std::vector<Entry> entries;
  entries.reserve(facets.size());
  for (size_t i = 0; i < facets.size(); ++i) entries.push_back(EntryOf(*facets[i], reach, i));
  const bg::index::rtree<Entry, bg::index::rstar<16>> boxes(entries);
  const size_t step = cloud.count / most_points + 1;
  size_t number = 0;
  std::vector<Entry> near;
  cloud.for_each([&](const CloudPoint& point) {
    if (number++ % step != 0) return;
    near.clear();
    const Place place = PlaceOf(point.position);
    boxes.query(bg::index::intersects(Box(place, place)), std::back_inserter(near));
    for (const Entry& entry : near) visit(entry.second, point);
  });
}

}  // namespace stucco
