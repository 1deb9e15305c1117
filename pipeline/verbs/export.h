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

struct ExportReport {
  std::filesystem::path pictures_folder;  // beside `out`, which names what is in it; empty: none
  int pictures = 0;                       // in that folder
  std::vector<std::string> notes;         // for people
};

// Writes a survey's result in another program's format: a file for "blocksexchange", "glb", "ply"
// and "cityjson", a folder for the others. With "cityjson" go the pictures of its surfaces once
// there are textures, into a folder named after the file. Throws Error: kUsage for an unknown
// format or coordinate system, kBadInput when the stage has not run or `out`, or the folder for
// pictures, exists already (unless `overwrite`).
ExportReport ExportSurvey(const std::filesystem::path& survey, const ExportRequest& request,
                          const StageTable& table);

}  // namespace stucco
