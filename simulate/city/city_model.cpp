// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/city_model.h"

#include <Eigen/Geometry>
#include <cmath>

#include "survey/triangulate.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

int AddVertex(const Sheet& sheet, const Vector3d& position, Scene& scene) {
  const Vector3d from_corner = position - sheet.origin;
  scene.positions.push_back(position.cast<float>());
  scene.uv.emplace_back(static_cast<float>(from_corner.dot(sheet.u) / sheet.width_m),
                        static_cast<float>(from_corner.dot(sheet.v) / sheet.height_m));
  return static_cast<int>(scene.positions.size()) - 1;
}

void AddTriangle(const Sheet& sheet, const Eigen::Vector3i& corners, Scene& scene) {
  scene.triangles.push_back(corners);
  scene.materials_of.push_back(sheet.material);
  scene.elements_of.push_back(sheet.element);
}

}  // namespace

Vector3d Sheet::normal() const {
  return v.cross(u);
}

int AddElement(const std::string& name, CityModel& model) {
  model.scene.elements.push_back(name);
  return static_cast<int>(model.scene.elements.size()) - 1;
}

int AddMaterial(const Material& material, CityModel& model) {
  model.scene.materials.push_back(material);
  return static_cast<int>(model.scene.materials.size()) - 1;
}

int AddPainted(const std::string& name, PictureJob job, CityModel& model) {
  model.pictures.push_back(std::move(job));
  Material material;
  material.name = name;
  material.texture = static_cast<int>(model.pictures.size()) - 1;
  return AddMaterial(material, model);
}

void AddConvex(const Sheet& sheet, const Loop& corners, CityModel& model) {
  int first = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const int vertex = AddVertex(sheet, corners[i], model.scene);
    if (i == 0) first = vertex;
  }
  for (int i = 1; i + 1 < static_cast<int>(corners.size()); ++i) {
    AddTriangle(sheet, {first, first + i, first + i + 1}, model.scene);
  }
}

void AddPolygon(const Sheet& sheet, const Loop& outer, const std::vector<Loop>& holes,
                CityModel& model) {
  const FacetTriangles shape = TriangulateFacet(ExactFacet(FacetClass::kWall, outer, holes));
  const int first = static_cast<int>(model.scene.positions.size());
  for (const Vector3d& vertex : shape.vertices) AddVertex(sheet, vertex, model.scene);
  for (const auto& t : shape.triangles) {
    AddTriangle(sheet, Eigen::Vector3i(t[0], t[1], t[2]).array() + first, model.scene);
  }
}

Sheet TrimSheet(const Trim& trim, const Vector3d& normal) {
  Sheet sheet;
  sheet.element = trim.element;
  sheet.material = trim.material;
  sheet.width_m = sheet.height_m = trim.size_m;
  const Vector3d level = Vector3d::UnitZ().cross(normal);
  constexpr double kLevel = 1e-6;  // a level face has no direction of its own
  sheet.u = level.norm() > kLevel ? level.normalized() : Vector3d::UnitX();
  sheet.v = sheet.u.cross(normal);
  return sheet;
}

void AddTrim(const Trim& trim, const Loop& corners, CityModel& model) {
  AddConvex(TrimSheet(trim, AreaVector(corners).normalized()), corners, model);
}

void AddPrism(const Trim& trim, const std::vector<Vector2d>& corners, double low_m, double high_m,
              CityModel& model) {
  const auto at = [](const Vector2d& corner, double z) {
    return Vector3d(corner.x(), corner.y(), z);
  };
  Loop top;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % corners.size()];
    AddTrim(trim, {at(a, low_m), at(b, low_m), at(b, high_m), at(a, high_m)}, model);
    top.push_back(at(a, high_m));
  }
  AddTrim(trim, top, model);
}

}  // namespace stucco::simulate
