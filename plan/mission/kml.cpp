// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/kml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <pugixml.hpp>
#include <vector>

#include "plan/output/colors.h"
#include "survey/geometry2d.h"
#include "survey/plan_frame.h"

namespace stucco::plan {
namespace {

constexpr int kQualityClasses = 8;
constexpr double kBestQuality = 4;  // the sum of four terms

struct KmlWriter {
  const Plan& plan;
  const char* altitude_mode;

  std::string Coordinate(const Eigen::Vector3d& position) const {
    const Geodetic point = GeodeticFromPlan(plan.origin, position.head<2>());
    return fmt::format("{:.8f},{:.8f},{:.2f}", point.longitude_deg, point.latitude_deg,
                       plan.origin.height_m + position.z());
  }
  std::string Ring(const std::vector<Eigen::Vector3d>& corners) const {
    std::vector<std::string> texts;
    texts.reserve(corners.size() + 1);
    for (const Eigen::Vector3d& corner : corners) texts.push_back(Coordinate(corner));
    if (!texts.empty()) texts.push_back(texts.front());
    return fmt::format("{}", fmt::join(texts, " "));
  }
};

void Write(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

pugi::xml_node AddFolder(pugi::xml_node parent, const std::string& name) {
  pugi::xml_node folder = parent.append_child("Folder");
  Write(folder, "name", name);
  return folder;
}

// KML writes colours as alpha, blue, green, red.
std::string KmlColor(const Rgb& color, int alpha) {
  return fmt::format("{:02x}{:02x}{:02x}{:02x}", alpha, color[2], color[1], color[0]);
}

pugi::xml_node AddStyle(pugi::xml_node document, const std::string& id) {
  pugi::xml_node style = document.append_child("Style");
  style.append_attribute("id") = id.c_str();
  return style;
}

void AddFill(pugi::xml_node document, const std::string& id, const std::string& color) {
  pugi::xml_node style = AddStyle(document, id);
  Write(style.append_child("LineStyle"), "color", color);
  Write(style.append_child("PolyStyle"), "color", color);
}

void AddStyles(pugi::xml_node document, size_t flights) {
  for (size_t i = 0; i < flights; ++i) {
    const Rgb color = FlightColor(static_cast<int>(i));
    pugi::xml_node style = AddStyle(document, fmt::format("flight{}", i));
    pugi::xml_node line = style.append_child("LineStyle");
    Write(line, "color", KmlColor(color, 255));
    Write(line, "width", "2");
    pugi::xml_node icon = style.append_child("IconStyle");
    Write(icon, "color", KmlColor(color, 255));
    Write(icon, "scale", "0.5");
    Write(icon.append_child("Icon"), "href",
          "http://maps.google.com/mapfiles/kml/shapes/camera.png");
    Write(style.append_child("LabelStyle"), "scale", "0");
  }
  for (int i = 0; i <= kQualityClasses; ++i) {
    AddFill(document, fmt::format("quality{}", i),
            KmlColor(QualityColor(static_cast<double>(i) / kQualityClasses), 220));
  }
  AddFill(document, "building", KmlColor({200, 200, 200}, 160));
  AddFill(document, "nofly", KmlColor({190, 20, 20}, 110));
}

pugi::xml_node AddPlacemark(pugi::xml_node folder, const std::string& name,
                            const std::string& style) {
  pugi::xml_node placemark = folder.append_child("Placemark");
  Write(placemark, "name", name);
  Write(placemark, "styleUrl", "#" + style);
  return placemark;
}

pugi::xml_node AddData(pugi::xml_node placemark) {
  return placemark.append_child("ExtendedData");
}
void AddDatum(pugi::xml_node data, const char* name, const std::string& value) {
  pugi::xml_node datum = data.append_child("Data");
  datum.append_attribute("name") = name;
  Write(datum, "value", value);
}

void AddView(pugi::xml_node folder, const PlannedView& view, const KmlWriter& writer) {
  pugi::xml_node placemark = AddPlacemark(folder, view.id, fmt::format("flight{}", view.flight));
  pugi::xml_node data = AddData(placemark);
  std::vector<std::string> facades;
  for (const PlannedTarget& target : view.targets) facades.push_back(target.facade);
  AddDatum(data, "kind", std::string(Name(view.kind)));
  AddDatum(data, "heading", fmt::format("{:.2f}", view.yaw_deg));
  AddDatum(data, "pitch", fmt::format("{:.2f}", view.pitch_deg));
  AddDatum(data, "hover", fmt::format("{}", view.hover));
  AddDatum(data, "order", fmt::format("{}", view.order));
  AddDatum(data, "facades", fmt::format("{}", fmt::join(facades, " ")));
  pugi::xml_node point = placemark.append_child("Point");
  Write(point, "altitudeMode", writer.altitude_mode);
  Write(point, "coordinates", writer.Coordinate(view.position_m));
}

void AddHomes(pugi::xml_node document, const KmlWriter& writer) {
  const std::vector<Eigen::Vector3d> homes = writer.plan.Homes();
  for (size_t i = 0; i < homes.size(); ++i) {
    pugi::xml_node home = document.append_child("Placemark");
    Write(home, "name", homes.size() == 1 ? "Home" : fmt::format("Home {}", i + 1));
    pugi::xml_node point = home.append_child("Point");
    Write(point, "altitudeMode", writer.altitude_mode);
    Write(point, "coordinates", writer.Coordinate(homes[i]));
  }
}

void AddFlight(pugi::xml_node parent, size_t index, const KmlWriter& writer) {
  const PlannedFlight& flight = writer.plan.flights[index];
  pugi::xml_node folder = AddFolder(parent, fmt::format("Flight {}", index + 1));
  pugi::xml_node path = AddPlacemark(folder, fmt::format("Path of flight {}", index + 1),
                                     fmt::format("flight{}", index));
  Write(path, "description",
        fmt::format("{:.0f} m, {:.1f} min, {:.0f} % of a battery", flight.length_m, flight.time_min,
                    flight.battery_percent));
  pugi::xml_node line = path.append_child("LineString");
  Write(line, "altitudeMode", writer.altitude_mode);
  std::vector<std::string> points;
  for (const PlannedWaypoint& waypoint : flight.waypoints) {
    points.push_back(writer.Coordinate(waypoint.position_m));
  }
  Write(line, "coordinates", fmt::format("{}", fmt::join(points, " ")));
  for (const PlannedView& view : writer.plan.views) {
    if (static_cast<size_t>(view.flight) == index) AddView(folder, view, writer);
  }
}

void AddFacade(pugi::xml_node folder, const PlannedFacade& facade, const KmlWriter& writer) {
  const double share = facade.predicted.sum() / kBestQuality;
  pugi::xml_node placemark = AddPlacemark(
      folder, facade.id, fmt::format("quality{}", std::lround(share * kQualityClasses)));
  pugi::xml_node data = AddData(placemark);
  AddDatum(data, "q_s", fmt::format("{:.3f}", facade.predicted.q_s));
  AddDatum(data, "q_d", fmt::format("{:.3f}", facade.predicted.q_d));
  AddDatum(data, "q_u", fmt::format("{:.3f}", facade.predicted.q_u));
  AddDatum(data, "q_c", fmt::format("{:.3f}", facade.predicted.q_c));
  AddDatum(data, "views", fmt::format("{}", facade.views.size()));
  pugi::xml_node polygon = placemark.append_child("Polygon");
  Write(polygon, "altitudeMode", writer.altitude_mode);
  const auto corner = [](const Eigen::Vector2d& end, double z) {
    return Eigen::Vector3d(end.x(), end.y(), z);
  };
  const std::vector<Eigen::Vector3d> wall = {
      corner(facade.a_m, facade.z_m.from_m), corner(facade.b_m, facade.z_m.from_m),
      corner(facade.b_m, facade.z_m.to_m), corner(facade.a_m, facade.z_m.to_m)};
  Write(polygon.append_child("outerBoundaryIs").append_child("LinearRing"), "coordinates",
        writer.Ring(wall));
}

using Rings = std::vector<std::vector<Eigen::Vector2d>>;

// An outline lifted to z, with walls down to the ground.
void AddBlock(pugi::xml_node placemark, const Rings& rings, double z, const KmlWriter& writer) {
  pugi::xml_node polygon = placemark.append_child("Polygon");
  Write(polygon, "extrude", "1");
  Write(polygon, "altitudeMode", writer.altitude_mode);
  const char* boundary = "outerBoundaryIs";
  for (const auto& ring : rings) {
    std::vector<Eigen::Vector3d> lifted;
    lifted.reserve(ring.size());
    for (const Eigen::Vector2d& corner : ring) lifted.emplace_back(corner.x(), corner.y(), z);
    Write(polygon.append_child(boundary).append_child("LinearRing"), "coordinates",
          writer.Ring(lifted));
    boundary = "innerBoundaryIs";
  }
}

}  // namespace

std::string PlanKml(const Plan& plan) {
  // Without a terrain z counts from the ground, and the plan's height system is unknown.
  const KmlWriter writer = {plan, plan.origin.height_m == 0 ? "relativeToGround" : "absolute"};
  pugi::xml_document xml;
  pugi::xml_node declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node kml = xml.append_child("kml");
  kml.append_attribute("xmlns") = "http://www.opengis.net/kml/2.2";
  pugi::xml_node document = kml.append_child("Document");
  Write(document, "name", fmt::format("Flight plan ({})", plan.method));
  AddStyles(document, plan.flights.size());
  AddHomes(document, writer);
  for (size_t i = 0; i < plan.flights.size(); ++i) AddFlight(document, i, writer);
  pugi::xml_node facades = AddFolder(document, "Facades");
  for (const PlannedFacade& facade : plan.facades) AddFacade(facades, facade, writer);
  pugi::xml_node buildings = AddFolder(document, "Buildings");
  for (const PlannedFootprint& footprint : plan.footprints) {
    AddBlock(AddPlacemark(buildings, footprint.building, "building"), footprint.rings_m,
             footprint.z_m.to_m, writer);
  }
  pugi::xml_node no_fly = AddFolder(document, "No-fly areas");
  const std::vector<Polygon> zones = PolygonsOf(plan.no_fly_m);
  for (size_t i = 0; i < zones.size(); ++i) {
    AddBlock(AddPlacemark(no_fly, fmt::format("No-fly area {}", i + 1), "nofly"), zones[i].rings,
             plan.safe_altitude_m, writer);
  }
  struct Text : pugi::xml_writer {
    std::string text;
    void write(const void* data, size_t size) override {
      text.append(static_cast<const char*>(data), size);
    }
  } text;
  xml.save(text, " ");
  return std::move(text.text);
}

}  // namespace stucco::plan
