// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/verbs/export_request.h"

namespace stucco {

// The planar model as the stage proxy wrote it.
inline constexpr char kCityJsonFile[] = "proxy/proxy.city.json";

// Writes the model as CityJSON, in `request.crs` where it names one. Where the survey has textures
// the file names the pictures of its surfaces, which are copied into a folder beside it that is
// called like the file ("castle.city.json" has "castle_appearance"). Requires kCityJsonFile. Throws
// Error as ExportSurvey does, also where that folder is not free or the file cannot name it.
ExportReport ExportCity(const std::filesystem::path& survey, const ExportRequest& request);

}  // namespace stucco
