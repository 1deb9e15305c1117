// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stucco {

// What is exported, and whereto.
struct ExportRequest {
  std::string format;
  std::filesystem::path out;
  bool overwrite = false;
  std::string crs = {};        // "EPSG:2056", for "cityjson" only; empty: the survey's own frame
  std::string epoch = {};      // for textured models: as this one shows them, alone; empty: as the
                               // survey does, where the format can with all epochs beside it
  int threads = 0;             // 0: as survey.toml says
  double memory_limit_gb = 0;  // likewise
};

struct ExportReport {
  std::filesystem::path pictures_folder;  // beside `out`, which names what is in it; empty: none
  int pictures = 0;                       // in that folder
  std::vector<std::string> notes;         // for people
};

}  // namespace stucco
