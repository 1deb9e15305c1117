// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/engine/platform.h"
#include "pipeline/engine/stages.h"

namespace stucco {

// A scan from above and the map that its buildings are made on. Empty texts: not given.
struct ScanRequest {
  std::filesystem::path cloud;  // PLY
  std::filesystem::path map;    // building footprints; heights are not needed
  std::string crs;              // of the cloud, "EPSG:2056"; empty: that of map_crs
  std::string map_crs;          // where the map names none; empty: that of the cloud
};

struct ScanImportReport {
  uint64_t points = 0;
  size_t buildings = 0;  // footprints of the map
  size_t reached = 0;    // of these, in the box of the cloud
  std::vector<std::string> notes;
};

// Takes a bare PLY cloud in a coordinate system on the earth, heights in its unit, and a map of
// footprints as a survey without photos, so that `run --until proxy` makes closed buildings of it:
// writes plan/plan.json (no views), an empty ingest and calib with the frame (east, north, up of
// the map's middle), and dense, with manifests that say where they came from. A folder that is no
// survey yet becomes one. Throws Error: kUsage without a coordinate system, kBadInput when a file
// is damaged, the survey has photos, or no footprint lies in the cloud; nothing is written then.
ScanImportReport ImportScan(const std::filesystem::path& survey, const ScanRequest& request,
                            const StageTable& table, const Platform& platform);

}  // namespace stucco
