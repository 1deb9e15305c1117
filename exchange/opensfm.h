// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "exchange/exchanged_model.h"
#include "exchange/photo_index.h"

namespace stucco {

// OpenSfM's reconstruction.json, also that of OpenDroneMap. Of several reconstructions the one with
// the most photos counts. Its frame is east, north, up of the reference in it or in
// reference_lla.json beside it. Which photos see a point is in tracks.csv beside it; without that
// file there are no points. Throws Error (kBadInput) with the field.
ExchangedModel ReadOpenSfm(const std::filesystem::path& file, const PhotoIndex& photos);

}  // namespace stucco
