// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/surface_model.h"

namespace stucco {

// The triangles of a glTF, GLB or OBJ, as one object; what is mirrored is turned back. Throws Error
// (kBadInput).
SurfaceModel ReadMesh(const std::filesystem::path& path, bool y_up);

}  // namespace stucco
