// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/options/plan_options.h"

namespace stucco::plan {

void Describe(OptionTable& table, PlanOptions& options) {
  table.Add("method", options.method, {"cocapture", "oblique", "dronescan"},
            "What plans the views: facades and roofs together, a grid of five views, or views at a "
            "fixed distance from the surface");
  table.Add("camera", options.camera, {},
            "Drone by name, or a camera as 17.3x13mm,12.29mm,5280x3956 (sensor, focal length, "
            "pixels)");
  table.Add("altitude_m", options.altitude_m, 0, kMostAltitude_m,
            "Safe altitude above the ground, over every building; 0: d_min_m above the tallest one "
            "of a map with heights");
  table.Add("gsd_m", options.gsd_m, 0.001, 1, "Coarsest size of a pixel on a wall, in metres");
  table.Add("d_min_m", options.d_min_m, 2, 100,
            "Least distance to buildings and obstacles of the map, in metres; the three errors "
            "below are a part of it");
  table.Add("map_error_m", options.map_error_m, 0, 20,
            "How far outlines of the map may be off, in metres");
  table.Add("height_error_m", options.height_error_m, 0, 50,
            "How far heights of the map may be too low, in metres");
  table.Add("position_error_m", options.position_error_m, 0, 20,
            "How far the drone may be from where it should be, in metres, in any direction");
  table.Add("d_max_m", options.d_max_m, 0, 1000,
            "Farthest wall that a photo counts for, in metres; 0: from gsd_m");
  table.Add("min_altitude_m", options.min_altitude_m, 2, 500,
            "Lowest flight above the ground, in metres");
  table.Add("forward_overlap", options.forward_overlap, 0.1, 0.95,
            "Share of a straight-down photo that its neighbour along the line shows too");
  table.Add("side_overlap", options.side_overlap, 0.1, 0.95,
            "Share of a straight-down photo that its neighbour on the next line shows too");
  table.Add("margin_m", options.margin_m, 0, 1000,
            "How far views go beyond the buildings, in metres; 0: as far as they are high");
  table.Add("vertical_step", options.vertical_step, 0.2, 1,
            "Step down a wall, as a share of the height of the wall in one photo");
  table.Add(
      "reconstructability", options.reconstructability, 0, 100,
      "Least reconstructability that thinning out leaves at every point of the surface; 0: six "
      "times that of one good pair of photos");
  table.Add("links", options.links,
            "Add photos between those that would not match by themselves (method cocapture)");
  table.Add(
      "battery_percent", options.battery_percent, 10, 100,
      "Share of a battery that one flight may use, less what its way home takes against the wind");
  table.Add("wind_m_per_s", options.wind_m_per_s, 0, kMostWind_m_per_s,
            "Wind that time and energy are reckoned with, in metres a second");
  table.Add("date", options.date, {},
            "Day of the flight as 2026-06-21, for the hours of sun on walls in checklist.html; "
            "empty: equinox and both solstices");
  table.Add("map_layer", options.map_layer, {},
            "Layer of the map with the buildings; empty: one with \"building\" in its name, else "
            "the first "
            "with polygons");
  table.Add("height_field", options.height_field, {},
            "Attribute with the height of a building in metres; empty: the usual names");
  table.Add("id_field", options.id_field, {},
            "Attribute with the id of a building; empty: the usual names");
  table.Add("map_crs", options.map_crs, {},
            "Coordinate system of a map that names none, as EPSG:25832");
}

}  // namespace stucco::plan
