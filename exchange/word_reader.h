// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>

#include "survey/text.h"

namespace stucco {

// A text file word by word, over the ends of lines; complaints name file and line.
class WordReader {
 public:
  explicit WordReader(const std::filesystem::path& path);

  bool AtEnd();
  // The rest of this line, and on to the next; empty at the end of the file.
  std::string_view Line();
  // Throws Error (kBadInput) at the end of the file: it has been cut off.
  std::string_view Word(const char* what);

  template <typename Number>
  Number Next(const char* what) {
    const std::string_view word = Word(what);
    const auto number = ParseNumber<Number>(word);
    bool usable = number.has_value();
    if constexpr (std::floating_point<Number>) usable = usable && std::isfinite(*number);
    if (!usable) Fail(fmt::format("{} \"{}\" is not a number that fits", what, word));
    return *number;
  }
  Eigen::Vector3d NextVector(const char* what);

  std::string Where() const;
  [[noreturn]] void Fail(const std::string& reason) const;

 private:
  void SkipBlanks();

  std::string name_;
  std::string text_;
  std::string_view rest_;
  int line_ = 1;
};

}  // namespace stucco
