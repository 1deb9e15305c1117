// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "simulate/city/facets.h"
#include "simulate/scene/scene.h"
#include "survey/image.h"

namespace stucco::simulate {

// A picture that is made when it is needed: those of a city together take gigabytes.
struct PictureJob {
  std::function<Image()> paint;
  std::string truth_file;  // name below truth/textures; empty: it is no truth
};

// A scene in the making. Textures of materials are indices into `pictures`; `scene.textures` stays
// empty.
struct CityModel {
  Scene scene;
  std::vector<PictureJob> pictures;
};

int AddElement(const std::string& name, CityModel& model);
int AddMaterial(const Material& material, CityModel& model);
// A material of its own for a new picture; its name.
int AddPainted(const std::string& name, PictureJob job, CityModel& model);

// How a flat part is covered: the picture's top-left corner lies at `origin`, and it is width_m
// along u and height_m along v large.
struct Sheet {
  int element = 0;
  int material = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = -Eigen::Vector3d::UnitZ();
  double width_m = 1;
  double height_m = 1;

  Eigen::Vector3d normal() const;  // towards the viewer: v x u
};

// Corners counter-clockwise seen from outside. Convex polygons become fans; others are
// triangulated.
void AddConvex(const Sheet& sheet, const Loop& corners, CityModel& model);
void AddPolygon(const Sheet& sheet, const Loop& outer, const std::vector<Loop>& holes,
                CityModel& model);

// A small picture for parts without one of their own, repeated: `material` with sheets of any
// direction.
struct Trim {
  int element = 0;
  int material = 0;
  double size_m = 2;  // of the picture
};
// The sheet of a trim over a face: u level, v downwards or as near as the face allows.
Sheet TrimSheet(const Trim& trim, const Eigen::Vector3d& normal);
void AddTrim(const Trim& trim, const Loop& corners, CityModel& model);

// The sides and the top of a box over a parallelogram of the ground plan; `corners`
// counter-clockwise from above.
void AddPrism(const Trim& trim, const std::vector<Eigen::Vector2d>& corners, double low_m,
              double high_m, CityModel& model);

}  // namespace stucco::simulate
