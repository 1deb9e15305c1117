// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/suggest.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "survey/options.h"

namespace stucco {
namespace {

// The known word nearest to a misspelt one; empty when none is near or the word is known.
std::string Nearest(const std::vector<std::string>& known, const std::string& word) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](auto& a, auto& b) {
    return EditDistance(a, word) < EditDistance(b, word);
  });
  if (nearest == known.end()) {
    return {};
  }
  const int distance = EditDistance(*nearest, word);
  return distance > 0 && distance <= std::max<int>(2, static_cast<int>(word.size()) / 3) ? *nearest
                                                                                         : "";
}

std::vector<std::string> Verbs(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands(nullptr)) {
    names.push_back(verb->get_name());
  }
  return names;
}

std::vector<std::string> LongOptions(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

std::string SuggestOptions(const CLI::App& verb, const std::vector<std::string>& words) {
  const std::vector<std::string> known = LongOptions(verb);
  std::string suggestions;
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (name.substr(0, 2) != "--" || std::find(known.begin(), known.end(), name) != known.end()) {
      continue;
    }
    if (const std::string nearest = Nearest(known, name); !nearest.empty()) {
      suggestions += fmt::format("instead of {}, did you mean {}?\n", name, nearest);
    }
  }
  return suggestions;
}

}  // namespace

bool IsUnknownVerb(const CLI::App& app, const std::string& word) {
  return !word.empty() && word.front() != '-' && std::ranges::count(Verbs(app), word) == 0;
}

std::string SuggestUsage(const CLI::App& app, const std::vector<std::string>& words) {
  const std::vector<std::string> verbs = Verbs(app);
  const auto first = std::find_if(words.begin(), words.end(),
                                  [](const std::string& word) { return word.front() != '-'; });
  if (first == words.end()) {
    return "stucco --help lists the verbs";
  }
  if (std::find(verbs.begin(), verbs.end(), *first) == verbs.end()) {
    const std::string nearest = Nearest(verbs, *first);
    return nearest.empty() ? "stucco --help lists the verbs"
                           : fmt::format("instead of {}, did you mean {}?", *first, nearest);
  }
  return fmt::format("{}stucco {} --help explains this verb",
                     SuggestOptions(*app.get_subcommand(*first), words), *first);
}

}  // namespace stucco
