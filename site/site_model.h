// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "site/site.h"
#include "survey/occluders.h"

namespace stucco {

// What of a site blocks lines of sight: the walls of every footprint, flat roofs at their tops,
// undersides of parts that do not stand on the ground, and the ground where a terrain is given.
// With GroundRule::kNearestFoot the ground far around the buildings, and no undersides.
Occluders OccludersOf(const Site& site);

// Says what can be seen past these. Safe to ask from several threads.
class SiteModel {
 public:
  explicit SiteModel(const Site& site);

  // Nothing of the site stands between the camera and the point. The point may lie on a surface,
  // but not nearer than a centimetre to an edge of one that looks the other way.
  bool Sees(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const;

 private:
  Occluders occluders_;
};

}  // namespace stucco
