// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "evaluate/figures/evaluation.h"

namespace stucco::evaluate {

// What keeps `read` from being done: a file that is missing, damaged or not what it should be, and
// what to do about it. Empty where nothing does. Errors of other kinds go on.
std::string ProblemIn(const std::function<void()>& read);

// Takes a measure. Where there is a problem a note says so ("the cloud is" "not measured: ..."),
// and the other measures are taken all the same.
void Attempt(const std::string& measured, const std::function<void()>& measure,
             Evaluation& evaluation);

}  // namespace stucco::evaluate
