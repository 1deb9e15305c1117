// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "survey/surface_model.h"

namespace stucco {

// A polygon by its corners, which polygons next to each other share.
struct WeldedPolygon {
  std::vector<std::vector<int>> rings;  // the outer one first
  int object = 0;
  // Polygons of one group may be one facet.
  int group = 0;
  std::optional<FacetClass> facet_class;
  std::string id;
};

struct WeldedModel {
  std::vector<Eigen::Vector3d> corners;
  std::vector<WeldedPolygon> polygons;
  int doubled = 0;  // polygons that were there twice, and are once
  int empty = 0;    // polygons without area, left out
};

// Corners nearer than about `flat` / 10 become one; polygons farther than `flat` from their plane
// become triangles.
WeldedModel Weld(const SurfaceModel& model, double flat);

// Newell's normal of a ring, twice its area long.
Eigen::Vector3d AreaVector(const std::vector<Eigen::Vector3d>& corners,
                           const std::vector<int>& ring);

}  // namespace stucco
