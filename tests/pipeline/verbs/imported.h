// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "pipeline/verbs/import.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {

inline ImportReport ImportInto(FakeSurvey& fake, const std::filesystem::path& model) {
  Console console = Console::ForStderr(Verbosity::kQuiet);
  return ImportModel(fake.survey, model, fake.table, console, fake.platform);
}

// A COLMAP text model of one pinhole camera of width x height pixels: photos in a row along x,
// looking along z, and one point, 10 before them, that all of them see.
inline void WriteModel(const std::filesystem::path& folder, const std::vector<std::string>& photos,
                       int width_px, int height_px) {
  std::filesystem::create_directories(folder);
  const double x_px = width_px / 2.0, y_px = height_px / 2.0;
  std::ofstream(folder / "cameras.txt")
      << "1 PINHOLE " << width_px << " " << height_px << " " << width_px << " " << width_px << " "
      << x_px << " " << y_px << "\n";
  std::ofstream images(folder / "images.txt");
  std::ofstream points(folder / "points3D.txt");
  points << "1 4 0 10 200 200 200 0.1";
  for (size_t i = 0; i < photos.size(); ++i) {
    const double x = static_cast<double>(i) + 1;
    images << i + 1 << " 1 0 0 0 " << -x << " 0 0 1 " << photos[i] << "\n"
           << x_px + width_px * (4 - x) / 10 << " " << y_px << " 1\n";
    points << " " << i + 1 << " 0";
  }
  points << "\n";
}

}  // namespace stucco
