// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/preset.h"
#include "plan/hover.h"
#include "plan/model/site_model.h"
#include "plan/quality/facade_quality.h"
#include "plan/site.h"

namespace stucco::plan {

// A facade as equal cells, of about a square metre each; at least three columns and two rows, at
// most about 400 cells. Each is seen or not seen by its centre.
struct FacadeGrid {
  explicit FacadeGrid(const Facade& facade);

  size_t size() const { return static_cast<size_t>(columns) * rows; }
  Eigen::Vector3d Center(uint32_t cell) const;
  Interval Along(uint32_t cell) const;
  Interval Heights(uint32_t cell) const;

  Eigen::Vector2d a, along;
  double length_m = 0;
  Interval z_m;
  int columns = 0;
  int rows = 0;
};

// The target on a facade that just holds these cells. Requires at least one.
Target BoxAround(const FacadeGrid& grid, int facade, std::span<const uint32_t> cells);

// What one photo sees of a facade.
struct SeenView {
  int hover = 0;
  int shot = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // of the camera, unit
  std::vector<uint32_t> cells;                          // ascending, not empty
};

// Finds the photos that see a facade: in the picture, nearer than d_max in space, at most 75
// degrees off the normal and with nothing of the site in between. Safe to ask from several threads.
class FacadeSight {
 public:
  // Keeps references to the site and the hovers.
  FacadeSight(const Site& site, const CameraPreset& camera, double d_max_m,
              std::span<const Hover> hovers);

  // By hover, then shot.
  std::vector<SeenView> ViewsOf(int facade) const;
  // The same, asking for these cells only (ascending).
  std::vector<SeenView> ViewsOf(int facade, std::span<const uint32_t> cells) const;

  // What `cells` of a view are worth in eq. 1 and 2 for the facade. The distance is that from the
  // camera to their centroid.
  SeenPart PartOf(int facade, const SeenView& view, std::span<const uint32_t> cells) const;
  // Eq. 2 for these cells.
  double ScoreOf(int facade, const SeenPart& part) const;

  const Site& site() const { return site_; }
  double d_max_m() const { return d_max_m_; }
  std::span<const Hover> hovers() const { return hovers_; }
  const FacadeGrid& grid(int facade) const { return grids_[facade]; }

 private:
  void AddViewsFrom(int hover, int facade, std::span<const uint32_t> cells,
                    std::vector<SeenView>& views) const;

  const Site& site_;
  CameraPreset camera_;
  double d_max_m_;
  std::span<const Hover> hovers_;
  SiteModel model_;
  std::vector<FacadeGrid> grids_;
  std::vector<int> by_x_;  // hovers by ascending x
};

}  // namespace stucco::plan
