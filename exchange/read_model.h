// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "exchange/exchanged_model.h"
#include "exchange/photo_index.h"

namespace stucco {

enum class ModelFormat { kColmap, kBundler, kBlocksExchange, kOpenSfm, kRealityCapture };

struct RecognizedModel {
  ModelFormat format = ModelFormat::kColmap;
  std::filesystem::path path;  // what to read: the file, or the folder where that is the model
};

// What a file or a folder holds, by its contents and not by its name. Throws Error (kBadInput) for
// what is no model of these formats, saying what it is where that is known, and for a folder that
// holds several.
RecognizedModel RecognizeModel(const std::filesystem::path& path);

ExchangedModel ReadModel(const RecognizedModel& source, const PhotoIndex& photos);

}  // namespace stucco
