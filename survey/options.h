// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stucco {

// One documented setting of a stage, bound to the field that holds it.
struct Option {
  std::string name;  // max_image_px
  std::string help;  // a sentence; says the unit
  std::variant<int*, double*, bool*, std::string*, std::vector<double>*> value;
  double min = 0;  // inclusive; for int and double
  double max = 0;
  std::vector<std::string> choices;  // for strings; empty: any text
  // False: does not change results (threads, verbosity), so it is left out of fingerprints.
  bool affects_result = true;
  // Names a file, from the survey's folder on, whose content the result depends on.
  bool is_input_file = false;
};

// The settings of one stage, described once: survey.toml, command line, help, validation,
// documentation and fingerprints are all made from this list. A stage provides
//   void Describe(OptionTable& table, CalibOptions& options);
class OptionTable {
 public:
  explicit OptionTable(std::string section) : section_(std::move(section)) {}

  // Requires a name that the table does not have yet, and a range that is not empty.
  Option& Add(std::string name, int& value, int min, int max, std::string help);
  Option& Add(std::string name, double& value, double min, double max, std::string help);
  Option& Add(std::string name, bool& value, std::string help);
  Option& Add(std::string name, std::string& value, std::vector<std::string> choices,
              std::string help);
  Option& Add(std::string name, std::vector<double>& value, std::string help);

  const std::string& section() const { return section_; }
  const std::vector<Option>& options() const { return options_; }
  const Option* Find(std::string_view name) const;
  // The known name nearest to a misspelt one, or empty when none is near.
  std::string Suggestion(std::string_view name) const;

 private:
  Option& Append(Option option);

  std::string section_;
  std::vector<Option> options_;
};

using OptionValue = std::variant<int64_t, double, bool, std::string, std::vector<double>>;

// Sets an option; returns the problem ("calib.max_features = 3 must be in [100, 1000000]") or an
// empty string. An integer is accepted where a double is meant.
std::string SetOption(const OptionTable& table, std::string_view name, const OptionValue& value);

// The same from text as typed on a command line ("true", "12", "a,b,c" for lists).
std::string SetOptionFromText(const OptionTable& table, std::string_view name,
                              std::string_view text);

// The current value as TOML ("0.8", "true", "\"text\"", "[1.0, 2.0]"); doubles round-trip.
std::string ValueAsToml(const Option& option);

// Edit distance (Levenshtein) used for suggestions; also for verbs and stage names.
int EditDistance(std::string_view a, std::string_view b);

// Text of all options that affect results, one "name = value" a line: what a fingerprint hashes.
std::string CanonicalText(const OptionTable& table);

}  // namespace stucco
