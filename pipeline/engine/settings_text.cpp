// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <variant>

#include "pipeline/engine/settings.h"

namespace stucco {
namespace {

constexpr size_t kLineWidth = 96;

// A comment of as many lines as it takes.
std::string Comment(const std::string& text) {
  std::string result, line = "#";
  size_t start = 0;
  while (start < text.size()) {
    const size_t end = std::min(text.find(' ', start), text.size());
    if (line.size() > 1 && line.size() + 1 + end - start > kLineWidth) {
      result += line + "\n";
      line = "#";
    }
    line += " " + text.substr(start, end - start);
    start = end + 1;
  }
  return result + line + "\n";
}

std::string Help(const Option& option) {
  const std::string allowed = AllowedValues(option);
  return allowed.empty() ? option.help : fmt::format("{} ({})", option.help, allowed);
}

std::string SectionTemplate(const OptionTable& options, const std::string& title) {
  std::string text = fmt::format("\n[{}]  # {}\n", options.section(), title);
  for (const Option& option : options.options()) {
    text += fmt::format("\n{}{} = {}\n", Comment(Help(option)), option.name, ValueAsToml(option));
  }
  return text;
}

std::string QuotedToml(const std::string& text) {
  std::string copy = text;
  Option option{"photos", "", &copy, 0, 0, {}, true};
  return ValueAsToml(option);
}

// A cell must neither end at a bar nor open a tag.
std::string Cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '|' ? "\\|" : c == '<' ? "&lt;" : std::string(1, c);
  }
  return escaped;
}

std::string SectionMarkdown(const OptionTable& options, const std::string& title) {
  std::string text = fmt::format("\n## [{}]: {}\n\n", options.section(), title);
  text += "| option | default | allowed | what it does |\n| --- | --- | --- | --- |\n";
  for (const Option& option : options.options()) {
    text += fmt::format("| `{}` | `{}` | {} | {}{} |\n", option.name, ValueAsToml(option),
                        Cell(AllowedValues(option)), Cell(option.help),
                        option.affects_result ? "" : " Changes no result.");
  }
  return text;
}

}  // namespace

std::string AllowedValues(const Option& option) {
  if (std::holds_alternative<int*>(option.value) || std::holds_alternative<double*>(option.value)) {
    return fmt::format("{} to {}", option.min, option.max);
  }
  if (!option.choices.empty()) {
    return fmt::format("one of {}", fmt::join(option.choices, ", "));
  }
  return {};
}

std::string SettingsTemplate(const StageTable& table, const std::string& photos) {
  std::string text =
      "# Settings of this survey, in TOML (https://toml.io). Every value below is the default.\n"
      "# After a change, `stucco run` repeats exactly the stages that depend on it.\n\n"
      "# The folder with the photos, relative to this file or absolute. It is never written to.\n";
  text += fmt::format("photos = {}\n", QuotedToml(photos));
  RunSettings run;
  OptionTable run_table("run");
  Describe(run_table, run);
  text += SectionTemplate(run_table, "how the computer is used; changes no result");
  for (const Stage& stage : table) {
    text += SectionTemplate(stage.bind().options, stage.title);
  }
  return text;
}

std::string OptionsAsMarkdown(const StageTable& table) {
  std::string text =
      "# Options\n\nEvery setting of `survey.toml`, by section. `stucco run S --set "
      "calib.max_image_px=1600` sets one for a single run.\n";
  RunSettings run;
  OptionTable run_table("run");
  Describe(run_table, run);
  text += SectionMarkdown(run_table, "how the computer is used");
  for (const Stage& stage : table) {
    text += SectionMarkdown(stage.bind().options, stage.title);
  }
  return text;
}

}  // namespace stucco
