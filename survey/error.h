// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace stucco {

// What went wrong, as far as the caller has to act differently. The program maps it to its exit
// code.
enum class ErrorKind {
  kStageFailed,    // the data do not allow what was asked (exit code 1)
  kUsage,          // unknown option, value out of range (2)
  kBadInput,       // a file is missing, damaged or not what it claims to be (3)
  kQualityGate,    // a result is worse than the limit that was asked for (4)
  kOutOfResource,  // disk full, memory (5)
  kInterrupted,    // SIGINT or SIGTERM (130)
};

// The one exception type of the project. `what()` names the file and the reason; `remedy()` says
// what to do about it and may be empty.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& what, std::string remedy = {})
      : std::runtime_error(what), kind_(kind), remedy_(std::move(remedy)) {}
  ErrorKind kind() const { return kind_; }
  const std::string& remedy() const { return remedy_; }

 private:
  ErrorKind kind_;
  std::string remedy_;
};

}  // namespace stucco
