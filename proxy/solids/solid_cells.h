// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "proxy/facets/plane_view.h"
#include "proxy/scene/scene.h"
#include "proxy/solids/partition.h"

namespace stucco {

// What the data say about the cells and faces of a building's partition. The partition's frame is
// local_from_world; its cutting plane i is that of views[i].
struct CellEvidence {
  std::vector<double> inside;   // area of the points that the cell lies behind
  std::vector<double> outside;  // area of the rays that pass through the cell
  std::vector<double> covered;  // of each face: area with points
};

struct SolidInput {
  const PlanarScene* scene = nullptr;
  std::vector<const PlaneView*> views;  // of the cutting planes, in order; null: without points
  Eigen::Isometry3d local_from_world = Eigen::Isometry3d::Identity();
};

CellEvidence GatherEvidence(const Partition& partition, const Eigen::AlignedBox3d& box,
                            const SolidInput& input);

// Inside or outside per cell: minimum cut of evidence, uncovered area and area (Nan and Wonka,
// "PolyFit", 2017, and Bauchet and Lafarge, "Kinetic shape reconstruction", 2020, weigh the same
// three). Cells whose centre is below the ground (index of its plane in the partition; -1: none)
// are outside. Holes inside become solid, all but the largest connected part empty, and cells are
// flipped, smallest first, until every edge of the boundary has two faces.
std::vector<bool> LabelCells(const Partition& partition, const CellEvidence& evidence,
                             int ground_plane);

}  // namespace stucco
