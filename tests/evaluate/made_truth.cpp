// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/evaluate/made_truth.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "survey/triangulate.h"

namespace stucco::evaluate {

using Eigen::Vector3d;

Facet MadeFacet(const std::string& id, FacetClass facet_class, const std::vector<Vector3d>& outer) {
  Facet facet;
  facet.id = id;
  facet.facet_class = facet_class;
  facet.outer = outer;
  Vector3d twice_area = Vector3d::Zero();
  for (size_t i = 1; i + 1 < outer.size(); ++i) {
    twice_area += (outer[i] - outer[0]).cross(outer[i + 1] - outer[0]);
  }
  facet.normal = twice_area.normalized();
  facet.offset = facet.normal.dot(outer[0]);
  facet.area = twice_area.norm() / 2;
  facet.seen = 1;
  facet.source = "planes";
  return facet;
}

Building MadeBox(const std::string& id, const Vector3d& low, const Vector3d& high) {
  const auto corner = [&](bool east, bool north, bool up) {
    return Vector3d(east ? high.x() : low.x(), north ? high.y() : low.y(), up ? high.z() : low.z());
  };
  const std::vector<Vector3d> foot = {corner(false, false, false), corner(true, false, false),
                                      corner(true, true, false), corner(false, true, false)};
  const Vector3d rise(0, 0, high.z() - low.z());
  Building building{.id = id, .watertight = true, .source = "cloud", .detail = {}, .facets = {}};
  std::vector<Vector3d> top;
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d &a = foot[i], &b = foot[(i + 1) % 4];
    building.facets.push_back(
        MadeFacet(id + "/F0" + std::to_string(i), FacetClass::kWall, {a, b, b + rise, a + rise}));
    top.push_back(a + rise);
  }
  building.facets.push_back(MadeFacet(id + "/R0", FacetClass::kRoof, top));
  building.facets.push_back(
      MadeFacet(id + "/G0", FacetClass::kGround, {foot[0], foot[3], foot[2], foot[1]}));
  return building;
}

Proxy MadeTruth() {
  Proxy truth;
  truth.metric = true;
  truth.buildings = {MadeBox("B0001", {0, 0, 0}, {10, 8, 6}),
                     MadeBox("B0002", {22, 0, 0}, {30, 8, 9})};
  Facet ground = MadeFacet("G0", FacetClass::kGround,
                           {{-15, -15, 0}, {45, -15, 0}, {45, 23, 0}, {-15, 23, 0}});
  for (const Building& building : truth.buildings) {
    ground.holes.push_back(building.facets.back().outer);  // seen from below: clockwise from above
    ground.area -= building.facets.back().area;
  }
  truth.buildings.push_back(
      {.id = "G0", .watertight = false, .source = "cloud", .detail = {}, .facets = {ground}});
  return truth;
}

namespace {

void AppendElement(const std::string& name, const std::vector<Facet>& facets,
                   simulate::Scene& scene) {
  for (const Facet& facet : facets) {
    const FacetTriangles pieces = TriangulateFacet(facet);
    const int first = static_cast<int>(scene.positions.size());
    for (const Vector3d& vertex : pieces.vertices) {
      scene.positions.push_back(vertex.cast<float>());
      scene.uv.emplace_back(0.0f, 0.0f);
    }
    for (const auto& t : pieces.triangles) {
      scene.triangles.emplace_back(first + static_cast<int>(t[0]), first + static_cast<int>(t[1]),
                                   first + static_cast<int>(t[2]));
      scene.materials_of.push_back(0);
      scene.elements_of.push_back(static_cast<int>(scene.elements.size()));
    }
  }
  scene.elements.push_back(name);
}

simulate::FlownPhoto PhotoFrom(const Vector3d& centre, const Vector3d& target,
                               const std::string& path) {
  simulate::FlownPhoto photo;
  photo.path = path;
  photo.camera.id = CameraId(1);
  photo.camera.width_px = 1000;
  photo.camera.height_px = 800;
  photo.camera.params = {600, 600, 500, 400};
  const Vector3d z = (target - centre).normalized();
  const Vector3d x =
      z.cross(std::abs(z.z()) > 0.99 ? Vector3d::UnitY() : Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  photo.cam_from_world.rotation = Eigen::Quaterniond(rows);
  photo.cam_from_world.translation = -(photo.cam_from_world.rotation * centre);
  return photo;
}

}  // namespace

simulate::Scene MadeScene(const Proxy& truth) {
  simulate::Scene scene;
  scene.materials.resize(1);
  for (const Building& building : truth.buildings) {
    for (const Facet& facet : building.facets) AppendElement(facet.id, {facet}, scene);
  }
  AppendElement("occluder/tree-000", MadeBox("tree", {4, -5, 0}, {6, -3, 4}).facets, scene);
  return scene;
}

simulate::Flight MadeFlight() {
  const Vector3d middle(15, 4, 0);
  simulate::Flight flight;
  flight.scene = "made";
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6;
    const Vector3d centre =
        middle + Vector3d(60 * std::cos(angle), 60 * std::sin(angle), 60 + 0.5 * (i % 3));
    flight.photos.push_back(PhotoFrom(centre, middle, fmt::format("ring{:02}.jpg", i)));
  }
  flight.photos.push_back(PhotoFrom(middle + Vector3d(0, 0, 80), middle, "down.jpg"));
  return flight;
}

Reconstruction MadeReconstruction(const simulate::Flight& flight) {
  Reconstruction reconstruction;
  for (const simulate::FlownPhoto& photo : flight.photos) {
    if (photo.lost || photo.held_out) continue;
    const PhotoId id(static_cast<uint32_t>(reconstruction.photos.size() + 1));
    reconstruction.cameras[photo.camera.id] = photo.camera;
    reconstruction.photos[id] = {id, photo.camera.id, photo.path, photo.cam_from_world, {}};
  }
  return reconstruction;
}

Georef MadeGeoref() {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 50;
  georef.origin_longitude_deg = 14;
  georef.origin_height_m = 200;
  georef.metric = true;
  return georef;
}

Similarity AnySimilarity() {
  return {
      .scale = 0.4,
      .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.5, 0.8).normalized())),
      .translation = {120, -40, 7}};
}

}  // namespace stucco::evaluate
