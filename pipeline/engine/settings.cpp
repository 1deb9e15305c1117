// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/settings.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>

#include "pipeline/engine/resources.h"
#include "pipeline/engine/shell.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kRunSection[] = "run";
constexpr char kPhotosKey[] = "photos";

// Collects what is wrong, so that everything is said at once.
class SettingsReader {
 public:
  SettingsReader(const StageTable& table, Settings& settings)
      : run_table_(kRunSection), settings_(settings) {
    Describe(run_table_, settings.run);
    for (const Stage& stage : table) {
      settings.stages.emplace(stage.name, stage.bind());
    }
  }

  void ReadFile(const toml::table& root) {
    for (const auto& [key, node] : root) {
      const std::string name(key.str());
      if (name == kPhotosKey) {
        ReadPhotos(node);
      } else if (const OptionTable* options = Section(name)) {
        ReadSection(name, *options, node);
      } else {
        Add(Where(node), fmt::format("{}: unknown {}{}", name,
                                     node.is_table() ? "section" : "option", Suggestion(name)));
      }
    }
    if (!root.contains(kPhotosKey)) {
      problems_.push_back(
          fmt::format("{}: photos is missing: add a line photos = \"FOLDER\"", kSettingsFile));
    }
  }

  void Override(const std::string& text) {
    const size_t equals = text.find('=');
    const size_t dot = text.find('.');
    const std::string where = fmt::format("--set {}", text);
    if (equals == std::string::npos || dot == std::string::npos || dot > equals) {
      Add(where, "must look like calib.max_image_px=1600");
      return;
    }
    const std::string section = text.substr(0, dot);
    const OptionTable* options = Section(section);
    if (options == nullptr) {
      Add(where, fmt::format("{}: unknown section{}", section, Suggestion(section)));
      return;
    }
    const std::string name = text.substr(dot + 1, equals - dot - 1);
    Add(where, SetOptionFromText(*options, name, text.substr(equals + 1)));
  }

  const std::string& photos() const { return photos_; }
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  void Add(const std::string& where, const std::string& problem) {
    if (!problem.empty()) {
      problems_.push_back(fmt::format("{}: {}", where, problem));
    }
  }

  static std::string Where(const toml::node& node) {
    return fmt::format("{}:{}", kSettingsFile, node.source().begin.line);
  }

  const OptionTable* Section(const std::string& name) const {
    if (name == kRunSection) {
      return &run_table_;
    }
    const auto stage = settings_.stages.find(name);
    return stage == settings_.stages.end() ? nullptr : &stage->second.options;
  }

  std::string Suggestion(const std::string& name) const {
    std::vector<std::string> known = {kPhotosKey, kRunSection};
    for (const auto& [stage, bound] : settings_.stages) {
      known.push_back(stage);
    }
    const auto nearest = std::min_element(known.begin(), known.end(), [&](auto& a, auto& b) {
      return EditDistance(a, name) < EditDistance(b, name);
    });
    return EditDistance(*nearest, name) <= 2 ? fmt::format("; did you mean {}?", *nearest) : "";
  }

  void ReadPhotos(const toml::node& node) {
    const auto text = node.value<std::string>();
    if (!node.is_string() || text->empty()) {
      Add(Where(node), "photos must be the path of a folder, in quotes");
      return;
    }
    photos_ = *text;
  }

  void ReadSection(const std::string& section, const OptionTable& options, const toml::node& node) {
    const toml::table* values = node.as_table();
    if (values == nullptr) {
      Add(Where(node), fmt::format("{} must be a section: [{}]", section, section));
      return;
    }
    for (const auto& [key, value] : *values) {
      const std::string name(key.str());
      const std::optional<OptionValue> parsed = Value(value);
      Add(Where(value), parsed ? SetOption(options, name, *parsed)
                               : fmt::format("{}.{} must be a number, a text, true, false or a "
                                             "list of numbers",
                                             section, name));
    }
  }

  static std::optional<OptionValue> Value(const toml::node& node) {
    if (node.is_integer()) return *node.value_exact<int64_t>();
    if (node.is_floating_point()) return *node.value_exact<double>();
    if (node.is_boolean()) return *node.value_exact<bool>();
    if (node.is_string()) return *node.value_exact<std::string>();
    const toml::array* array = node.as_array();
    if (array == nullptr) return std::nullopt;
    std::vector<double> numbers;
    for (const toml::node& element : *array) {
      const std::optional<double> number = element.value<double>();
      if (!element.is_number() || !number) return std::nullopt;
      numbers.push_back(*number);
    }
    return numbers;
  }

  OptionTable run_table_;
  Settings& settings_;
  std::string photos_;
  std::vector<std::string> problems_;
};

toml::table ParseFile(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: this is no survey folder, it has no {}",
                            file.parent_path().string(), kSettingsFile),
                fmt::format("create one with: stucco init {} --photos PHOTOS",
                            ShellWord(file.parent_path().string())));
  }
  try {
    return toml::parse(ReadFile(file));
  } catch (const toml::parse_error& e) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}:{}: is not valid TOML: {}", kSettingsFile, e.source().begin.line,
                            e.description()),
                fmt::format("mend this line of {} (https://toml.io says how it is written)",
                            file.string()));
  }
}

}  // namespace

void Describe(OptionTable& table, RunSettings& settings) {
  table
      .Add("threads", settings.threads, 0, 1024,
           "Threads to compute on; 0 takes all cores. Results do not depend on it.")
      .affects_result = false;
  table
      .Add("memory_limit_gb", settings.memory_limit_gb, 0.25, 4096,
           "Memory in GiB that stages plan their work for. Results do not depend on it.")
      .affects_result = false;
}

int ResolvedThreads(const RunSettings& settings) {
  return settings.threads > 0 ? settings.threads : AvailableCores();
}

Settings LoadSettings(const fs::path& survey, const StageTable& table,
                      const std::vector<std::string>& overrides) {
  Settings settings;
  SettingsReader reader(table, settings);
  reader.ReadFile(ParseFile(survey / kSettingsFile));
  const bool file_is_right = reader.problems().empty();
  for (const std::string& text : overrides) {
    reader.Override(text);
  }
  if (!reader.problems().empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("{}", fmt::join(reader.problems(), "\n")),
                file_is_right ? "correct the command; stucco options lists what there is"
                              : fmt::format("mend {}; stucco options lists what there is",
                                            (survey / kSettingsFile).string()));
  }
  settings.photos = fs::absolute(survey / reader.photos()).lexically_normal();
  return settings;
}

}  // namespace stucco
