// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/cityjson.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

// CityJSON's table of vertices in whole numbers: vertex * scale + translate.
class VertexTable {
 public:
  VertexTable(const Proxy& proxy, const Eigen::Matrix3d& turned_from_world)
      : turned_from_world_(turned_from_world) {
    Eigen::AlignedBox3d box;
    for (const Building& building : proxy.buildings) {
      for (const Facet& facet : building.facets) {
        for (const auto& p : facet.outer) box.extend(turned_from_world * p);
      }
    }
    if (box.isEmpty()) return;
    // Millimetres, or six digits of the extent where a unit is no metre.
    scale_ =
        proxy.metric ? 0.001 : std::pow(10, std::floor(std::log10(box.sizes().maxCoeff())) - 6);
    translate_ = (box.min() / (1000 * scale_)).array().floor() * 1000 * scale_;
    box_ = box;
  }

  // Indices of a ring, without repeats; empty when fewer than three corners are left.
  Json Ring(const std::vector<Eigen::Vector3d>& ring) {
    std::vector<int> indices;
    for (const auto& p : ring) {
      const int index = IndexOf(p);
      if (indices.empty() || indices.back() != index) indices.push_back(index);
    }
    while (indices.size() > 1 && indices.front() == indices.back()) indices.pop_back();
    if (indices.size() < 3) indices.clear();
    return indices;
  }

  Json Vertices() const { return vertices_; }
  Json Transform() const {
    return {{"scale", {scale_, scale_, scale_}},
            {"translate", {translate_.x(), translate_.y(), translate_.z()}}};
  }
  Json Extent() const {
    return {box_.min().x(), box_.min().y(), box_.min().z(),
            box_.max().x(), box_.max().y(), box_.max().z()};
  }
  bool IsEmpty() const { return vertices_.empty(); }

 private:
  int IndexOf(const Eigen::Vector3d& point_in_world) {
    const Eigen::Vector3d p = (turned_from_world_ * point_in_world - translate_) / scale_;
    const std::array<int64_t, 3> whole = {std::llround(p.x()), std::llround(p.y()),
                                          std::llround(p.z())};
    const auto [entry, added] = index_.try_emplace(whole, static_cast<int>(vertices_.size()));
    if (added) vertices_.push_back(whole);
    return entry->second;
  }

  Eigen::Matrix3d turned_from_world_;
  Eigen::AlignedBox3d box_;
  double scale_ = 0.001;
  Eigen::Vector3d translate_ = Eigen::Vector3d::Zero();
  std::map<std::array<int64_t, 3>, int> index_;
  std::vector<std::array<int64_t, 3>> vertices_;
};

Json SemanticsOf(const Facet& facet, const Eigen::Vector3d& up) {
  // CityGML has a class of its own for floors seen from below.
  const bool ceiling = facet.facet_class == FacetClass::kOuterFloor && facet.normal.dot(up) < 0;
  Json surface = {{"type", ceiling ? "OuterCeilingSurface" : CityGmlName(facet.facet_class)}};
  surface["id"] = facet.id;
  surface["facade"] = FacadeName(facet);
  Json others = Json::array();
  for (size_t i = 1; i < facet.planned_facades.size(); ++i) {
    others.push_back(facet.planned_facades[i]);
  }
  surface["other_facades"] = std::move(others);
  surface["area"] = facet.area;
  surface["rms"] = facet.rms;
  surface["seen"] = facet.seen;
  surface["source"] = facet.source;
  return surface;
}

Json GeometryOf(const Building& building, const Eigen::Vector3d& up, bool semantics,
                VertexTable& table) {
  Json surfaces = Json::array(), values = Json::array(), boundary = Json::array();
  for (const Facet& facet : building.facets) {
    Json rings = Json::array();
    rings.push_back(table.Ring(facet.outer));
    if (rings[0].empty()) continue;
    for (const auto& hole : facet.holes) {
      Json ring = table.Ring(hole);
      if (!ring.empty()) rings.push_back(std::move(ring));
    }
    boundary.push_back(std::move(rings));
    values.push_back(static_cast<int>(surfaces.size()));
    surfaces.push_back(SemanticsOf(facet, up));
  }
  Json geometry = {{"type", building.watertight ? "Solid" : "MultiSurface"}, {"lod", "2.2"}};
  geometry["boundaries"] = building.watertight ? Json::array({boundary}) : boundary;
  if (semantics) {
    geometry["semantics"] = {{"surfaces", surfaces},
                             {"values", building.watertight ? Json::array({values}) : values}};
  }
  return geometry;
}

}  // namespace

std::string CityJsonText(const Proxy& proxy) {
  const Eigen::Matrix3d turned_from_world =
      Eigen::Quaterniond::FromTwoVectors(proxy.up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  VertexTable table(proxy, turned_from_world);
  Json objects = Json::object();
  for (const Building& building : proxy.buildings) {
    if (building.facets.empty()) continue;
    if (building.id == "G0") {
      objects["G0"] = {{"type", "LandUse"},
                       {"geometry", Json::array({GeometryOf(building, proxy.up, false, table)})}};
      continue;
    }
    const std::string part = building.id + "-1";
    Json attributes = {{"watertight", building.watertight}, {"source", building.source}};
    if (!building.detail.empty()) attributes["detail"] = building.detail;
    objects[building.id] = {{"type", "Building"},
                            {"attributes", std::move(attributes)},
                            {"children", Json::array({part})}};
    objects[part] = {{"type", "BuildingPart"},
                     {"parents", Json::array({building.id})},
                     {"geometry", Json::array({GeometryOf(building, proxy.up, true, table)})}};
  }
  Json city = {{"type", "CityJSON"}, {"version", "2.0"}};
  city["transform"] = table.Transform();
  if (!table.IsEmpty()) {
    city["metadata"] = {{"title", proxy.metric ? "Stucco proxy, metres in a local frame"
                                               : "Stucco proxy, free unit of length"},
                        {"geographicalExtent", table.Extent()}};
  }
  city["CityObjects"] = std::move(objects);
  city["vertices"] = table.IsEmpty() ? Json::array() : table.Vertices();
  return city.dump() + "\n";
}

}  // namespace stucco
