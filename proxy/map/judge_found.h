// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "proxy/map/close_building.h"
#include "proxy/map/upright_survey.h"
#include "proxy/scene/scene.h"

namespace stucco {

// Tells houses that were closed on footprints found in the cloud from what is better built of its
// planes alone.
class FoundHouses {
 public:
  // Both must outlive it; `survey` is the scene, upright.
  FoundHouses(const PlanarScene& scene, const UprightSurvey& survey);

  // Why a house is not an extrusion of its footprint; empty where it is. Its walls have to be found
  // along half of its outline, where the survey shows walls (of a front alone nobody knows the
  // rest); they may not lean, as an extrusion cannot; and what is seen of it has to lie on it:
  // where planes are seen well inside, it is a frame or a canopy, and hollow.
  std::string WhyNot(const ClosedBuilding& closed) const;

 private:
  // A plane of the scene that is none of leaves.
  struct Surface {
    const Plane* plane;
    Eigen::AlignedBox2d box;  // in the ground plan
    bool leans = false;       // a wall that does
  };

  double LeaningShare(const ClosedBuilding& closed) const;
  double InsideShare(const ClosedBuilding& closed) const;

  const UprightSurvey& survey_;
  Eigen::Matrix3d upright_from_world_;
  std::vector<Surface> surfaces_;
};

}  // namespace stucco
