// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "site/site.h"
#include "survey/plan_frame.h"
#include "tests/survey/temporary_folder.h"

namespace stucco::plan {

// A folder of its own for the files of one test, removed with it.
// Where made maps lie: metres east and north of it are positions in the frame of OriginNear.
inline constexpr Geodetic kMadePlace{50.1, 14.4};

struct MadeBuilding {
  Polygon outline;  // metres around kMadePlace
  std::map<std::string, std::string> attributes = {};
};

// Throws the message of GDAL when a file cannot be written.
void WriteGeoJson(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings);
// Through an OGR driver ("GPKG", "ESRI Shapefile") in a coordinate system; "" writes the metres of
// UTM zone 33 and names no system.
void WriteWithOgr(const std::filesystem::path& path, const std::string& driver,
                  const std::string& crs, const std::vector<MadeBuilding>& buildings);
// Closed ways, and multipolygon relations for outlines with holes; attributes are tags.
void WriteOsm(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings);
// The same without relations, as PBF.
void WriteOsmPbf(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings);
// Prisms of `height` metres in EPSG:32633 as CityJSON 2.0.
void WriteCityJson(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings);
// A GeoTIFF of heights around kMadePlace in a coordinate system: `pixels` x `pixels`, each `step`
// units of the system wide. `height` takes metres east and north of kMadePlace; NaN: no data.
struct MadeDem {
  std::string crs = "EPSG:32633";
  int pixels = 800;
  double step = 1;
};
void WriteDem(const std::filesystem::path& path, const MadeDem& dem,
              const std::function<double(double, double)>& height);

// The message and the remedy of the Error that `call` throws, or "" when it throws none.
std::string Complaint(const std::function<void()>& call);

}  // namespace stucco::plan
