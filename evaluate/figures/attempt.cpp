// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/figures/attempt.h"

#include <fmt/format.h>

#include "survey/error.h"

namespace stucco::evaluate {

std::string ProblemIn(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kBadInput) throw;
    return error.remedy().empty() ? error.what()
                                  : fmt::format("{}; {}", error.what(), error.remedy());
  }
  return "";
}

void Attempt(const std::string& measured, const std::function<void()>& measure,
             Evaluation& evaluation) {
  const std::string problem = ProblemIn(measure);
  if (problem.empty()) return;
  evaluation.notes.push_back(fmt::format("{} not measured: {}", measured, problem));
}

}  // namespace stucco::evaluate
