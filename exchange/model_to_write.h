// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "survey/georef.h"
#include "survey/reconstruction.h"

namespace stucco {

// Poses for another program. Requires a model without problems.
struct ModelToWrite {
  const Reconstruction& model;
  const Georef& georef;
  const std::filesystem::path&
      photos;  // the folder that the names of the model's photos count from
};

// The path of a photo as a file in `folder` (empty: the current one) names it: relative where that
// is possible, so that both can be moved together, with '/' between folders.
std::string PathFrom(const std::filesystem::path& folder, const ModelToWrite& what,
                     const RegisteredImage& photo);

}  // namespace stucco
