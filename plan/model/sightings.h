// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/preset.h"
#include "plan/hover.h"
#include "plan/model/cells.h"
#include "plan/model/frustum.h"
#include "plan/model/site_model.h"
#include "plan/model/surface_samples.h"

namespace stucco::plan {

// A sample that a hover sees, in `shots` of its photos. Packed, as there are tens of millions of
// them in a town.
struct Sighting {
  uint32_t sample = 0;
  uint8_t shots = 0;
  bool nadir = false;  // one of them looks straight down
};

// Samples sorted into square cells, to find those in a picture without asking all of them.
class SampleIndex {
 public:
  SampleIndex(std::span<const SurfaceSample> samples, double cell_m);

  // The samples that any of the pictures may show, in ascending order of cells. The frusta share
  // their position and reach.
  std::vector<uint32_t> Candidates(std::span<const Frustum> frusta) const;

 private:
  struct Bin {
    Cell cell;
    uint32_t first = 0;
    uint32_t last = 0;
    Eigen::Vector3d low, high;  // box around its samples
  };
  double cell_m_;
  std::vector<Bin> bins_;        // ascending by cell
  std::vector<uint32_t> order_;  // samples by bin
};

// All that decides which samples a hover sees.
struct SurfaceView {
  SurfaceView(const Site& site, const CameraPreset& preset, std::vector<SurfaceSample> points,
              double d_max_m);

  CameraPreset camera;
  double reach_m;
  std::vector<SurfaceSample> samples;
  SiteModel model;
  SampleIndex index;
};

// The samples that a hover sees: in the picture, within d_max, facing the camera and with nothing
// in between. Ascending by sample.
std::vector<Sighting> SightingsOf(const SurfaceView& view, const Hover& hover);

}  // namespace stucco::plan
