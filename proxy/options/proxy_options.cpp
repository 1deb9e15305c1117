// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/options/proxy_options.h"

namespace stucco {

void Describe(OptionTable& table, ProxyOptions& options) {
  constexpr double kLargest = 1e6;  // world units
  table.Add("level_of_detail", options.level_of_detail, 0, kLargest,
            "Steps between parallel planes smaller than this are flattened (metres, or world units "
            "when the survey has no scale). 0: 0.3 m, or 0.8 % of the viewing distance without "
            "scale, and never below three times the noise of the cloud or twice its spacing.");
  table.Add("epsilon", options.epsilon, 0, kLargest,
            "Largest distance of a point from its plane. 0: half of level_of_detail.");
  table.Add("normal_angle_deg", options.normal_angle_deg, 5, 80,
            "Largest angle between a point's normal and its plane's.");
  table.Add("min_area", options.min_area, 0, 1e12,
            "Smaller facets are dropped (square metres or squared world units). 0: a square of "
            "five times level_of_detail.");
  table.Add("min_points", options.min_points, 0, 1000000,
            "Planes with fewer points of the thinned cloud are dropped. 0: as many as make up a "
            "0.4 of min_area, 12 to 60.");
  table.Add("fill_gap", options.fill_gap, 0, kLargest,
            "Gaps of a facet up to about this width are closed (windows, occluded strips). 0: five "
            "times level_of_detail.");
  table.Add("vertical_tolerance_deg", options.vertical_tolerance_deg, 0, 20,
            "Planes this near to vertical become walls, exactly vertical where that moves no point "
            "by more than level_of_detail; planes half as near to horizontal become horizontal.");
  table.Add("align_tolerance_deg", options.align_tolerance_deg, 0, 20,
            "Directions this near to parallel or perpendicular become so, as far as no point "
            "moves by more than level_of_detail.");
  table.Add("max_points", options.max_points, 1000, 20000000,
            "The cloud is thinned to a grid with at most this many points, or fewer where "
            "run.memory_limit_gb does not hold them. More tell finer details of large surveys.");
  table.Add("solids", options.solids,
            "Close buildings to watertight solids where the points support it; false: open facets "
            "only.");
  table.Add("use_map", options.use_map,
            "Make the buildings of the plan's map solids on its footprints, fitted to the cloud, "
            "where the survey has a plan, positions, and shows that map; false: buildings are what "
            "the cloud shows, and the map only names their walls.");
  table.Add("solid_support", options.solid_support, 0, 1,
            "A solid is accepted when points cover at least this share of its walls and roofs.");
  table.Add("max_planes", options.max_planes, 4, 200,
            "Only the largest planes of a building, this many, take part in its solid.");
  table.Add(
      "up", options.up,
      "Direction away from the ground in the world frame, [x, y, z]; empty: from calibration, "
      "else from the photos and the walls.");
}

}  // namespace stucco
