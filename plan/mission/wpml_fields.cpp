// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "plan/mission/internal/wpml_rules.h"

namespace stucco::plan::internal {
namespace {

constexpr std::string_view kUnset = "65535";  // DJI's own reader takes it for "not set"

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

void CheckNumber(const std::string& element, const FieldRule& rule, const std::string& text,
                 LintLog& log) {
  const auto number = ParseNumber(text);
  if (!number || (rule.kind == FieldRule::kWhole && *number != std::floor(*number))) {
    const char* wanted = rule.kind == FieldRule::kWhole ? "a whole number" : "a number";
    log.Add(element, "number", fmt::format("\"{}\" is not {}", text, wanted));
  } else if (!(*number >= rule.low && *number <= rule.high)) {
    log.Add(element, "range",
            fmt::format("{} is not between {} and {}", text, rule.low, rule.high));
  }
}

void CheckChoice(const std::string& element, const FieldRule& rule, std::string_view text,
                 LintLog& log) {
  const bool is_list = rule.kind == FieldRule::kListOf;
  while (!text.empty()) {
    const size_t comma = is_list ? text.find(',') : std::string_view::npos;
    const std::string_view word = Trimmed(text.substr(0, comma));
    if (std::ranges::find(rule.values, word) == rule.values.end()) {
      log.Add(element, "enum",
              fmt::format("\"{}\" is none of {}", word, fmt::join(rule.values, ", ")));
    }
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
  }
}

void CheckField(const Place& place, const FieldRule& rule, LintLog& log) {
  if (rule.kind == FieldRule::kGroup) return;
  const std::string element = place.Of(rule.name);
  const std::string text = place.Text(rule.name);
  if (text.empty() || (text == kUnset && rule.high != 65535)) {
    log.Add(element, "unset", text.empty() ? "is empty" : "is 65535, which DJI reads as not set");
    return;
  }
  switch (rule.kind) {
    case FieldRule::kNumber:
    case FieldRule::kWhole:
      return CheckNumber(element, rule, text, log);
    case FieldRule::kFlag:
      if (text != "0" && text != "1") log.Add(element, "enum", text + " is neither 0 nor 1");
      return;
    case FieldRule::kOneOf:
    case FieldRule::kListOf:
      return CheckChoice(element, rule, text, log);
    default:
      return;
  }
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  text = Trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

std::optional<std::pair<double, double>> ParsePair(std::string_view text) {
  const size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const size_t end = std::min(text.find(',', comma + 1), text.size());
  const auto first = ParseNumber(text.substr(0, comma));
  const auto second = ParseNumber(text.substr(comma + 1, end - comma - 1));
  if (!first || !second) return std::nullopt;
  return std::pair{*first, *second};
}

void LintLog::Add(const std::string& element, const char* rule, std::string text) {
  findings_.push_back({document_ + ": " + element, rule, std::move(text)});
}

std::string Place::Text(const char* name) const {
  return std::string(Trimmed(node.child_value(name)));
}
std::optional<double> Place::Number(const char* name) const {
  return ParseNumber(Text(name));
}
Place Place::Child(const char* name) const {
  return {node.child(name), path.empty() ? name : Of(name)};
}

void CheckFields(const Place& place, std::span<const FieldRule> rules, LintLog& log, Order order) {
  const FieldRule* latest = nullptr;  // the last rule in order that an element was seen of
  for (const pugi::xml_node child : place.node.children()) {
    const auto rule = std::ranges::find_if(
        rules, [&](const FieldRule& r) { return std::string_view(r.name) == child.name(); });
    if (rule == rules.end()) continue;  // newer versions have more elements
    if (order == Order::kFixed && latest != nullptr && &*rule < latest) {
      log.Add(place.Of(rule->name), "order", fmt::format("must stand before {}", latest->name));
    } else {
      latest = &*rule;
    }
    const bool repeats = rule->kind != FieldRule::kGroup && child != place.node.child(rule->name);
    if (repeats) log.Add(place.Of(rule->name), "once", "occurs more than once");
  }
  for (const FieldRule& rule : rules) {
    if (place.node.child(rule.name)) {
      CheckField(place, rule, log);
    } else if (rule.required) {
      log.Add(place.Of(rule.name), "required", "is missing");
    }
  }
}

}  // namespace stucco::plan::internal
