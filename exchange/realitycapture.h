// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "exchange/exchanged_model.h"
#include "exchange/photo_index.h"

namespace stucco {

// The XMP files below a folder that hold what RealityCapture (RealityScan) knows of a photo; those
// of other programs are left out. By path.
std::vector<std::filesystem::path> FindRealityCaptureFiles(const std::filesystem::path& folder);

// XMP files of RealityCapture below a folder, each of the photo of the same name. Lengths are over
// the longer side of the photo, which only the photo itself tells. They hold no points, and do not
// say what their coordinate system is. Throws Error (kBadInput) with the file and the field.
ExchangedModel ReadRealityCapture(const std::filesystem::path& folder, const PhotoIndex& photos);

}  // namespace stucco
