// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace stucco {

// Where things are in a survey folder (docs/formats.md).
inline constexpr char kSettingsFile[] = "survey.toml";
inline constexpr char kGroundControlFile[] = "gcp_list.txt";
inline constexpr char kPlanFolder[] = "plan";
inline constexpr char kPlanFile[] = "plan/plan.json";
inline constexpr char kCapturesFile[] = "ingest/captures.json";
inline constexpr char kSparseFolder[] = "calib/sparse/0";
inline constexpr char kGeorefFile[] = "calib/georef.json";
inline constexpr char kCalibrationFile[] = "calib/calibration.json";
inline constexpr char kCloudFile[] = "dense/cloud.ply";
inline constexpr char kFacetsFile[] = "proxy/facets.json";
inline constexpr char kElevationsFolder[] = "proxy/elevations";
inline constexpr char kTexturesFile[] = "texture/textures.json";
inline constexpr char kReportFile[] = "report/report.html";
inline constexpr char kEpochsFolder[] = "epochs";
inline constexpr char kEpochFile[] = "retexture.json";  // of each of its folders
inline constexpr char kWorkFolder[] = ".stucco";
// And a hyphen and a number: of an output that was not the program's own and was moved aside.
inline constexpr char kOldSuffix[] = ".old";

}  // namespace stucco
