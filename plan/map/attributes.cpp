// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/internal/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace stucco::plan::internal {
namespace {

constexpr double kMetresPerFoot = 0.3048;
constexpr double kMetresPerInch = 0.0254;

bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}

void SkipSpaces(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
}

// The number at the front, which is taken off. A comma is a decimal point.
std::optional<double> TakeNumber(std::string_view& text) {
  SkipSpaces(text);
  size_t length = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  while (length < text.size() &&
         (IsDigit(text[length]) || text[length] == '.' || text[length] == ',')) {
    ++length;
  }
  std::string number(text.substr(0, length));
  std::replace(number.begin(), number.end(), ',', '.');
  if (number.starts_with('+')) number.erase(0, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  text.remove_prefix(length);
  SkipSpaces(text);
  return value;
}

std::string_view Trimmed(std::string_view text) {
  SkipSpaces(text);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// Longer or zero-padded digits are keys, in which every digit counts.
bool IsPlainNumber(std::string_view id) {
  constexpr size_t kMostDigits = 15;
  return !id.empty() && id.size() <= kMostDigits && std::all_of(id.begin(), id.end(), IsDigit) &&
         (id.front() != '0' || id.size() <= 4);
}

}  // namespace

std::optional<double> ParseLength(std::string_view text) {
  std::string_view rest = Trimmed(text);
  const std::optional<double> number = TakeNumber(rest);
  if (!number || !std::isfinite(*number)) return std::nullopt;
  if (rest.empty() || rest == "m" || rest == "metres" || rest == "meters" || rest == "M") {
    return number;
  }
  if (rest == "ft" || rest == "feet") return *number * kMetresPerFoot;
  if (!rest.starts_with('\'')) return std::nullopt;
  rest.remove_prefix(1);
  if (Trimmed(rest).empty()) return *number * kMetresPerFoot;
  const std::optional<double> inches = TakeNumber(rest);
  if (!inches || (rest != "\"" && !rest.empty())) return std::nullopt;
  return *number * kMetresPerFoot + *inches * kMetresPerInch;
}

std::string BuildingIds::Next(std::string_view id, int place) {
  id = Trimmed(id);
  std::string name;
  if (id.empty()) {
    name = fmt::format("B{:04}", place);
  } else if (IsPlainNumber(id)) {
    name = fmt::format("B{:04}", std::stoll(std::string(id)));
  } else {
    name = "B";
    for (const char c : id) {
      const bool fits =
          IsDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
      name += fits ? c : '_';
    }
  }
  std::string unique = name;
  for (int i = 2; !taken_.insert(unique).second; ++i) unique = fmt::format("{}-{}", name, i);
  renamed_ = unique != name;
  return unique;
}

}  // namespace stucco::plan::internal
