// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/write_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <filesystem>
#include <string>

#include "survey/colmap_io.h"

namespace stucco {
namespace {

// What the user should know of the result.
void Note(const Calibration& calibration, Progress& progress) {
  progress.Note(fmt::format("{} of {} photos placed, {} points, mean reprojection error {:.2f} px",
                            calibration.photos_posed, calibration.photos_total, calibration.points,
                            calibration.reprojection_error_px));
  if (calibration.check_rms) {
    progress.Note(
        fmt::format("{} check points: {:.3f} m horizontal, {:.3f} m vertical (root mean "
                    "square)",
                    calibration.check_rms->points, calibration.check_rms->horizontal_rms_m,
                    calibration.check_rms->vertical_rms_m));
  }
  if (calibration.prior_rms_horizontal_m < 0) return;
  progress.Note(
      fmt::format("residual to recorded positions: {:.3f} m horizontal, {:.3f} m "
                  "vertical (root mean square)",
                  calibration.prior_rms_horizontal_m, calibration.prior_rms_vertical_m));
}

void WriteModel(const Reconstruction& model, const std::filesystem::path& folder) {
  WriteColmapBinary(model, folder);
  WriteColmapText(model, folder);
}

}  // namespace

void WriteResults(const SummaryInput& summary, const Georef& georef, Calibration calibration,
                  const StageContext& context) {
  assert(summary.parts != nullptr);
  const std::vector<uint32_t> ids = PhotoIds(summary);
  const std::filesystem::path sparse = context.out / "sparse";
  WriteModel(ToReconstruction(summary.scene, ids), sparse / "0");
  for (const ScenePart& part : summary.parts->others) {
    if (part.model > 0) {
      WriteModel(ToReconstruction(part.scene, ids), sparse / std::to_string(part.model));
    }
  }
  WriteGeoref(georef, context.out / "georef.json");
  for (const CalibratedCamera& camera : calibration.cameras) {
    if (!camera.held.empty() && camera.held.size() < camera.names.size()) {
      calibration.findings.push_back(
          fmt::format("{}: the photos do not determine {}; kept near the expected value",
                      camera.label, fmt::join(camera.held, ", ")));
    }
  }
  WriteCalibration(calibration, context.out / "calibration.json");
  Note(calibration, *context.progress);
}

}  // namespace stucco
