// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/engine/stages.h"

namespace stucco {

struct ExportFormat {
  std::string name;   // "colmap-txt"
  std::string help;   // what comes out, for people
  std::string stage;  // whose outputs it takes
};

const std::vector<ExportFormat>& ExportFormats();

// What is exported, and whereto.
struct ExportRequest {
  std::string format;
  std::filesystem::path out;
  bool overwrite = false;
  std::string crs = {};  // "EPSG:2056", for "cityjson" only; empty: the survey's own frame
};

// Writes a survey's result in another program's format: a file for "blocksexchange", "glb", "ply"
// and "cityjson", a folder for the others. Throws Error: kUsage for an unknown format or coordinate
// system, kBadInput when the stage has not run or `out` exists already (unless `overwrite`).
void ExportSurvey(const std::filesystem::path& survey, const ExportRequest& request,
                  const StageTable& table);

}  // namespace stucco
