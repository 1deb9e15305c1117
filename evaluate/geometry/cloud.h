// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "evaluate/evaluation.h"
#include "evaluate/geometry/surface_index.h"
#include "survey/pose.h"

namespace stucco::evaluate {

// Points of the truth that a result should have: `seen` says which of them photos show (seen.h).
struct TruthPoints {
  std::vector<SurfacePoint> points;
  std::vector<char> seen;
};

// The value below or at which a share of the values lies (nearest rank); not measured for none.
double Quantile(std::vector<double> values, double share);

// Completeness where `found` says which of the truth's points have the result nearby.
void SetCompleteness(const TruthPoints& truth, std::span<const char> found,
                     SurfaceFigures& figures);

// A cloud that is read from disk once and never held: all its points count for completeness, every
// n-th of them, at most half a million, for the error. Empty clouds have no error and completeness
// 0. Throws Error (kBadInput).
SurfaceFigures CompareCloud(const std::filesystem::path& ply, const Similarity& truth_from_world,
                            const SurfaceIndex& scene, const TruthPoints& truth, double tolerance_m,
                            int threads);

// A surface in the frame of the truth.
SurfaceFigures CompareSurface(const SurfaceIndex& result, const SurfaceIndex& scene,
                              const TruthPoints& truth, double tolerance_m, int threads);

}  // namespace stucco::evaluate
