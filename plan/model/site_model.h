// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "plan/site.h"
#include "survey/occluders.h"

namespace stucco::plan {

// The 2.5D model of a site as far as it blocks lines of sight: the walls of every footprint, flat
// roofs at their tops, undersides of parts that do not stand on the ground, and the ground where a
// terrain is given. Safe to ask from several threads.
class SiteModel {
 public:
  explicit SiteModel(const Site& site);

  // Nothing of the site stands between the camera and the point. The point may lie on a surface,
  // but not nearer than a centimetre to an edge of one that looks the other way.
  bool Sees(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const;

 private:
  Occluders occluders_;
};

}  // namespace stucco::plan
