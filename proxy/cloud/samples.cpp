// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace stucco {
namespace {

// The box of the middle 98 % of the points along each axis, grown by three times its size: points
// beyond it are strays of the dense matching, not part of the scene.
Eigen::AlignedBox3d BoxOfScene(const PointStream& stream) {
  constexpr size_t kProbes = 200000;
  const size_t stride = std::max<size_t>(1, stream.count / kProbes);
  std::array<std::vector<double>, 3> values;
  size_t i = 0;
  stream.for_each([&](const CloudPoint& point) {
    if (i++ % stride != 0 || !point.position.allFinite()) return;
    for (int axis = 0; axis < 3; ++axis) values[axis].push_back(point.position[axis]);
  });
  if (values[0].empty()) {
    return {Eigen::Vector3d(Eigen::Vector3d::Zero()), Eigen::Vector3d(Eigen::Vector3d::Zero())};
  }
  Eigen::AlignedBox3d box;
  const auto count = static_cast<std::ptrdiff_t>(values[0].size());
  const std::ptrdiff_t low = count / 100;
  for (int axis = 0; axis < 3; ++axis) {
    const auto begin = values[axis].begin();
    std::nth_element(begin, begin + low, values[axis].end());
    box.min()[axis] = begin[low];
    std::nth_element(begin, begin + (count - 1 - low), values[axis].end());
    box.max()[axis] = begin[count - 1 - low];
  }
  const double margin = 3 * box.sizes().maxCoeff() + 1e-9;
  box.min().array() -= margin;
  box.max().array() += margin;
  return box;
}

constexpr int kBitsPerAxis = 21;

uint64_t CellOf(const Eigen::Vector3d& point, const Eigen::AlignedBox3d& box, double cell) {
  uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<uint64_t>((point[axis] - box.min()[axis]) / cell);
    key = key << kBitsPerAxis | index;
  }
  return key;
}

// Keys of neighbouring cells differ in few bits, of which the standard hash makes long chains
// (the finaliser of MurmurHash3, Appleby 2011).
struct MixedHash {
  size_t operator()(uint64_t key) const {
    key = (key ^ key >> 33) * 0xff51afd7ed558ccd;
    key = (key ^ key >> 33) * 0xc4ceb9fe1a85ec53;
    return key ^ key >> 33;
  }
};

// The key of the cell of twice the size around a cell.
uint64_t Coarser(uint64_t key) {
  constexpr uint64_t kAxis = (uint64_t{1} << kBitsPerAxis) - 1;
  uint64_t coarse = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int shift = axis * kBitsPerAxis;
    coarse |= ((key >> shift & kAxis) >> 1) << shift;
  }
  return coarse;
}

struct CellCount {
  double cell = 0;
  size_t cells = 0;
  size_t kept = 0;  // points inside the box
};

// Counts the cells with points; doubles their size whenever there are more than `most`.
CellCount CountCells(const PointStream& stream, const Eigen::AlignedBox3d& box, double cell,
                     size_t most) {
  CellCount result{.cell = cell};
  std::unordered_set<uint64_t, MixedHash> keys;
  stream.for_each([&](const CloudPoint& point) {
    if (!box.contains(point.position)) return;
    ++result.kept;
    keys.insert(CellOf(point.position, box, result.cell));
    if (keys.size() <= most) return;
    std::unordered_set<uint64_t, MixedHash> coarser;
    for (const uint64_t key : keys) coarser.insert(Coarser(key));
    keys.swap(coarser);
    result.cell *= 2;
  });
  result.cells = keys.size();
  return result;
}

// Points that fall on each cell of a surface, when points at random occupy this share of as many
// cells as there are points: solves (1 - exp(-x)) / x = share. Few for each means hardly fewer
// cells than points, whatever their size.
double PointsPerCell(double share) {
  double low = 0;
  double high = 1 / share;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((1 - std::exp(-middle)) / middle > share ? low : high) = middle;
  }
  return high;
}

// The cell size that leaves about nine tenths of `max_points`; 0 when no thinning is needed.
double ChooseCell(const PointStream& stream, const Eigen::AlignedBox3d& box, int max_points,
                  double min_cell) {
  const double largest = box.sizes().maxCoeff();
  const double finest = largest / ((1 << kBitsPerAxis) - 2);
  const double least = std::max(min_cell, finest);
  const double guess = std::max(least, largest / 28 / std::sqrt(double(max_points)));
  const auto most = static_cast<size_t>(max_points);
  const CellCount count = CountCells(stream, box, guess, 2 * most);
  if (count.kept <= most) return min_cell > finest ? min_cell : 0;
  if (count.cells <= most && count.cell <= least) return least;
  // Points lie on surfaces: those that fall on a cell grow with the square of its side.
  const auto points = static_cast<double>(count.kept);
  const double now = PointsPerCell(static_cast<double>(count.cells) / points);
  const double wanted = PointsPerCell(0.88 * max_points / points);
  return std::max(least, count.cell * std::sqrt(wanted / now));
}

// Running sums of the points of one cell.
struct CellSum {
  uint64_t key = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int points = 0;
  int camera = -1;
};

// Places of photos in their list, by the ids that the cloud has for them.
using PlaceOfPhoto = std::map<uint32_t, int>;

void AddPoint(const CloudPoint& point, size_t number, const PlaceOfPhoto& places, CellSum& sum) {
  sum.position += point.position;
  if (point.normal.allFinite()) sum.normal += point.normal.cast<double>();
  ++sum.points;
  if (sum.camera >= 0 || point.views.empty()) return;
  // Not always the first: the photos with low numbers would see everything.
  const auto found = places.find(point.views[number % point.views.size()]);
  if (found != places.end()) sum.camera = found->second;
}

struct CellSums {
  std::vector<CellSum> sums;  // by key
  size_t dropped = 0;
  bool too_many = false;
};

// Cell 0: every point is a cell of its own.
CellSums SumCells(const PointStream& stream, const PlaceOfPhoto& places,
                  const Eigen::AlignedBox3d& box, double cell, size_t most) {
  CellSums result;
  std::unordered_map<uint64_t, size_t, MixedHash> place;
  size_t number = 0;
  stream.for_each([&](const CloudPoint& point) {
    const size_t i = number++;
    if (result.too_many) return;
    if (!point.position.allFinite() || !box.contains(point.position)) {
      ++result.dropped;
      return;
    }
    const uint64_t key = cell > 0 ? CellOf(point.position, box, cell) : uint64_t{i};
    const auto [entry, added] = place.try_emplace(key, result.sums.size());
    if (added && result.sums.size() == most) {
      place.erase(entry);
      result.too_many = true;
      return;
    }
    if (added) result.sums.emplace_back().key = key;
    AddPoint(point, i, places, result.sums[entry->second]);
  });
  std::ranges::sort(result.sums, {}, &CellSum::key);
  return result;
}

}  // namespace

PointStream StreamOf(const PointCloud& cloud) {
  const auto for_some = [&cloud](const PlyPlace& from, uint64_t count, const PointVisit& visit) {
    CloudPoint point;
    PlyPlace to = from;
    for (; to.point < cloud.size() && to.point - from.point < count; ++to.point) {
      point.position = cloud.positions[to.point];
      if (!cloud.normals.empty()) point.normal = cloud.normals[to.point];
      if (!cloud.views.empty()) point.views = cloud.views[to.point];
      visit(point);
    }
    return to;
  };
  const auto for_each = [for_some, &cloud](const PointVisit& visit) {
    for_some({}, cloud.size(), visit);
  };
  return {cloud.size(), for_each, for_some};
}

PointStream StreamOf(const std::filesystem::path& ply) {
  return {ReadPlyLayout(ply).points, [ply](const PointVisit& visit) { ForEachPoint(ply, visit); },
          [ply](const PlyPlace& from, uint64_t count, const PointVisit& visit) {
            return ForSomePoints(ply, from, count, visit);
          }};
}

Samples ThinCloud(const PointStream& stream, std::span<const SurveyPhoto> photos, int max_points,
                  double min_cell) {
  const Eigen::AlignedBox3d box = BoxOfScene(stream);
  return ThinInside(box, stream, photos, max_points, ChooseCell(stream, box, max_points, min_cell));
}

Samples ThinInside(const Eigen::AlignedBox3d& box, const PointStream& stream,
                   std::span<const SurveyPhoto> photos, int max_points, double cell) {
  constexpr double kMostLarger = 1.5;  // 2.25 times fewer cells: what is left is half of the limit
  double larger = 1.08;                // about 15 % fewer cells
  Samples samples;
  PlaceOfPhoto places;
  for (const SurveyPhoto& photo : photos) {
    places[photo.id.value] = static_cast<int>(samples.camera_centers.size());
    samples.camera_centers.push_back(photo.cam_from_world.Center());
  }
  const auto most = static_cast<size_t>(max_points);
  samples.cell = cell;
  CellSums cells = SumCells(stream, places, box, samples.cell, most);
  while (cells.too_many) {
    samples.cell *= larger;
    larger = std::min(larger * larger, kMostLarger);  // each try reads all points
    cells = SumCells(stream, places, box, samples.cell, most);
  }
  samples.dropped = cells.dropped;
  for (const CellSum& sum : cells.sums) {
    const double length = sum.normal.norm();
    samples.positions.push_back(sum.position / sum.points);
    samples.normals.push_back(length > 1e-6 ? Eigen::Vector3d(sum.normal / length)
                                            : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    samples.weights.push_back(sum.points);
    samples.cameras.push_back(sum.camera);
  }
  return samples;
}

}  // namespace stucco
