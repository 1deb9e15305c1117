// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stucco {

// Metadata of one photo as the file has it: "Exif.GPSInfo.GPSLatitude" -> "45/1 1/1 537444/10000",
// "Xmp.drone-dji.GimbalYawDegree" -> "+106.80". XMP attributes and child elements look the same.
using Tags = std::map<std::string, std::string>;

struct PhotoTags {
  Tags tags;
  std::string problem;  // why metadata could not be read, or only in part; empty: nothing
};

// Reads EXIF and XMP with Exiv2. Never throws for what the bytes contain.
PhotoTags ReadTags(std::string_view jpeg_bytes);

// The value without blanks and NULs around it; empty when there is none.
std::string Text(const Tags& tags, const std::string& key);

// Every number of a value ("45/1 1/1 537444/10000", "+46.00", "1,2"); nothing when the tag is
// missing or one of its numbers is malformed, infinite or a fraction with denominator 0.
std::optional<std::vector<double>> Numbers(const Tags& tags, const std::string& key);

// The single number of a value; nothing when it has none or several.
std::optional<double> Number(const Tags& tags, const std::string& key);

// Numbers separated by blanks or commas, as in Numbers().
std::optional<std::vector<double>> ParseNumbers(std::string_view text);

}  // namespace stucco
