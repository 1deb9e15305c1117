// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/surface_model.h"

namespace stucco {

// The axis of a mesh that points up. Files do not say: glTF's is y by its standard; OBJ of surveys
// have z up, of modellers y.
enum class UpAxis { kOfFormat, kY, kZ };

// Whether a file is a model of surfaces: CityJSON by its contents, glTF, GLB and OBJ by name.
bool IsSurfaceModel(const std::filesystem::path& path);

// Reads one, x east, y north and z up (y up: x east, z south). Of CityJSON the most detailed
// geometry of buildings and of the ground; parts belong to their building. Materials and pictures
// are not read. Throws Error (kBadInput): damaged, without surfaces, or a mesh so far from its
// origin that its coordinates of single precision are not exact.
SurfaceModel ReadSurfaceModel(const std::filesystem::path& path, UpAxis up);

}  // namespace stucco
