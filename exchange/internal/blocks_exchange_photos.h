// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "exchange/exchanged_model.h"
#include "exchange/internal/xml_file.h"
#include "exchange/photo_index.h"

namespace stucco {

// The origin of pixel coordinates in these files is the centre of the upper-left pixel.
inline constexpr double kPixelCentre = 0.5;

// The photos of a block with their ids in the file.
struct BlockPhotos {
  std::map<int64_t, PhotoId> posed;
  std::set<int64_t> all;
  std::set<std::string> srs_ids;  // that the poses are in; "" for none
};

// How many photos of a block have a pose.
int CountPosed(const pugi::xml_node& block);

// Adds cameras and posed photos of a block to the result.
BlockPhotos ReadBlockPhotos(const XmlFile& file, const pugi::xml_node& block,
                            const PhotoIndex& photos, ExchangedModel& result);

}  // namespace stucco
