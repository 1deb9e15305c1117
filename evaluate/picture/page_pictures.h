// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "evaluate/picture/flip.h"
#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

// Names relative to the output folder.
struct PagePictures {
  std::string truth;
  std::string result;
  std::string error;
};

// "pictures/0012-B0001_F03": the number keeps names apart whose letters no file name can hold.
std::string PictureStem(size_t number, std::string_view id);

// Takes the pictures of an evaluation before out of the output folder; other files stay.
void RemovePagePictures(const std::filesystem::path& output);

// Truth, result and FLIP's map as JPEG of at most 1400 pixels a side, grey outside the mask.
PagePictures WritePagePictures(const PicturePair& pair, const FlipMap& flip,
                               const std::filesystem::path& output, const std::string& stem);

}  // namespace stucco::evaluate
