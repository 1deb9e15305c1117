// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "exchange/exchanged_model.h"
#include "exchange/model_to_write.h"
#include "exchange/photo_index.h"

namespace stucco {

// BlocksExchange XML, which Bentley calls CC Orientations (versions 2.1 and 3.x; ContextCapture and
// its successors, Metashape, DJI Terra and others). Pixels count from the centre of the upper-left
// pixel; P1 and P2 are Brown's, the other way round than OpenCV's.

// Of several blocks the one with the most posed photos counts. Throws Error (kBadInput) with the
// element.
ExchangedModel ReadBlocksExchange(const std::filesystem::path& path, const PhotoIndex& photos);

// Version 2.1, which most programs read. Paths of photos are relative to the file. An "enu" frame
// is written as "ENU:latitude,longitude", heights above the zero of the georef's; any other without
// a coordinate system. Throws Error (kBadInput) for a lens that the format does not know (k4, k5,
// k6).
void WriteBlocksExchange(const ModelToWrite& what, const std::filesystem::path& file);

}  // namespace stucco
