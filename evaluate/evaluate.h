// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "evaluate/evaluation.h"

namespace stucco::evaluate {

struct EvaluateRequest {
  std::filesystem::path survey;       // with whatever stages have results
  std::filesystem::path scene;        // a scene folder with truth
  std::filesystem::path flight;       // survey folder with truth/flight.json; empty: `survey`
  std::filesystem::path output;       // evaluation.json, facades.csv, evaluation.html, pictures/
  std::filesystem::path lpips_model;  // ONNX; empty: LPIPS is not measured
  double tolerance_m = 0.1;
  int threads = 1;
};

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
