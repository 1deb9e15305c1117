// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <set>

#include "cli/program.h"
#include "pipeline/verbs/export.h"

namespace stucco {
namespace {

// The command tree as completion needs it.
struct Verb {
  std::string name;
  std::string help;
  std::vector<std::pair<std::string, std::string>> options;  // "--until" and its help
};

std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::vector<Verb> Verbs(const CLI::App& app) {
  std::vector<Verb> verbs;
  for (const CLI::App* child : app.get_subcommands(nullptr)) {
    Verb verb{child->get_name(), child->get_description(), {}};
    for (const CLI::Option* option : child->get_options()) {
      const std::vector<std::string>& names = option->get_lnames();
      if (!names.empty()) {
        verb.options.emplace_back("--" + names.front(), FirstLine(option->get_description()));
      }
    }
    verbs.push_back(std::move(verb));
  }
  return verbs;
}

// Values that certain options take.
std::map<std::string, std::string> Choices(const StageTable& table) {
  std::string stages, formats;
  for (const Stage& stage : table) {
    stages += (stages.empty() ? "" : " ") + stage.name;
  }
  for (const ExportFormat& format : ExportFormats()) {
    formats += (formats.empty() ? "" : " ") + format.name;
  }
  return {{"--until", stages},
          {"--from", stages},
          {"--format", formats},
          {"--replace", "auto always never"}};
}

std::string VerbNames(const std::vector<Verb>& verbs) {
  std::string names;
  for (const Verb& verb : verbs) {
    names += (names.empty() ? "" : " ") + verb.name;
  }
  return names;
}

std::string Bash(const std::vector<Verb>& verbs, const StageTable& table) {
  std::string text =
      "# bash completion for stucco; to use it: source <(stucco completion bash)\n"
      "_stucco() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n";
  text += fmt::format("    COMPREPLY=($(compgen -W '{} --help --version' -- \"$word\"))\n",
                      VerbNames(verbs));
  text += "    return\n  fi\n  case $before in\n";
  for (const auto& [option, values] : Choices(table)) {
    text += fmt::format("    {}) COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n", option,
                        values);
  }
  text += "  esac\n  case $word in\n    -*)\n      case ${COMP_WORDS[1]} in\n";
  for (const Verb& verb : verbs) {
    std::string options;
    for (const auto& [option, help] : verb.options) {
      options += (options.empty() ? "" : " ") + option;
    }
    text += fmt::format("        {}) COMPREPLY=($(compgen -W '{}' -- \"$word\")) ;;\n", verb.name,
                        options);
  }
  text +=
      "      esac ;;\n"
      "    *)\n"
      "      if [ \"${COMP_WORDS[1]}\" = completion ]; then\n"
      "        COMPREPLY=($(compgen -W 'bash zsh fish' -- \"$word\"))\n"
      "      else\n"
      "        compopt -o filenames 2>/dev/null\n"
      "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
      "      fi ;;\n"
      "  esac\n"
      "}\n"
      "complete -F _stucco stucco\n";
  return text;
}

// For a word between single quotes.
std::string Quoted(const std::string& text, const std::string& escaped_characters) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += (escaped_characters.find(c) != std::string::npos ? "\\" : "") + std::string(1, c);
    }
  }
  return result;
}

std::string Zsh(const std::vector<Verb>& verbs, const StageTable& table) {
  const auto choices = Choices(table);
  std::string text =
      "#compdef stucco\n"
      "# zsh completion for stucco; to use it: source <(stucco completion zsh)\n"
      "_stucco() {\n"
      "  local -a verbs\n"
      "  verbs=(\n";
  for (const Verb& verb : verbs) {
    text += fmt::format("    '{}:{}'\n", verb.name, Quoted(verb.help, ":"));
  }
  text +=
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe 'verb' verbs\n"
      "    return\n"
      "  fi\n"
      "  local verb=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $verb in\n";
  for (const Verb& verb : verbs) {
    text += fmt::format("    {})\n      _arguments", verb.name);
    for (const auto& [option, help] : verb.options) {
      const auto values = choices.find(option);
      text +=
          fmt::format(" \\\n        '{}[{}]{}'", option, Quoted(help, "[]:"),
                      values == choices.end() ? "" : fmt::format(":value:({})", values->second));
    }
    text += verb.name == "completion" ? " \\\n        '1:shell:(bash zsh fish)'"
                                      : " \\\n        '*:path:_files'";
    text += " ;;\n";
  }
  text +=
      "  esac\n"
      "}\n"
      "compdef _stucco stucco\n";
  return text;
}

// fish knows two escapes between single quotes: \' and \\ .
std::string FishQuoted(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return result;
}

std::string Fish(const std::vector<Verb>& verbs, const StageTable& table) {
  const auto choices = Choices(table);
  std::string text = "# fish completion for stucco; to use it: stucco completion fish | source\n";
  for (const Verb& verb : verbs) {
    text += fmt::format("complete -c stucco -n __fish_use_subcommand -f -a {} -d '{}'\n", verb.name,
                        FishQuoted(verb.help));
  }
  for (const Verb& verb : verbs) {
    for (const auto& [option, help] : verb.options) {
      const auto values = choices.find(option);
      text +=
          fmt::format("complete -c stucco -n '__fish_seen_subcommand_from {}' -l {} -d '{}'{}\n",
                      verb.name, option.substr(2), FishQuoted(help),
                      values == choices.end() ? "" : fmt::format(" -x -a '{}'", values->second));
    }
  }
  text += "complete -c stucco -n '__fish_seen_subcommand_from completion' -f -a 'bash zsh fish'\n";
  return text;
}

}  // namespace

void AddCompletion(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(app, {"completion", "Print a completion script for a shell",
                                 "source <(stucco completion bash)\n"
                                 "stucco completion fish > ~/.config/fish/completions/stucco.fish",
                                 kProgramGroup});
  auto shell = std::make_shared<std::string>();
  verb.add_option("shell", *shell, "bash, zsh or fish")
      ->type_name("SHELL")
      ->required()
      ->check(CLI::IsMember(std::set<std::string>{"bash", "zsh", "fish"}));
  verb.callback([&app, &program, shell] {
    program.action = [&app, &program, shell] {
      const std::vector<Verb> verbs = Verbs(app);
      std::cout << (*shell == "bash"  ? Bash(verbs, program.table)
                    : *shell == "zsh" ? Zsh(verbs, program.table)
                                      : Fish(verbs, program.table));
      return 0;
    };
  });
}

}  // namespace stucco
