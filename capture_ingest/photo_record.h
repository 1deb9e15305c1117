// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture_ingest/tags.h"
#include "survey/captures.h"
#include "survey/photo_files.h"
#include "survey/stage.h"

namespace stucco {

// A photo on its way through ingest.
struct PhotoRecord {
  CapturedPhoto photo;
  Tags tags;
  std::vector<std::string> doubts;  // values of this photo that were not believed
  std::string thumbnail;            // JPEG; empty when the picture cannot be decoded
};

// Hash, metadata and health of one file. Whatever is wrong with the file ends in the record, never
// in an exception.
PhotoRecord InspectPhoto(const PhotoFile& file, int min_side_px, const StageContext& context);

// Makes a photo unusable; `why` is a reason and, after a semicolon, what to do.
void Reject(PhotoRecord& record, std::string why);

// Files with equal content: the first path is used, the others are not.
void RejectDuplicates(std::vector<PhotoRecord>& records);

}  // namespace stucco
