// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/engine/stages.h"
#include "pipeline/verbs/export_request.h"  // IWYU pragma: export

namespace stucco {

struct ExportFormat {
  std::string name;   // "colmap-txt"
  std::string help;   // what comes out, for people
  std::string stage;  // whose outputs it takes
};

const std::vector<ExportFormat>& ExportFormats();

// Writes a survey's result in another program's format: a file for "blocksexchange", "glb", "ply"
// and "cityjson", a folder for the others. With "cityjson" go the pictures of its surfaces once
// there are textures, into a folder named after the file. "glb" and "cityjson" have the survey's
// epochs as further looks. Throws Error: kUsage for an unknown format or coordinate system,
// kBadInput when the stage has not run, there is no such epoch or `out`, or the folder for
// pictures, exists already (unless `overwrite`).
ExportReport ExportSurvey(const std::filesystem::path& survey, const ExportRequest& request,
                          const StageTable& table);

}  // namespace stucco
