// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "survey/surface_model.h"

namespace stucco {

// How a model has to be moved, upright, to lie on points.
struct UprightMove {
  double yaw_rad = 0;  // about `centre`, counter-clockwise seen from above
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double near_before = 0;  // share of the points within 0.2 m of it
  double near_after = 0;

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const;
};

// GPS and coordinate systems put a survey and a model of the same place some metres apart, and tens
// of metres in height where these count from other levels. Heights first, by how far points lie
// above the model's top; then the best of shifts of up to 6 m; then iterated closest points, to
// planes (Chen, Medioni, "Object modelling by registration of multiple range images", 1992), with
// far ones left out. Requires metres, z up. Nothing is moved where that brings no more points near.
UprightMove FitToPoints(const SurfaceModel& model, std::span<const Eigen::Vector3d> points);

}  // namespace stucco
