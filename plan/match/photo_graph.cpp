// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/photo_graph.h"

#include <algorithm>
#include <utility>

#include "plan/match/corridors.h"
#include "site/surface_samples.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// A dozen samples or more in the frame of a photo from d_min.
constexpr double kSpacing_m = 2.5;
// Fields and streets match as well as what is to be captured.
constexpr double kGroundReach_m = 40;
// Twice that of ground joins what stands nearer, less what the grid of samples leaves out.
constexpr double kGap_m = 1.5 * kGroundReach_m;
// Heights above the ground; what is farther away than this is too small in a photo to count.
constexpr double kReachOfAltitude = 4;
constexpr double kLeastReach_m = 100;

double ReachOf(const Site& site) {
  return std::max(kLeastReach_m, kReachOfAltitude * site.safe_altitude_m);
}

Eigen::AlignedBox2d Surroundings(const Site& site, std::span<const Hover> hovers) {
  Eigen::AlignedBox2d out;
  for (const Hover& hover : hovers) out.extend(hover.position.head<2>());
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(ReachOf(site));
  return out.isEmpty() ? out : Eigen::AlignedBox2d(out.min() - reach, out.max() + reach);
}

}  // namespace

PhotoGraph::PhotoGraph(const MatchSetting& setting, std::span<const Hover> hovers)
    : corridors(CorridorsOf(setting.site, kGap_m)),
      view(setting.site, setting.camera.Field(),
           SampleSurface(setting.site, {.spacing_m = kSpacing_m,
                                        .ground_reach_m = kGroundReach_m,
                                        .ground_along = corridors,
                                        .area_only = false,
                                        .within = Surroundings(setting.site, hovers)}),
           ReachOf(setting.site)),
      patch_m2(kSpacing_m * kSpacing_m),
      graph(view) {
  for (uint32_t h = 0; h < hovers.size(); ++h) {
    for (uint32_t s = 0; s < hovers[h].shots.size(); ++s) places.push_back({h, s});
  }
  std::vector<std::vector<Sight>> sights(places.size());
  ParallelFor(places.size(), setting.threads, [&](size_t i) {
    const Hover& hover = hovers[places[i].hover];
    sights[i] = SightsOf(view, patch_m2, hover.position, hover.shots[places[i].shot]);
  });
  for (size_t i = 0; i < places.size(); ++i) {
    graph.Add(hovers[places[i].hover].position, std::move(sights[i]));
  }
}

}  // namespace stucco::plan
