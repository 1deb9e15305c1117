// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace stucco::plan::internal {

// "12", "12.5 m", "12,5", "40 ft", "40'", "39'4\"" in metres. Nothing for other texts.
std::optional<double> ParseLength(std::string_view text);

// Note on a building whose id another one has.
inline constexpr char kRenamed[] = "another building has its id; numbered";

// Makes ids of buildings that can be part of a file name and of facade ids.
class BuildingIds {
 public:
  // For the map's own id, or for the building's place in the map (from 1) where it has none: whole
  // numbers become B0012, other texts "B" and the text with '_' for what is neither letter nor
  // digit. An id that is taken gets -2, -3 ...
  std::string Next(std::string_view id, int place);
  // Whether the last id was taken.
  bool renamed() const { return renamed_; }

 private:
  bool renamed_ = false;
  std::set<std::string> taken_;
};

}  // namespace stucco::plan::internal
