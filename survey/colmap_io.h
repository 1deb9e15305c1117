// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/reconstruction.h"

namespace stucco {

// COLMAP's sparse model: cameras, images and points3D as .bin or .txt in one folder
// (https://colmap.github.io/format.html). Photo ids are the COLMAP image ids.

// Reads the binary files when they are there, else the text files. Throws Error (kBadInput) with
// file, position and reason on anything malformed, and on camera models other than those of
// camera.h.
Reconstruction ReadColmapModel(const std::filesystem::path& folder);

// Requires a reconstruction without problems (reconstruction.h). Creates the folder where needed.
// Text is written with 17 significant digits: it reads back exactly.
void WriteColmapText(const Reconstruction& reconstruction, const std::filesystem::path& folder);
void WriteColmapBinary(const Reconstruction& reconstruction, const std::filesystem::path& folder);

}  // namespace stucco
