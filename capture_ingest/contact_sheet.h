// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "capture_ingest/photo_record.h"
#include "survey/image.h"

namespace stucco {

// Thumbnails with file names, eight in a row, in the order of the records; unusable photos are
// framed red and say why. More photos than fit on one picture are thinned out evenly, never the
// unusable ones.
Image ContactSheet(std::span<const PhotoRecord> records);

}  // namespace stucco
