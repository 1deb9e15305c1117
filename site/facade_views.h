// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "site/facade_grid.h"
#include "site/frustum.h"
#include "site/site.h"
#include "site/site_model.h"

namespace stucco {

// What one picture sees of a facade.
struct SeenView {
  int place = 0;                                        // index of a viewpoint
  int picture = 0;                                      // of those taken there
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // of the camera, unit
  std::vector<uint32_t> cells;                          // ascending, not empty
};

// Finds the pictures that see a facade: in the picture, not farther than `reach_m` in space, at
// most kMaxIncidence_rad off the normal and with nothing of the site in between. Safe to ask from
// several threads.
class FacadeViews {
 public:
  // Makes the pictures of a place when they are asked for: a town has too many to keep.
  using PicturesOf = std::function<Viewpoint(int place)>;

  // `positions` are those of the places. Keeps a reference to the site.
  FacadeViews(const Site& site, std::vector<Eigen::Vector3d> positions, double reach_m,
              PicturesOf pictures_of);

  // By place, then picture.
  std::vector<SeenView> Of(int facade) const;
  // The same, asking for these cells only (ascending).
  std::vector<SeenView> Of(int facade, std::span<const uint32_t> cells) const;

  // Cells that no picture sees, ascending.
  std::vector<uint32_t> Unseen(int facade) const;

  const FacadeGrid& grid(int facade) const { return grids_[facade]; }

 private:
  std::vector<uint32_t> AllCells(int facade) const;
  // Places that may see the facade, ascending.
  std::vector<int> PlacesNear(int facade) const;
  void AddViewsFrom(int place, int facade, std::span<const uint32_t> cells,
                    std::vector<SeenView>& views) const;

  const Site& site_;
  std::vector<Eigen::Vector3d> positions_;
  double reach_m_;
  PicturesOf pictures_of_;
  SiteModel model_;
  std::vector<FacadeGrid> grids_;
  std::vector<int> by_x_;  // places by ascending x
};

}  // namespace stucco
