// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace stucco {
namespace {

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  bool Contains(const Eigen::Vector3d& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
};

// The box of the middle 98 % of the points along each axis, grown by three times its size: points
// beyond it are strays of the dense matching, not part of the scene.
Box BoxOfScene(const std::vector<Eigen::Vector3d>& points) {
  constexpr size_t kProbes = 200000;
  const size_t stride = std::max<size_t>(1, points.size() / kProbes);
  std::vector<double> values;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (size_t i = 0; i < points.size(); i += stride) {
      if (points[i].allFinite()) values.push_back(points[i][axis]);
    }
    if (values.empty()) return box;
    const size_t low = values.size() / 100;
    const size_t high = values.size() - 1 - low;
    std::nth_element(values.begin(), values.begin() + low, values.end());
    box.min[axis] = values[low];
    std::nth_element(values.begin(), values.begin() + high, values.end());
    box.max[axis] = values[high];
  }
  const double margin = 3 * (box.max - box.min).maxCoeff() + 1e-9;
  box.min.array() -= margin;
  box.max.array() += margin;
  return box;
}

constexpr int kBitsPerAxis = 21;

uint64_t CellOf(const Eigen::Vector3d& point, const Box& box, double cell) {
  uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<uint64_t>((point[axis] - box.min[axis]) / cell);
    key = key << kBitsPerAxis | index;
  }
  return key;
}

size_t CountCells(const std::vector<Eigen::Vector3d>& points, const std::vector<uint32_t>& kept,
                  const Box& box, double cell) {
  std::vector<uint64_t> keys(kept.size());
  for (size_t i = 0; i < kept.size(); ++i) keys[i] = CellOf(points[kept[i]], box, cell);
  std::sort(keys.begin(), keys.end());
  return std::unique(keys.begin(), keys.end()) - keys.begin();
}

// The cell size that leaves about nine tenths of `max_points`; 0 when no thinning is needed.
double ChooseCell(const std::vector<Eigen::Vector3d>& points, const std::vector<uint32_t>& kept,
                  const Box& box, int max_points, double min_cell) {
  const double largest = (box.max - box.min).maxCoeff();
  const double finest = largest / ((1 << kBitsPerAxis) - 2);
  if (kept.size() <= static_cast<size_t>(max_points)) return min_cell > finest ? min_cell : 0;
  // Points lie on surfaces: the number of cells falls with the square of their side.
  double cell = std::max({min_cell, finest, largest / 7 / std::sqrt(double(max_points))});
  for (int round = 0; round < 12; ++round) {
    const size_t count = CountCells(points, kept, box, cell);
    if (count <= static_cast<size_t>(max_points) &&
        (count > 0.7 * max_points || cell <= std::max(min_cell, finest) || round > 6)) {
      break;
    }
    cell *= std::max(0.3, std::sqrt(count / (0.88 * max_points)));
    cell = std::max({cell, min_cell, finest});
  }
  return cell;
}

// One sample out of the points kept[first] ... kept[last - 1] of a cell.
void AddSample(const PointCloud& cloud, const Stations& stations,
               const std::vector<std::pair<uint64_t, uint32_t>>& order, size_t first, size_t last,
               Samples& samples) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int station = -1;
  for (size_t i = first; i < last; ++i) {
    const uint32_t point = order[i].second;
    position += cloud.positions[point];
    if (!cloud.normals.empty() && cloud.normals[point].allFinite()) {
      normal += cloud.normals[point].cast<double>();
    }
    if (station < 0 && !cloud.views.empty() && !cloud.views[point].empty()) {
      const auto& views = cloud.views[point];
      const auto found = stations.index_of_photo.find(views[point % views.size()]);
      if (found != stations.index_of_photo.end()) station = found->second;
    }
  }
  const double length = normal.norm();
  samples.positions.push_back(position / static_cast<double>(last - first));
  samples.normals.push_back(length > 1e-6 ? Eigen::Vector3d(normal / length)
                                          : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  samples.weights.push_back(static_cast<int>(last - first));
  samples.stations.push_back(station);
}

}  // namespace

Samples ThinCloud(const PointCloud& cloud, const Stations& stations, int max_points,
                  double min_cell) {
  Samples samples;
  const Box box = BoxOfScene(cloud.positions);
  std::vector<uint32_t> kept;
  kept.reserve(cloud.size());
  for (size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    if (p.allFinite() && box.Contains(p)) kept.push_back(static_cast<uint32_t>(i));
  }
  samples.dropped = cloud.size() - kept.size();
  samples.cell = ChooseCell(cloud.positions, kept, box, max_points, min_cell);
  std::vector<std::pair<uint64_t, uint32_t>> order(kept.size());
  for (size_t i = 0; i < kept.size(); ++i) {
    const uint64_t key =
        samples.cell > 0 ? CellOf(cloud.positions[kept[i]], box, samples.cell) : uint64_t{i};
    order[i] = {key, kept[i]};
  }
  kept = {};
  std::sort(order.begin(), order.end());
  for (size_t first = 0; first < order.size();) {
    size_t last = first + 1;
    while (last < order.size() && order[last].first == order[first].first) ++last;
    AddSample(cloud, stations, order, first, last, samples);
    first = last;
  }
  return samples;
}

}  // namespace stucco
