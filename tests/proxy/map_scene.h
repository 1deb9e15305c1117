// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "proxy/cloud/input.h"
#include "proxy/options/findings.h"
#include "proxy/options/proxy_options.h"
#include "survey/geometry2d.h"
#include "survey/plan.h"
#include "survey/proxy.h"
#include "tests/proxy/scene.h"

namespace stucco::test {

// A building of a made map, or one of its parts, which have its id: rings as plans have them, the
// outer one counter-clockwise.
struct MapEntry {
  std::string id;
  std::vector<Ring> rings;
  double top = 6;
  double foot = 0;
};

Ring Rectangle(double x0, double y0, double x1, double y1);
// The other way round: a courtyard.
Ring Court(double x0, double y0, double x1, double y1);

// A plan with these buildings whose frame is that of MapGeoref; every edge is a facade.
Plan PlanOf(const std::vector<MapEntry>& entries);
Georef MapGeoref();

// The same map, turned counter-clockwise about the origin and shifted.
std::vector<MapEntry> Displaced(std::vector<MapEntry> entries, double turn_deg,
                                const Eigen::Vector2d& shift);

// Walls from the ground to the roof's height over each corner, and the roof.
House FlatHouse(const Ring& ring, double height);
// A hip roof of 45 degrees over a rectangle that is longer in x.
House HipHouse(double length, double width, double height);
// Hip roofs of 45 degrees over the two wings of an L, 6 m wide; the valley between the wings lies
// in line with the hip of the corner opposite to it.
House HipLHouse(double height);
Ring HipLOutline();

// Dense enough for what a map leaves out.
inline constexpr CaptureOptions kDenseCapture{.spacing = 0.15, .noise = 0.02};

// What is made of a cloud with a map.
struct MadeModel {
  Proxy proxy;
  ProxyFindings findings;
};
MadeModel MakeModel(const Captured& captured, const std::vector<MapEntry>& map,
                    const ProxyOptions& options = {});
// The building of the map, closed, or a failed test.
const Building& ClosedIn(const MadeModel& made, const std::string& id);
std::vector<const Facet*> OfClass(const Building& building, FacetClass facet_class);
double TopOf(const Facet& facet);

// Enclosed volume and the area of one class; facets must be closed for the volume.
double VolumeOf(const Building& building);
double AreaOf(const Building& building, FacetClass facet_class);
const Building* Find(const Proxy& proxy, const std::string& id);

}  // namespace stucco::test
