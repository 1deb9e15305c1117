// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco {

// Natural logarithm of P[X >= successes], X of the binomial distribution of that many trials.
// Requires 0 <= successes and a probability in [0, 1].
double LogBinomialTail(int trials, int successes, double probability);

// What agrees with a model that was looked for among matches.
struct ChanceFinding {
  int num_matches = 0;
  int num_inliers = 0;
  int sample_size = 7;        // matches that determine a model
  int models_per_sample = 1;  // at most
  double chance = 0;          // that a wrong match agrees with a model
};

// Natural logarithm of the number of such findings to expect where all matches are wrong (Moisan,
// Stival, "A probabilistic criterion to detect rigid point matches", 2004, with a fixed limit in
// place of all limits): the models of all samples times the chance that so many others agree with
// one of them. All samples count, not only those drawn: local optimisation finds models that are
// near the best of all.
double LogFalseAlarms(const ChanceFinding& finding);

}  // namespace stucco
