// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string_view>

namespace stucco {

// A line of OpenSfM's tracks.csv; image coordinates are from the middle of the photo, over its
// longer side.
struct TrackLine {
  std::string_view photo;
  std::string_view track;
  Eigen::Vector2d normalized;
};

// Calls `take` for every line, in order. Reads versions 0 to 2. Throws Error (kBadInput) with the
// line.
void ReadOpenSfmTracks(const std::filesystem::path& file,
                       const std::function<void(const TrackLine&)>& take);

}  // namespace stucco
