// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/word_reader.h"

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {

WordReader::WordReader(const std::filesystem::path& path)
    : name_(path.string()), text_(ReadFile(path)), rest_(text_) {}

void WordReader::SkipBlanks() {
  while (!rest_.empty() && IsBlank(rest_.front())) {
    line_ += rest_.front() == '\n';
    rest_.remove_prefix(1);
  }
}

bool WordReader::AtEnd() {
  SkipBlanks();
  return rest_.empty();
}

std::string_view WordReader::Line() {
  const std::string_view line = TakeLine(rest_).value_or(std::string_view());
  ++line_;
  return line;
}

std::string_view WordReader::Word(const char* what) {
  if (AtEnd()) Fail(fmt::format("the file ends where {} should be", what));
  return TakeWord(rest_);
}

Eigen::Vector3d WordReader::NextVector(const char* what) {
  const auto x = Next<double>(what);
  const auto y = Next<double>(what);
  const auto z = Next<double>(what);
  return {x, y, z};
}

std::string WordReader::Where() const {
  return fmt::format("{}:{}", name_, line_);
}

void WordReader::Fail(const std::string& reason) const {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", Where(), reason),
              "export the model again");
}

}  // namespace stucco
