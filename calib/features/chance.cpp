// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/chance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stucco {
namespace {

// lgamma() sets a global variable.
double LogChoose(int n, int k) {
  double log = 0;
  const int fewer = std::min(k, n - k);
  for (int i = 1; i <= fewer; ++i) log += std::log(static_cast<double>(n - fewer + i) / i);
  return log;
}

}  // namespace

double LogBinomialTail(int trials, int successes, double probability) {
  assert(successes >= 0 && probability >= 0 && probability <= 1);
  if (successes == 0 || (successes <= trials && probability >= 1)) return 0;
  if (successes > trials || probability <= 0) return -std::numeric_limits<double>::infinity();
  const double log_first = LogChoose(trials, successes) + successes * std::log(probability) +
                           (trials - successes) * std::log1p(-probability);
  // The terms relative to the first; below the mean they grow first.
  const double odds = probability / (1 - probability);
  double sum = 0;
  double term = 1;
  for (int k = successes; k <= trials; ++k) {
    sum += term;
    term *= odds * (trials - k) / (k + 1.0);
    if (term < 1e-12 * sum) break;
    if (sum > 1e200) return 0;
  }
  return std::min(0.0, log_first + std::log(sum));
}

double LogFalseAlarms(const ChanceFinding& finding) {
  const int others = finding.num_matches - finding.sample_size;
  const int agreeing = finding.num_inliers - finding.sample_size;
  if (agreeing <= 0) return std::numeric_limits<double>::infinity();
  return std::log(finding.models_per_sample) + LogChoose(finding.num_matches, finding.sample_size) +
         LogBinomialTail(others, agreeing, finding.chance);
}

}  // namespace stucco
