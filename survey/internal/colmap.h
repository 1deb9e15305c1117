// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "survey/reconstruction.h"

namespace stucco::internal {

// The two encodings of a COLMAP model in one folder. Readers check what the format can say; whether
// the ids fit together is checked by ReadColmapModel.
Reconstruction ReadColmapBinary(const std::filesystem::path& folder);
Reconstruction ReadColmapText(const std::filesystem::path& folder);

// Adds one entry; an id that is there already is an error. `where` (file and position) is for the
// message.
void AddCamera(Camera camera, const std::string& where, Reconstruction& reconstruction);
void AddPhoto(RegisteredImage photo, const std::string& where, Reconstruction& reconstruction);
void AddPoint(TrackPoint point, const std::string& where, Reconstruction& reconstruction);

// The rotation stored as w x y z, which other programs round; throws when it is no rotation at all.
Eigen::Quaterniond UnitRotation(double w, double x, double y, double z, const std::string& where);

[[noreturn]] void FailColmap(const std::string& where, const std::string& reason);

// For a model that is none of camera.h's.
[[noreturn]] void FailCameraModel(const std::string& where, const std::string& model);

}  // namespace stucco::internal
