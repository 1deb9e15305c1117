// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "plan/quality/facade_quality.h"
#include "site/facade_views.h"
#include "site/site.h"

namespace stucco::plan {

// The target on a facade that just holds these cells. Requires at least one.
Target BoxAround(const FacadeGrid& grid, int facade, std::span<const uint32_t> cells);

// What the photos of hovers see of facades, and what that is worth. In a SeenView, places are
// hovers and pictures their shots. Safe to ask from several threads.
class FacadeSight {
 public:
  // Keeps references to the site and the hovers.
  FacadeSight(const Site& site, const CameraPreset& camera, double d_max_m,
              std::span<const Hover> hovers);

  // The photos that see a facade, or these cells of it (see FacadeViews).
  std::vector<SeenView> ViewsOf(int facade) const { return views_.Of(facade); }
  std::vector<SeenView> ViewsOf(int facade, std::span<const uint32_t> cells) const {
    return views_.Of(facade, cells);
  }

  // Cells of a facade that no photo sees, ascending.
  std::vector<uint32_t> Unseen(int facade) const { return views_.Unseen(facade); }

  // What `cells` of a view are worth in eq. 1 and 2 for the facade. The distance is that from the
  // camera to their centroid.
  SeenPart PartOf(int facade, const SeenView& view, std::span<const uint32_t> cells) const;
  // Eq. 2 for these cells.
  double ScoreOf(int facade, const SeenPart& part) const;

  const Site& site() const { return site_; }
  double d_max_m() const { return d_max_m_; }
  std::span<const Hover> hovers() const { return hovers_; }
  const FacadeGrid& grid(int facade) const { return views_.grid(facade); }

 private:
  const Site& site_;
  CameraPreset camera_;
  double d_max_m_;
  std::span<const Hover> hovers_;
  FacadeViews views_;
};

}  // namespace stucco::plan
