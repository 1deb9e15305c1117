// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "evaluate/figures/evaluation.h"

namespace stucco::evaluate {

// evaluation.html: a page that opens from disk and loads nothing but the pictures beside it.
std::string EvaluationHtml(const Evaluation& evaluation);

void WriteEvaluationPage(const Evaluation& evaluation, const std::filesystem::path& output);

}  // namespace stucco::evaluate
