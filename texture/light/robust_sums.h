// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <utility>

#include "texture/light/colour.h"
#include "texture/light/falloff.h"

namespace stucco {

// That a sum of unknowns by these factors is the measured value.
struct SumEquation {
  std::array<std::pair<int, double>, 6> terms = {};  // unknown and factor; unused ones are 0
  double measured = 0;
  double sigma = 1;  // one standard deviation of it
};

// Deviation of a measured ratio with many texels, of its logarithm.
inline constexpr double kRatioSigma = 0.02;

// The part of a ratio's logarithm that the falloffs of its photos' lenses make.
double LostToCorners(const ColourRatio& ratio, std::span<const Falloff> falloff_of_photo);

// What a ratio says of the logarithms of its photos' light, unknowns `a` and `b`; `sigma` with as
// many texels as can help.
SumEquation OfRatio(const ColourRatio& ratio, int a, int b, double measured, double sigma);

using NormalFactors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

// Least squares with Huber weights (beyond three deviations), the unknowns drawn to 0 by their own
// deviations `prior_sigmas`. `factors` become those of the normal equations, whose inverse is the
// covariance.
Eigen::VectorXd SolveSums(std::span<const SumEquation> equations,
                          const Eigen::VectorXd& prior_sigmas, NormalFactors& factors);

}  // namespace stucco
