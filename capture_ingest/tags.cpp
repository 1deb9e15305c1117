// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/tags.h"

#include <cmath>
#include <exiv2/exiv2.hpp>
#include <mutex>

#include "survey/text.h"

namespace stucco {
namespace {

// The XMP toolkit inside Exiv2 keeps global tables of namespaces, so one photo is parsed at a time;
// that takes a few milliseconds beside the hundreds of decoding the picture.
std::mutex& ExivMutex() {
  static std::mutex mutex;
  return mutex;
}

// When two namespaces use one prefix (Camera: of Pix4D and of senseFly), the toolkit renames the
// one it meets second to "Camera_1_". Which one that is depends on the order of photos, so the
// suffix goes.
std::string WithoutAlias(const std::string& prefix) {
  if (prefix.size() < 3 || prefix.back() != '_') return prefix;
  size_t digits = prefix.size() - 1;
  while (digits > 0 && prefix[digits - 1] >= '0' && prefix[digits - 1] <= '9') --digits;
  if (digits == prefix.size() - 1 || digits == 0 || prefix[digits - 1] != '_') return prefix;
  return prefix.substr(0, digits - 1);
}

// Thumbnails and maker notes hold nothing that is used here, but can be large.
bool IsWanted(const Exiv2::Exifdatum& datum) {
  const std::string group = datum.groupName();
  return (group == "Image" || group == "Photo" || group == "GPSInfo") && datum.size() < 4096;
}

void CopyTags(Exiv2::Image& image, Tags& tags) {
  for (const Exiv2::Exifdatum& datum : image.exifData()) {
    if (IsWanted(datum)) tags.emplace(datum.key(), datum.toString());
  }
  for (const Exiv2::Xmpdatum& datum : image.xmpData()) {
    if (datum.size() >= 4096) continue;
    tags.emplace("Xmp." + WithoutAlias(datum.groupName()) + "." + datum.tagName(),
                 datum.toString());
  }
}

std::optional<double> ParseDouble(std::string_view text) {
  const auto value = ParseNumber<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> ParseFraction(std::string_view text) {
  const size_t slash = text.find('/');
  if (slash == std::string_view::npos) return ParseDouble(text);
  const auto numerator = ParseDouble(text.substr(0, slash));
  const auto denominator = ParseDouble(text.substr(slash + 1));
  if (!numerator || !denominator || *denominator == 0) return std::nullopt;
  return *numerator / *denominator;
}

}  // namespace

PhotoTags ReadTags(std::string_view jpeg_bytes) {
  const std::lock_guard lock(ExivMutex());
  PhotoTags result;
  try {
    Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
    const auto image = Exiv2::ImageFactory::open(
        reinterpret_cast<const Exiv2::byte*>(jpeg_bytes.data()), jpeg_bytes.size());
    image->readMetadata();
    CopyTags(*image, result.tags);
  } catch (const std::exception& error) {  // Exiv2::Error, and what its parsers let through
    result.problem = error.what();
  }
  return result;
}

std::string Text(const Tags& tags, const std::string& key) {
  const auto found = tags.find(key);
  if (found == tags.end()) return {};
  const std::string& text = found->second;
  const std::string_view blanks(" \t\r\n\0", 5);
  const size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::optional<std::vector<double>> ParseNumbers(std::string_view text) {
  constexpr std::string_view kSeparators = " ,\t";
  std::vector<double> numbers;
  size_t begin = text.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos) {
    const size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    const auto number = ParseFraction(text.substr(begin, end - begin));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    begin = text.find_first_not_of(kSeparators, end);
  }
  return numbers;
}

std::optional<std::vector<double>> Numbers(const Tags& tags, const std::string& key) {
  const std::string text = Text(tags, key);
  if (text.empty()) return std::nullopt;
  return ParseNumbers(text);
}

std::optional<double> Number(const Tags& tags, const std::string& key) {
  const auto numbers = Numbers(tags, key);
  if (!numbers || numbers->size() != 1) return std::nullopt;
  return numbers->front();
}

}  // namespace stucco
