// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/terrain/ground_heights.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "proxy/map/outlines.h"

namespace stucco {
namespace {

constexpr double kDetailsPerCell = 3;
constexpr double kMostGroundCells = 2e6;
constexpr double kCosOfUp = 0.8;

// A plane z = z0 + slope . (p - at) through cells, weighted by how near they are.
struct LocalPlane {
  double z0 = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  int cells = 0;
};

// The weak preference for level ground decides where all cells are in one line.
LocalPlane PlaneAround(const GroundHeights& ground, const Eigen::Vector2d& at, int reach) {
  constexpr double kLevel = 0.01;
  LocalPlane plane;
  const Eigen::Vector2i cell = ground.CellOf(at);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double scale = ground.side() * reach;
  for (int y = std::max(0, cell.y() - reach); y <= std::min(ground.rows() - 1, cell.y() + reach);
       ++y) {
    for (int x = std::max(0, cell.x() - reach);
         x <= std::min(ground.columns() - 1, cell.x() + reach); ++x) {
      const GroundCell& seen = ground.At(x, y);
      if (seen.samples == 0) continue;
      const Eigen::Vector2d away = (seen.middle.head<2>() - at) / scale;
      const double weight = 1 / (0.05 + away.squaredNorm());
      const Eigen::Vector3d row(1, away.x(), away.y());
      normal += weight * row * row.transpose();
      right += weight * seen.middle.z() * row;
      ++plane.cells;
    }
  }
  if (plane.cells == 0) return plane;
  normal(1, 1) += kLevel * normal(0, 0);
  normal(2, 2) += kLevel * normal(0, 0);
  const Eigen::Vector3d solved = normal.ldlt().solve(right);
  plane.z0 = solved.x();
  plane.slope = solved.tail<2>() / scale;
  return plane;
}

// Lets the ground go on from the cells where planes show it.
class GroundGrower {
 public:
  GroundGrower(const PlanarScene& scene, std::span<const Polygon> footprints, GroundHeights& ground)
      : scene_(scene), ground_(ground), open_(ground.cells().size()) {
    const Eigen::Matrix3d upright_from_world = UprightFromWorld(scene.up);
    positions_.reserve(scene.samples.size());
    for (const auto& p : scene.samples.positions) positions_.push_back(upright_from_world * p);
    std::vector<Eigen::AlignedBox2d> boxes;
    boxes.reserve(footprints.size());
    for (const Polygon& footprint : footprints) boxes.push_back(BoundsOf(footprint));
    inside_.resize(positions_.size());
    for (size_t i = 0; i < positions_.size(); ++i) {
      const Eigen::Vector2d p = positions_[i].head<2>();
      for (size_t f = 0; f < boxes.size() && inside_[i] == 0; ++f) {
        inside_[i] = static_cast<char>(boxes[f].contains(p) && Contains(footprints[f], p));
      }
    }
  }

  void TakePlanes() {
    for (const Plane& plane : scene_.ground) {
      for (const int i : plane.points) {
        if (inside_[i] == 0) ground_.Add(positions_[i], scene_.samples.weights[i]);
      }
    }
  }

  // Ring by ring, until nothing joins on.
  void Grow() {
    ListSamples();
    std::vector<int> joining;
    do {
      joining.clear();
      for (int y = 0; y < ground_.rows(); ++y) {
        for (int x = 0; x < ground_.columns(); ++x) {
          if (ground_.At(x, y).samples == 0) AddGoingOn(x, y, joining);
        }
      }
      for (const int i : joining) ground_.Add(positions_[i], scene_.samples.weights[i]);
    } while (!joining.empty());
  }

 private:
  std::vector<int>& OpenAt(int x, int y) {
    return open_[static_cast<size_t>(y) * ground_.columns() + x];
  }

  void ListSamples() {
    for (size_t i = 0; i < positions_.size(); ++i) {
      if (inside_[i] != 0 || scene_.samples.normals[i].dot(scene_.up) < kCosOfUp) continue;
      const Eigen::Vector2i cell = ground_.CellOf(positions_[i].head<2>());
      const bool beside =
          (cell.array() < 0).any() || cell.x() >= ground_.columns() || cell.y() >= ground_.rows();
      if (!beside) OpenAt(cell.x(), cell.y()).push_back(static_cast<int>(i));
    }
  }

  // The samples of an unseen cell that lie where the cells around it lead to.
  void AddGoingOn(int x, int y, std::vector<int>& joining) {
    constexpr int kFewestCells = 4;
    constexpr size_t kFewestSamples = 3;
    const std::vector<int>& open = OpenAt(x, y);
    if (open.size() < kFewestSamples) return;
    const Eigen::Vector2d middle = ground_.MiddleOf(x, y);
    const LocalPlane plane = PlaneAround(ground_, middle, 2);
    if (plane.cells < kFewestCells) return;
    const size_t before = joining.size();
    for (const int i : open) {
      const double height = plane.z0 + plane.slope.dot(positions_[i].head<2>() - middle);
      const double off = std::abs(positions_[i].z() - height);
      if (off < scene_.tolerances.level_of_detail) joining.push_back(i);
    }
    if (joining.size() < before + kFewestSamples) joining.resize(before);
  }

  const PlanarScene& scene_;
  GroundHeights& ground_;
  std::vector<Eigen::Vector3d> positions_;  // of all samples, upright
  std::vector<char> inside_;                // a footprint
  std::vector<std::vector<int>> open_;      // of each cell, samples beside footprints that look up
};

}  // namespace

GroundHeights::GroundHeights(const Eigen::AlignedBox2d& box, double side)
    : corner_(box.min()),
      side_(side),
      columns_(static_cast<int>(std::floor(box.sizes().x() / side)) + 1),
      rows_(static_cast<int>(std::floor(box.sizes().y() / side)) + 1),
      cells_(static_cast<size_t>(columns_) * rows_) {
  assert(!box.isEmpty() && side > 0);
}

Eigen::Vector2i GroundHeights::CellOf(const Eigen::Vector2d& p) const {
  return ((p - corner_) / side_).array().floor().matrix().cast<int>();
}

void GroundHeights::Add(const Eigen::Vector3d& position, int points) {
  const Eigen::Vector2i at = CellOf(position.head<2>());
  if ((at.array() < 0).any() || at.x() >= columns_ || at.y() >= rows_) return;
  GroundCell& cell = cells_[IndexOf(at.x(), at.y())];
  ++cell.samples;
  cell.middle += (position - cell.middle) / cell.samples;
  cell.points += points;
}

double GroundHeights::HeightAt(const Eigen::Vector2d& p) const {
  constexpr int kFewest = 5;
  const int all = std::max(columns_, rows_);
  for (int reach = 2;; reach *= 2) {
    const LocalPlane plane = PlaneAround(*this, p, reach);
    if (plane.cells >= kFewest || reach > all) return plane.z0;
  }
}

GroundHeights MeasureGround(const PlanarScene& scene, std::span<const Polygon> footprints) {
  const Eigen::Matrix3d upright_from_world = UprightFromWorld(scene.up);
  Eigen::AlignedBox2d box;
  for (const Plane& plane : scene.ground) {
    for (const int i : plane.points) {
      box.extend((upright_from_world * scene.samples.positions[i]).head<2>());
    }
  }
  double side = kDetailsPerCell * scene.tolerances.level_of_detail;
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());
  side = std::max(side, std::sqrt(box.volume() / kMostGroundCells));
  box.min().array() -= 2 * side;
  box.max().array() += 2 * side;
  GroundHeights ground(box, side);
  GroundGrower grower(scene, footprints, ground);
  grower.TakePlanes();
  grower.Grow();
  return ground;
}

}  // namespace stucco
