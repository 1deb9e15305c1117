// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "proxy/map/fitted_building.h"
#include "proxy/map/outlines.h"
#include "proxy/map/upright_survey.h"
#include "proxy/options/proxy_options.h"
#include "survey/proxy.h"

namespace stucco {

// How much of a building's solid the cloud holds, from most to least.
enum class SolidDetail {
  kFull,     // walls fitted, every roof plane that was found
  kCoarse,   // only the largest roof planes: all of them gave no sound solid
  kFlatTop,  // LoD1.2: a level top at the height that points show
  kFromMap,  // the plan extruded, where no points say better
};
std::string_view Name(SolidDetail detail);

// What of a footprint stands, by what the cloud shows inside of it.
enum class Standing { kStands, kGone, kUnseen };

// The finest solid of a building that is sound.
struct ClosedBuilding {
  Standing standing = Standing::kStands;
  FittedBuilding fitted;      // what it was made from
  std::vector<Facet> facets;  // in the world; empty: nothing stands, or nothing closes
  SolidDetail detail = SolidDetail::kFull;
  std::string not_finer;   // "full: in millimetres crosses itself"; empty: nothing finer was tried
  size_t roof_planes = 0;  // found, used or not
};

// Closes buildings one by one: their footprints cut and labelled by roof planes (roof_cells.h) and
// extruded from the ground (extrude_cells.h); coarser where that is no sound solid as written.
class BuildingCloser {
 public:
  // All three must outlive it; `up` is that of the survey in the world.
  BuildingCloser(const UprightSurvey& survey, const Eigen::Vector3d& up,
                 const ProxyOptions& options);

  // `mapped` is the building as the map has it, with as many corners as `fitted`. What does not
  // stand is closed only where nobody saw it and the plan wanted it captured: as the map has it.
  ClosedBuilding Close(const MapBuilding& mapped, const FittedBuilding& fitted,
                       double plan_to_survey_m) const;

 private:
  const UprightSurvey& survey_;
  const ProxyOptions& options_;
  Eigen::Matrix3d world_from_upright_;
};

enum class NewBuilding {
  kNone,
  kUnsure,  // a roof on what looks like walls, of which too little is seen to build it
  kSure,
};

// What stands on no footprint is a building only where its roof is smooth and seen, as crowns are
// rough, and its walls are seen, where the survey shows walls and others do not hide them
// (Facet::party): below a dense crown only leaves stand upright.
NewBuilding JudgeNew(const ClosedBuilding& closed, bool shows_walls);

}  // namespace stucco
