// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "evaluate/figures/evaluation.h"
#include "evaluate/request.h"

namespace stucco::evaluate {

// Measures every result of the survey against the truth. What a stage has not made yet, or what
// cannot be read, is not measured and noted. Throws Error (kBadInput) where the scene or the flight
// has no truth, and where the network for LPIPS or the output folder is of no use.
Evaluation Evaluate(const EvaluateRequest& request);

// Throws Error (kBadInput) where it cannot be, or where it has a facades.csv of somebody else.
void MakeOutputFolder(const std::filesystem::path& output);
// evaluation.json (docs/formats.md); what was not measured is null.
std::string EvaluationJson(const Evaluation& evaluation);
// evaluation.json, facades.csv and evaluation.html.
void WriteEvaluation(const Evaluation& evaluation, const std::filesystem::path& output);

}  // namespace stucco::evaluate
