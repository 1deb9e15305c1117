// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proxy/imported/welded_model.h"

namespace stucco {

// Polygons in one plane that hang together by edges, as one with holes.
struct FlatPiece {
  std::vector<std::vector<int>> rings;  // of WeldedModel::corners, the outer one first
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;  // normal . x = offset
  double area = 0;
  double deviation = 0;  // the farthest corner's from the plane
  int object = 0;
  int first = 0;  // of its polygons: pieces are in this order
  std::optional<FacetClass> facet_class;
  std::string id;
};

// By a directed edge of rings, the pieces that have it.
using PieceEdges = std::map<std::pair<int, int>, std::vector<int>>;
PieceEdges EdgesOf(const std::vector<FlatPiece>& pieces);

// Moves corners onto the planes of their pieces, and planes to their corners, by turns, no corner
// by more than `most`: files round corners, and a plane of more than three would be bent.
void Settle(double most, WeldedModel& model, std::vector<FlatPiece>& pieces);

// Grows pieces from the largest polygons on: a polygon joins across an edge that it alone shares
// with the piece, within `flat` of the plane of the first.
std::vector<FlatPiece> FindFlatPieces(const WeldedModel& model, double flat);

}  // namespace stucco
