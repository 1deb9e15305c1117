// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/opensfm_tracks.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/text.h"

namespace stucco {
namespace {

// Photo, track, feature, x, y; what follows differs by version.
constexpr size_t kFields = 5;

std::array<std::string_view, kFields> SplitAtTabs(std::string_view line) {
  std::array<std::string_view, kFields> fields;
  for (std::string_view& field : fields) {
    const size_t tab = line.find('\t');
    field = line.substr(0, tab);
    line.remove_prefix(tab == std::string_view::npos ? line.size() : tab + 1);
  }
  return fields;
}

}  // namespace

void ReadOpenSfmTracks(const std::filesystem::path& file,
                       const std::function<void(const TrackLine&)>& take) {
  const std::string text = ReadFile(file);
  std::string_view rest = text;
  int number = 0;
  while (const auto line = TakeLine(rest)) {
    ++number;
    if (Trim(*line).empty() || line->starts_with("OPENSFM_TRACKS_VERSION")) continue;
    const auto fields = SplitAtTabs(*line);
    const auto x = ParseNumber<double>(fields[3]);
    const auto y = ParseNumber<double>(fields[4]);
    if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}:{}: is no line of tracks: photo, track, feature, x, y",
                              file.string(), number),
                  "take the file from OpenSfM again, or move it away to import the poses alone");
    }
    take({fields[0], fields[1], {*x, *y}});
  }
}

}  // namespace stucco
