// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "site/frustum.h"
#include "site/grid_cells.h"
#include "site/site_model.h"
#include "site/surface_samples.h"

namespace stucco {

// A sample that is seen from a place, in one of its pictures or more.
struct Sighting {
  uint32_t sample = 0;
  bool nadir = false;  // one of them looks straight down
};

// Samples sorted into square cells, to find those in a picture without asking all of them.
class SampleIndex {
 public:
  SampleIndex(std::span<const SurfaceSample> samples, double cell_m);

  // The samples that any of the pictures may show, in ascending order of cells. The frusta share
  // their position and reach.
  std::vector<uint32_t> Candidates(std::span<const Frustum> frusta) const;

  // The samples of all cells that reach into the square of this half width around a place, in
  // ascending order of cells.
  std::vector<uint32_t> Near(const Eigen::Vector2d& place, double half_width_m) const;

 private:
  struct Bin {
    GridCell cell;
    uint32_t first = 0;
    uint32_t last = 0;
    Eigen::Vector3d low, high;  // box around its samples
  };
  // Calls visit(bin) for the bins of all cells from `low` to `high`, ascending.
  template <typename Visit>
  void ForBins(const GridCell& low, const GridCell& high, const Visit& visit) const;

  double cell_m_;
  std::vector<Bin> bins_;        // ascending by cell
  std::vector<uint32_t> order_;  // samples by bin
};

// All that decides which samples cameras see: their field of view, how far they see (`reach_m`),
// and what there is to see and to hide it.
struct SurfaceView {
  SurfaceView(const Site& site, const FieldOfView& field_of_view, std::vector<SurfaceSample> points,
              double farthest_m);

  FieldOfView field;
  double reach_m;
  std::vector<SurfaceSample> samples;
  SiteModel model;
  SampleIndex index;
};

// The samples that are seen from a place: in a picture, within its reach, facing the camera and
// with nothing in between. Ascending by sample.
std::vector<Sighting> SightingsFrom(const Viewpoint& place, const SurfaceView& view);

}  // namespace stucco
