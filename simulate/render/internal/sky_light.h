// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simulate/render/internal/ray_scene.h"

namespace stucco::simulate::internal {

// How much of an evenly bright sky every place of a scene sees, weighted by the cosine to its
// normal: 1 on an open plane, 0.5 on a wall over open ground. Found once at places about half a
// metre apart and interpolated between them on each triangle, as in Yuksel, Keyser and House, "Mesh
// colors" (2010), with rows parallel to a triangle's longest side so that slivers stay cheap.
class SkyLight {
 public:
  explicit SkyLight(const RayScene& scene);

  // At barycentric coordinates (of the second and third corner).
  float At(int triangle, float b1, float b2) const;

 private:
  struct Grid {
    size_t first = 0;
    uint16_t columns = 0;  // cells along the longest side; 0: one value for the triangle
    uint16_t rows = 0;     // cells towards the apex
    uint8_t apex = 0;      // the corner opposite to the longest side
  };

  // Of a triangle, with this distance between its values; `first` is left at 0.
  static Grid GridOf(const Scene& model, size_t triangle, double spacing);
  void LayOut(const RayScene& scene);
  void ComputeRow(const RayScene& scene, int triangle, int row);
  void FillUnknown(const Grid& grid);

  std::vector<Grid> grids_;
  std::vector<float> values_;
};

}  // namespace stucco::simulate::internal
