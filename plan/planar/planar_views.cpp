// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/planar_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/planar/idle_shots.h"
#include "plan/planar/lost_walls.h"
#include "plan/planar/move_hovers.h"
#include "plan/planar/reconstructability.h"
#include "plan/planar/thin_out.h"
#include "plan/planar/view_graph.h"
#include "plan/space/obstacles.h"
#include "site/grid_cells.h"
#include "site/sightings.h"

namespace stucco::plan {
namespace {

// Those of four hovers from good angles. Zhou et al. 2020 ask for ten, but their photos tell of
// pairs each; five at one hover do not, and count once (docs/benchmarks.md has what either leaves).
constexpr double kGoodPairs = 6;
// Samples need not be denser than the photos change from hover to hover; windows and cornices are
// no part of the 2.5D model.
constexpr double kSpacingOfGrid = 0.75;
constexpr double kFinest_m = 3.5;
constexpr double kCoarsest_m = 8;
// Those of six hovers, on roofs so close that each photo shows a few metres of them: other surfaces
// have these by the hovers that others need. What few pairs cost dense matching is in
// docs/benchmarks.md, "Roofs just below the flight".
constexpr double kGoodPairsNear = 15;
// Ground counts up to this many d_min from the buildings.
constexpr double kGroundReach = 2;
constexpr int kMostRounds = 5;  // of moves and removals; the last ones gain next to nothing
// Of the mean grid step, for a move.
constexpr double kMoveOfGrid = 0.5;

double MeanStep(const GridStep& step) {
  return std::sqrt(step.forward_m * step.side_m);
}

double SpacingOf(const PlanarOptions& options, const GridStep& step) {
  if (options.sample_spacing_m > 0) return options.sample_spacing_m;
  return std::clamp(kSpacingOfGrid * MeanStep(step), kFinest_m, kCoarsest_m);
}

// Of the samples on each roof: as much finer as the hovers above it, as far as that tells anything.
std::vector<double> RoofSpacings(const Site& site, const GridOptions& grid, double spacing_m) {
  std::vector<double> out;
  for (const Footprint& footprint : site.footprints) {
    const double finer = spacing_m / FinerAbove(site, footprint, grid);
    out.push_back(std::min(spacing_m, std::max(finer, kFinest_m)));
  }
  return out;
}

double TauOf(const Site& site, const PlanarOptions& options) {
  if (options.tau_r > 0) return options.tau_r;
  return kGoodPairs * GoodPair(site.safe_altitude_m, options.d_max_m);
}

// What thinning out must leave, more where roofs are close below.
std::vector<Requirement> RequirementsOn(const Site& site, const ViewGraph& graph,
                                        const PlanarOptions& options) {
  const std::vector<SurfaceSample>& samples = graph.view().samples;
  std::vector<Requirement> out = RequirementsOf(graph, samples, TauOf(site, options));
  if (options.tau_r > 0) return out;
  for (size_t s = 0; s < samples.size(); ++s) {
    if (samples[s].footprint < 0) continue;
    const Footprint& footprint = site.footprints[samples[s].footprint];
    if (FinerAbove(site, footprint, options.grid) == 1) continue;
    const double distance = site.CeilingAt(samples[s].position.head<2>()) - samples[s].position.z();
    out[s].reconstructability = std::min(graph.state(s).reconstructability,
                                         kGoodPairsNear * GoodPair(distance, options.d_max_m));
  }
  return out;
}

// The grid less what was removed.
std::vector<Hover> Kept(const std::vector<Hover>& grid, const ViewGraph& graph) {
  std::vector<Hover> out;
  for (uint32_t i = 0; i < grid.size(); ++i) {
    if (!graph.removed(i)) out.push_back(grid[i]);
  }
  return out;
}

// Takes turns at removing and moving the hovers of the grid, the first in the graph.
void ThinOut(ViewGraph& graph, const MoveSetting& setting, std::vector<Hover>& grid,
             Progress& progress) {
  const auto count = static_cast<uint32_t>(grid.size());
  for (int round = 0; round < kMostRounds; ++round) {
    const size_t moved = round == 0 ? 0 : MoveHovers(graph, setting, grid, progress);
    const size_t removed = RemoveRedundant(graph, setting.requirements, count, progress);
    if (round > 0 && moved == 0 && removed == 0) break;
  }
}

std::vector<Hover> Joined(std::vector<Hover> a, std::span<const Hover> b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double Square(double value) {
  return value * value;
}

}  // namespace

std::vector<Hover> PlanarViews(const Site& site, const CameraPreset& camera,
                               const PlanarOptions& options, std::span<const Hover> dipping,
                               Progress& progress) {
  const std::vector<Hover> full = Joined(GridHovers(site, camera, options.grid),
                                         HoversAboveHighRoofs(site, camera, options.grid));
  if (full.empty()) return {};
  const GridStep step = StepOf(site, camera, options.grid);
  const double spacing = SpacingOf(options, step);
  SampleOptions samples{.spacing_m = spacing, .ground_reach_m = kGroundReach * site.d_min_m};
  // First, so that nothing counts on them; by samples that stand for one area each.
  std::vector<Hover> grid = full;
  const size_t idle = DropIdleShots(
      SurfaceView(site, camera.Field(), SampleSurface(site, samples), options.d_max_m),
      Square(spacing), options.threads, grid);
  if (idle > 0) {
    progress.Note(
        fmt::format("{} photos of the full grid would show next to nothing of the area", idle));
  }
  samples.roof_spacings_m = RoofSpacings(site, options.grid, spacing);
  const SurfaceView view(site, camera.Field(), SampleSurface(site, samples), options.d_max_m);
  progress.Begin("planar views: what they see", 1);
  ViewGraph graph(view, options.d_max_m, options.threads);
  graph.AddAll(Joined(grid, dipping));
  progress.Advance();

  const double tau = TauOf(site, options);
  const Obstacles obstacles(site);
  const std::vector<Requirement> requirements = RequirementsOn(site, graph, options);
  ThinOut(graph,
          {.obstacles = obstacles,
           .requirements = requirements,
           .step_m = kMoveOfGrid * MeanStep(step),
           .axis = MainAxis(site.area),
           .tau_r = tau,
           .threads = options.threads},
          grid, progress);
  std::vector<Hover> out = Kept(grid, graph);
  // Last, as a photo that shows next to nothing may be the only one of a wall.
  const std::vector<Hover> kept = Joined(out, dipping);
  const auto lost =
      HoversForLostWalls(FacadeSight(site, camera, options.d_max_m, full),
                         FacadeSight(site, camera, options.d_max_m, kept), options.threads);
  for (const uint32_t hover : lost) PutBack(full[hover], out);
  return out;
}

}  // namespace stucco::plan
