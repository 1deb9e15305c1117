// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulate/flight/flight_folder.h"

namespace stucco::simulate {

// Where a photo and its depth map lie.
std::filesystem::path PathOfPhoto(const std::filesystem::path& survey, const FlownPhoto& photo);
std::filesystem::path PathOfDepth(const std::filesystem::path& survey, const FlownPhoto& photo);

// Writes nothing. Throws Error (kBadInput) where the photo folder holds photos of which no flight
// knows, or the truth files without a flight. Folders may be missing.
void RequireFreeStore(const std::filesystem::path& survey);

// Makes the folders and writes the flight's truth. Photos of the same flight stay; those of another
// one are removed, with a note. Where RequireFreeStore throws, so does this, having changed
// nothing.
std::vector<std::string> OpenPhotoStore(const std::filesystem::path& survey, const Flight& flight);

}  // namespace stucco::simulate
