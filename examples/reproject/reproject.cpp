// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints how well the points of a COLMAP model project onto the pixels they were measured at:
//   reproject my-survey/calib/sparse/0
#include <cstdio>

#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/reconstruction.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: reproject FOLDER_OF_A_COLMAP_MODEL\n");
    return 2;
  }
  try {
    const stucco::Reconstruction model = stucco::ReadColmapModel(argv[1]);
    std::printf("%zu photos, %zu points, mean track length %.2f, mean reprojection error %.3f px\n",
                model.photos.size(), model.points.size(), stucco::MeanTrackLength(model),
                stucco::MeanReprojectionError(model));
  } catch (const stucco::Error& error) {
    std::fprintf(stderr, "reproject: %s\n%s\n", error.what(), error.remedy().c_str());
    return 3;
  }
  return 0;
}
