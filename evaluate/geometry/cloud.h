// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "evaluate/geometry/part_figures.h"
#include "evaluate/geometry/surface_index.h"
#include "survey/pose.h"

namespace stucco::evaluate {

// What a cloud or a mesh is measured against. Every point of the result counts whose nearest place
// in the scene is of a building or near one, for the part that this place is of.
struct SceneIndex {
  SurfaceIndex everything;  // that a camera sees
  SurfaceIndex buildings;   // walls and roofs of the planar truth
};

// Ground farther than this from every building of the truth is none of the survey's.
inline constexpr double kGroundReachM = 15;

struct CompareOptions {
  double tolerance_m = 0.1;  // of completeness
  int threads = 1;
};

// A cloud that is read from disk once and never held: all its points count for completeness, every
// n-th of them, at most two million, for the error. Empty clouds have no error and completeness 0.
// Throws Error (kBadInput).
PartFigures CompareCloud(const std::filesystem::path& ply, const Similarity& truth_from_world,
                         const SceneIndex& scene, const TruthPoints& truth,
                         const CompareOptions& options);

// A surface in the frame of the truth.
PartFigures CompareSurface(const SurfaceIndex& result, const SceneIndex& scene,
                           const TruthPoints& truth, const CompareOptions& options);

}  // namespace stucco::evaluate
