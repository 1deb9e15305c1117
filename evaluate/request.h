// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

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

}  // namespace stucco::evaluate
