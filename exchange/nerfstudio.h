// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "exchange/model_to_write.h"

namespace stucco {

// A folder for nerfstudio and programs that read its format: transforms.json (poses as
// world_from_cam with OpenGL's camera axes, x right, y up, z back; lens model OPENCV) and
// sparse_pc.ply. Its world has z up: `applied_transform`, 3 x 4, is what took ours there. The
// lens stands once where all photos share it, else with each photo. Throws Error (kBadInput) for a
// lens that the format does not know (k4, k5, k6).
void WriteNerfstudio(const ModelToWrite& what, const std::filesystem::path& folder);

}  // namespace stucco
