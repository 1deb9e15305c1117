// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "exchange/exchanged_model.h"
#include "exchange/photo_index.h"

namespace stucco {

// Bundler v0.3 (bundle.out, as VisualSFM, OpenMVG, Metashape and others write it, too), with the
// list of its photos beside it: list.txt or bundle.out.list.txt. Cameras look along -z with y up,
// image coordinates count from the middle of the picture, up. The file does not say how large its
// pictures are: pictures that lie where the list says count, else those of the survey. Throws Error
// (kBadInput) with the line.
ExchangedModel ReadBundler(const std::filesystem::path& file, const PhotoIndex& photos);

}  // namespace stucco
