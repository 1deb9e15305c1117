// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "report/facet_rows.h"

namespace stucco {

// A picture inside the page.
struct EmbeddedPicture {
  std::string uri;  // "data:image/jpeg;base64,..."; empty: none
  int width_px = 0;
  int height_px = 0;
};

// What the page shows of one facade.
struct FacetPictures {
  EmbeddedPicture thumbnail;
  EmbeddedPicture texture;
  EmbeddedPicture labels;            // a colour per photo, see LabelColor
  std::vector<double> photo_shares;  // of the painted texels, in the order of the facet's photos
  std::string problem;               // why a picture that should be there is not; empty: none
};

// "#4477aa": the colour of the i-th photo of a facet in its label map; colours repeat after twelve.
std::string LabelColor(size_t photo);
inline constexpr char kInpaintedColor[] = "#b9b9b9";

// Reads the picture and the label map below `texture_folder`. What is missing or damaged leaves its
// picture empty and names the problem; never throws for what the files hold.
FacetPictures MakeFacetPictures(const FacetRow& row, const std::filesystem::path& texture_folder,
                                int picture_px);

// One picture below `folder`, shrunk. What is missing or damaged is empty and named in `problem`.
EmbeddedPicture MakePicture(const std::filesystem::path& folder, const std::string& name,
                            int picture_px, std::string& problem);

// How many of `threads` may make pictures at once within the memory limit: textures are read in
// full size, whose bytes follow from textures.json.
int PictureThreads(const std::vector<FacetRow>& rows, int threads, uint64_t memory_limit_bytes);

// Longer side of the pictures so that the page of `count` facades stays of a size that browsers
// open at once: `wanted_px`, or less when there are many.
int PictureSide_px(int wanted_px, size_t count);

}  // namespace stucco
