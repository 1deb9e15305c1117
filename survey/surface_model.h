// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "survey/proxy.h"

namespace stucco {

// A polygon as a file has it: not planar to the last digit.
struct SurfacePolygon {
  // The outer one first, counter-clockwise from outside; holes the other way round.
  std::vector<std::vector<Eigen::Vector3d>> rings;
  std::optional<FacetClass> facet_class;  // where the file says
  std::string id;                         // of a facet, where the file names it
};

// A building as the file has it, or, where it knows none, all there is.
struct SurfaceObject {
  std::string id;  // "" where the file knows no buildings
  bool is_ground = false;
  std::vector<SurfacePolygon> polygons;
};

// A model of buildings of another program.
struct SurfaceModel {
  std::string format;  // "glTF"
  std::string crs;     // "EPSG:7415"; empty: the file names none
  // Polygons are triangles of a mesh: what lies in one plane is one facet.
  bool is_mesh = false;
  std::vector<SurfaceObject> objects;
  std::vector<std::string> notes;  // what of the file was left out
};

// Calls `what` with every corner, in the order of the polygons.
template <typename Do>
void ForCorners(SurfaceModel& model, const Do& what) {
  for (SurfaceObject& object : model.objects) {
    for (SurfacePolygon& polygon : object.polygons) {
      for (auto& ring : polygon.rings) {
        for (Eigen::Vector3d& corner : ring) what(corner);
      }
    }
  }
}

}  // namespace stucco
