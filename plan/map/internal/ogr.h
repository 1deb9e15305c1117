// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>
#include <ogr_geometry.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "site/site.h"

namespace stucco::plan::internal {

// Opens with GDAL_OF_* flags and "KEY=VALUE" options of the driver. Throws Error (kBadInput).
GDALDatasetUniquePtr OpenDataset(const std::filesystem::path& path, unsigned flags,
                                 const std::vector<std::string>& options = {});

std::unique_ptr<OGRPolygon> ToOgr(const Polygon& polygon);
std::unique_ptr<OGRMultiPolygon> ToOgr(const std::vector<Polygon>& polygons);

// The polygons of a geometry of any kind, curves as chords, points and lines left out; rings as
// they come, without the repeated corner at their end.
std::vector<Polygon> RawPolygons(const OGRGeometry& geometry);
// Its points and lines, each as the only ring of a polygon: a point has one corner.
std::vector<Polygon> RawLines(const OGRGeometry& geometry);
// Whether the end of a ring is not its start.
bool HasOpenRing(const OGRGeometry& geometry);

// The same for valid geometries: the outer ring counter-clockwise, holes clockwise.
std::vector<Polygon> OrientedPolygons(const OGRGeometry& geometry);

// Self-crossings and the like resolved (GEOS); everything that either lobe of a crossing holds
// stays.
std::unique_ptr<OGRGeometry> MadeValid(const OGRGeometry& geometry);

// Of valid polygons. Empty results are empty lists.
std::vector<Polygon> Union(const std::vector<Polygon>& polygons);
std::vector<Polygon> Difference(const Polygon& from, const std::vector<Polygon>& what);
std::vector<Polygon> Intersection(const Polygon& a, const Polygon& b);
// What is at least nearer than `radius_m` to a line, or to a point where it has one only.
std::vector<Polygon> Around(const Ring& line, double radius_m);
// A polygon and about what is nearer than `radius_m` to it.
std::vector<Polygon> Around(const Polygon& polygon, double radius_m);
double SharedArea(const Polygon& a, const Polygon& b);
bool InteriorsMeet(const Polygon& a, const Polygon& b);

}  // namespace stucco::plan::internal
