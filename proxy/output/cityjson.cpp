// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/cityjson.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "proxy/output/internal/city_appearance.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

// The rings of a surface, the outer one first: vertices of the file, and the corners in the world
// that became them.
struct WrittenRings {
  std::vector<std::vector<int>> vertices;
  std::vector<std::vector<Eigen::Vector3d>> corners;
};

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

  // Adds a ring without repeats, unless fewer than three corners are left; says whether it did.
  bool AddRing(const std::vector<Eigen::Vector3d>& ring, WrittenRings& rings) {
    std::vector<int> vertices;
    std::vector<Eigen::Vector3d> corners;
    for (const auto& p : ring) {
      const int index = IndexOf(p);
      if (!vertices.empty() && vertices.back() == index) continue;
      vertices.push_back(index);
      corners.push_back(p);
    }
    while (vertices.size() > 1 && vertices.front() == vertices.back()) {
      vertices.pop_back();
      corners.pop_back();
    }
    if (vertices.size() < 3) return false;
    rings.vertices.push_back(std::move(vertices));
    rings.corners.push_back(std::move(corners));
    return true;
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
  // Attributes of surfaces are single values.
  std::string others;
  for (size_t i = 1; i < facet.planned_facades.size(); ++i) {
    others += (others.empty() ? "" : " ") + facet.planned_facades[i];
  }
  if (!others.empty()) surface["other_facades"] = others;
  surface["area"] = facet.area;
  surface["rms"] = facet.rms;
  surface["seen"] = facet.seen;
  surface["source"] = facet.source;
  return surface;
}

// The closed pieces of a solid: facets that meet along edges, in their order. A solid of CityJSON
// is one piece, but a building of a map may stand in two places.
std::vector<Building> PiecesOf(const Building& building) {
  if (!building.watertight) return {building};
  const auto before = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::ranges::lexicographical_compare(a, b);
  };
  const auto edge_before = [&](const auto& a, const auto& b) {
    if (before(a.first, b.first) || before(b.first, a.first)) return before(a.first, b.first);
    return before(a.second, b.second);
  };
  std::map<std::pair<Eigen::Vector3d, Eigen::Vector3d>, int, decltype(edge_before)> facet_at(
      edge_before);
  DisjointSets groups(building.facets.size());
  for (int f = 0; f < static_cast<int>(building.facets.size()); ++f) {
    const Facet& facet = building.facets[f];
    std::vector<const std::vector<Eigen::Vector3d>*> rings = {&facet.outer};
    for (const auto& hole : facet.holes) rings.push_back(&hole);
    for (const auto* ring : rings) {
      for (size_t i = 0; i < ring->size(); ++i) {
        auto edge = std::pair((*ring)[i], (*ring)[(i + 1) % ring->size()]);
        if (before(edge.second, edge.first)) std::swap(edge.first, edge.second);
        const auto [entry, added] = facet_at.try_emplace(edge, f);
        if (!added) groups.Join(entry->second, f);
      }
    }
  }
  std::map<int, size_t> piece_of;
  std::vector<Building> pieces;
  for (int f = 0; f < static_cast<int>(building.facets.size()); ++f) {
    const auto [entry, added] = piece_of.try_emplace(groups.Find(f), pieces.size());
    if (added) {
      pieces.push_back(building);
      pieces.back().facets.clear();
    }
    pieces[entry->second].facets.push_back(building.facets[f]);
  }
  return pieces;
}

// `appearance`: null for surfaces without pictures.
Json GeometryOf(const Building& building, const Eigen::Vector3d& up, bool semantics,
                VertexTable& table, CityAppearance* appearance) {
  Json surfaces = Json::array(), values = Json::array(), boundary = Json::array();
  std::vector<Json> painted(appearance ? appearance->num_looks() : 0, Json::array());
  std::vector<bool> is_painted(painted.size(), false);
  for (const Facet& facet : building.facets) {
    WrittenRings rings;
    if (!table.AddRing(facet.outer, rings)) continue;
    for (const auto& hole : facet.holes) table.AddRing(hole, rings);
    boundary.push_back(std::move(rings.vertices));
    values.push_back(static_cast<int>(surfaces.size()));
    surfaces.push_back(SemanticsOf(facet, up));
    if (!appearance) continue;
    const std::vector<Json> by_look = appearance->ValuesOf(facet, rings.corners);
    for (size_t look = 0; look < by_look.size(); ++look) {
      if (!by_look[look].front().front().is_null()) is_painted[look] = true;
      painted[look].push_back(by_look[look]);
    }
  }
  // Arrays are as deep in a geometry as its boundaries: a solid has shells, of which ours is one.
  const auto nested = [&](const Json& by_surface) {
    return building.watertight ? Json::array({by_surface}) : by_surface;
  };
  Json geometry = {{"type", building.watertight ? "Solid" : "MultiSurface"}, {"lod", "2.2"}};
  geometry["boundaries"] = nested(boundary);
  if (semantics) geometry["semantics"] = {{"surfaces", surfaces}, {"values", nested(values)}};
  for (size_t look = 0; look < painted.size(); ++look) {
    if (is_painted[look]) {
      geometry["texture"][appearance->Theme(look)]["values"] = nested(painted[look]);
    }
  }
  return geometry;
}

std::string TextOf(const Proxy& proxy, CityAppearance* appearance) {
  const Eigen::Matrix3d turned_from_world =
      Eigen::Quaterniond::FromTwoVectors(proxy.up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  VertexTable table(proxy, turned_from_world);
  Json objects = Json::object();
  for (const Building& building : proxy.buildings) {
    if (building.facets.empty()) continue;
    if (building.id == "G0") {
      objects["G0"] = {
          {"type", "LandUse"},
          {"geometry", Json::array({GeometryOf(building, proxy.up, false, table, appearance)})}};
      continue;
    }
    Json parts = Json::array();
    Json attributes = {{"watertight", building.watertight}, {"source", building.source}};
    if (!building.detail.empty()) attributes["detail"] = building.detail;
    objects[building.id] = {{"type", "Building"}, {"attributes", std::move(attributes)}};
    for (const Building& piece : PiecesOf(building)) {
      const std::string part = fmt::format("{}-{}", building.id, parts.size() + 1);
      objects[part] = {
          {"type", "BuildingPart"},
          {"parents", Json::array({building.id})},
          {"geometry", Json::array({GeometryOf(piece, proxy.up, true, table, appearance)})}};
      parts.push_back(part);
    }
    objects[building.id]["children"] = std::move(parts);
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
  if (appearance && !appearance->is_empty()) city["appearance"] = appearance->Text();
  return city.dump() + "\n";
}

}  // namespace

std::string CityJsonText(const Proxy& proxy) {
  return TextOf(proxy, nullptr);
}

TexturedCity TexturedCityJson(const Proxy& proxy, std::span<const ModelLook> looks,
                              const std::string& folder) {
  assert(!looks.empty());
  CityAppearance appearance(looks, folder);
  std::string text = TextOf(proxy, &appearance);
  return {std::move(text), appearance.Pictures(), appearance.outdated()};
}

}  // namespace stucco
