// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "survey/text.h"

namespace stucco {
namespace {

std::string DoubleAsToml(double value) {
  std::string text = fmt::format("{}", value);  // the shortest text that reads back exactly
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // 'n': inf, nan
  return text;
}

std::string TextAsToml(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (c == '\t') {
      quoted += "\\t";
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += fmt::format("\\u{:04X}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string ListAsToml(const std::vector<double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(DoubleAsToml(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// Sets one option from a value of any type; a wrong type or value comes back as "must be ...".
struct Setter {
  const Option& option;
  const OptionValue& value;

  std::string operator()(int* field) const {
    const auto* number = std::get_if<int64_t>(&value);
    if (number == nullptr) return "must be a whole number";
    const auto wide = static_cast<double>(*number);
    if (!(wide >= option.min && wide <= option.max)) {
      return fmt::format("must be in [{:.0f}, {:.0f}]", option.min, option.max);
    }
    *field = static_cast<int>(*number);
    return {};
  }

  std::string operator()(double* field) const {
    double number = 0;
    if (const auto* whole = std::get_if<int64_t>(&value)) {
      number = static_cast<double>(*whole);
    } else if (const auto* real = std::get_if<double>(&value)) {
      number = *real;
    } else {
      return "must be a number";
    }
    // Written so that NaN fails.
    if (!(number >= option.min && number <= option.max)) {
      return fmt::format("must be in [{}, {}]", option.min, option.max);
    }
    *field = number;
    return {};
  }

  std::string operator()(bool* field) const {
    const auto* flag = std::get_if<bool>(&value);
    if (flag == nullptr) return "must be true or false";
    *field = *flag;
    return {};
  }

  std::string operator()(std::string* field) const {
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr) return "must be a text";
    if (!option.choices.empty() &&
        std::ranges::find(option.choices, *text) == option.choices.end()) {
      return fmt::format("must be one of {}", fmt::join(option.choices, ", "));
    }
    *field = *text;
    return {};
  }

  std::string operator()(std::vector<double>* field) const {
    const auto* list = std::get_if<std::vector<double>>(&value);
    const auto is_finite = [](double number) { return std::isfinite(number); };
    if (list == nullptr || !std::ranges::all_of(*list, is_finite)) {
      return "must be a list of numbers";
    }
    *field = *list;
    return {};
  }
};

std::string Shown(const OptionValue& value) {
  struct Printer {
    std::string operator()(int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return DoubleAsToml(number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const std::string& text) const { return TextAsToml(text); }
    std::string operator()(const std::vector<double>& list) const { return ListAsToml(list); }
  };
  return std::visit(Printer(), value);
}

std::string UnknownOption(const OptionTable& table, std::string_view name) {
  std::string problem = fmt::format("{}.{}: unknown option", table.section(), name);
  const std::string near = table.Suggestion(name);
  if (!near.empty()) problem += fmt::format("; did you mean {}.{}?", table.section(), near);
  return problem;
}

std::optional<std::vector<double>> ParseList(std::string_view text) {
  std::vector<double> list;
  if (Trim(text).empty()) return list;
  while (true) {
    const size_t comma = text.find(',');
    const auto number = ParseNumber<double>(Trim(text.substr(0, comma)));
    if (!number) return std::nullopt;
    list.push_back(*number);
    if (comma == std::string_view::npos) return list;
    text.remove_prefix(comma + 1);
  }
}

// The text as a value of the option's type. Text that is not of this type stays a text, which
// SetOption refuses with the right words.
OptionValue ParseFor(const Option& option, std::string_view text) {
  const std::string_view word = Trim(text);
  if (std::holds_alternative<int*>(option.value)) {
    if (const auto number = ParseNumber<int64_t>(word)) return *number;
  } else if (std::holds_alternative<double*>(option.value)) {
    if (const auto number = ParseNumber<double>(word)) return *number;
  } else if (std::holds_alternative<bool*>(option.value)) {
    if (word == "true" || word == "1") return true;
    if (word == "false" || word == "0") return false;
  } else if (std::holds_alternative<std::vector<double>*>(option.value)) {
    if (auto list = ParseList(text)) return *std::move(list);
  }
  return std::string(text);
}

}  // namespace

Option& OptionTable::Append(Option option) {
  assert(Find(option.name) == nullptr);
  return options_.emplace_back(std::move(option));
}

Option& OptionTable::Add(std::string name, int& value, int min, int max, std::string help) {
  assert(min <= max);
  return Append(Option{std::move(name),
                       std::move(help),
                       &value,
                       static_cast<double>(min),
                       static_cast<double>(max),
                       {}});
}

Option& OptionTable::Add(std::string name, double& value, double min, double max,
                         std::string help) {
  assert(min <= max);
  return Append(Option{std::move(name), std::move(help), &value, min, max, {}});
}

Option& OptionTable::Add(std::string name, bool& value, std::string help) {
  return Append(Option{std::move(name), std::move(help), &value, 0, 0, {}});
}

Option& OptionTable::Add(std::string name, std::string& value, std::vector<std::string> choices,
                         std::string help) {
  return Append(Option{std::move(name), std::move(help), &value, 0, 0, std::move(choices)});
}

Option& OptionTable::Add(std::string name, std::vector<double>& value, std::string help) {
  return Append(Option{std::move(name), std::move(help), &value, 0, 0, {}});
}

const Option* OptionTable::Find(std::string_view name) const {
  const auto found = std::ranges::find(options_, name, &Option::name);
  return found == options_.end() ? nullptr : &*found;
}

std::string OptionTable::Suggestion(std::string_view name) const {
  // About one slip per three letters still looks like the same word.
  int best = std::max(1, static_cast<int>(name.size() + 1) / 3);
  std::string suggestion;
  for (const Option& option : options_) {
    const int distance = EditDistance(name, option.name);
    if (distance < best || (distance == best && suggestion.empty())) {
      best = distance;
      suggestion = option.name;
    }
  }
  return suggestion;
}

std::string SetOption(const OptionTable& table, std::string_view name, const OptionValue& value) {
  const Option* option = table.Find(name);
  if (option == nullptr) return UnknownOption(table, name);
  const std::string problem = std::visit(Setter{*option, value}, option->value);
  if (problem.empty()) return {};
  return fmt::format("{}.{} = {} {}", table.section(), name, Shown(value), problem);
}

std::string SetOptionFromText(const OptionTable& table, std::string_view name,
                              std::string_view text) {
  const Option* option = table.Find(name);
  if (option == nullptr) return UnknownOption(table, name);
  return SetOption(table, name, ParseFor(*option, text));
}

std::string ValueAsToml(const Option& option) {
  struct Printer {
    std::string operator()(const int* value) const { return fmt::format("{}", *value); }
    std::string operator()(const double* value) const { return DoubleAsToml(*value); }
    std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
    std::string operator()(const std::string* value) const { return TextAsToml(*value); }
    std::string operator()(const std::vector<double>* value) const { return ListAsToml(*value); }
  };
  return std::visit(Printer(), option.value);
}

int EditDistance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);  // distances between a[0, i) and every start of b
  std::iota(row.begin(), row.end(), 0);
  for (size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string CanonicalText(const OptionTable& table) {
  std::string text;
  for (const Option& option : table.options()) {
    if (option.affects_result) text += fmt::format("{} = {}\n", option.name, ValueAsToml(option));
  }
  return text;
}

}  // namespace stucco
