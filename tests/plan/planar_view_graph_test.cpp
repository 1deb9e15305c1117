// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/planar/grid_hovers.h"
#include "plan/planar/view_graph.h"
#include "tests/plan/pair_reconstructability.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kFarthestMatch = 90;

// The definition: over all pairs of places.
double Reconstructability(const SurfaceSample& s, std::span<const Eigen::Vector3d> cameras) {
  double sum = 0;
  for (size_t i = 0; i < cameras.size(); ++i) {
    for (size_t j = i + 1; j < cameras.size(); ++j) {
      sum += PairReconstructability(s.position, s.normal, cameras[i], cameras[j], kFarthestMatch);
    }
  }
  return sum;
}

struct Town {
  Town()
      : site(MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12), Rectangle(35, 0, 50, 25)},
                      {.safe_altitude_m = 30, .margin_m = 20, .heights_m = {8, 15}})),
        view(site, FindCamera("mavic-3e").Field(), SampleSurface(site, {.spacing_m = 6}),
             kFarthestMatch),
        hovers(GridHovers(site, FindCamera("mavic-3e"),
                          {.forward_overlap = 0.6, .side_overlap = 0.5})) {}

  // By the definition, hover by hover.
  double Expected(uint32_t sample, const std::vector<uint32_t>& with) const {
    std::vector<Eigen::Vector3d> cameras;
    for (const uint32_t hover : with) {
      for (const Sighting& sighting : SightingsOf(view, hovers[hover])) {
        if (sighting.sample == sample) cameras.push_back(hovers[hover].position);
      }
    }
    return Reconstructability(view.samples[sample], cameras);
  }
  void ExpectAlike(const ViewGraph& graph) const {
    std::vector<uint32_t> with;
    for (uint32_t i = 0; i < graph.size(); ++i) {
      if (!graph.removed(i)) with.push_back(i);
    }
    for (uint32_t s = 0; s < view.samples.size(); s += 7) {
      const double expected = Expected(s, with);
      EXPECT_NEAR(graph.state(s).reconstructability, expected, 1e-6 + 3e-4 * expected);
    }
  }

  Site site;
  SurfaceView view;
  std::vector<Hover> hovers;
};

TEST(ViewGraph, HoldsTheReconstructabilityOfEverySample) {
  const Town town;
  ASSERT_GT(town.hovers.size(), 20U);
  ViewGraph graph(town.view, kFarthestMatch, 1);
  graph.AddAll(town.hovers);
  town.ExpectAlike(graph);
}

// Five photos of one hover are one place to a sample, whichever of them show it.
TEST(ViewGraph, PhotosOfOneHoverMakeNoPairs) {
  Town town;
  const auto sum_of = [&](const std::vector<Hover>& hovers) {
    ViewGraph graph(town.view, kFarthestMatch, 1);
    graph.AddAll(hovers);
    double sum = 0;
    for (const SampleState& state : graph.states()) sum += state.reconstructability;
    return sum;
  };
  EXPECT_EQ(sum_of({town.hovers[0]}), 0);
  std::vector<Hover> pair(town.hovers.begin(), town.hovers.begin() + 2);
  const double once = sum_of(pair);
  EXPECT_GT(once, 0);
  for (Hover& hover : pair) {
    const std::vector<Shot> shots = hover.shots;
    hover.shots.insert(hover.shots.end(), shots.begin(), shots.end());
  }
  EXPECT_EQ(sum_of(pair), once);
}

TEST(ViewGraph, WithoutScaleAllPairsCountInFull) {
  const Town town;
  ViewGraph by_scale(town.view, kFarthestMatch, 1);
  ViewGraph plain(town.view, kFarthestMatch, 1, /*by_scale=*/false);
  by_scale.AddAll(town.hovers);
  plain.AddAll(town.hovers);
  int less = 0;
  for (uint32_t s = 0; s < town.view.samples.size(); ++s) {
    const double in_full = plain.state(s).reconstructability;
    EXPECT_LE(by_scale.state(s).reconstructability, in_full);
    less += by_scale.state(s).reconstructability < 0.95 * in_full;
  }
  EXPECT_GT(less, 0);
}

TEST(ViewGraph, FollowsHoversThatGoAndComeBackElsewhere) {
  Town town;
  ViewGraph graph(town.view, kFarthestMatch, 2);
  graph.AddAll(town.hovers);
  for (uint32_t i = 0; i < graph.size(); i += 3) graph.Remove(i, graph.Shares(i));
  town.ExpectAlike(graph);
  for (uint32_t i = 0; i < graph.size(); i += 6) {
    town.hovers[i].position += Eigen::Vector3d(2, -1, 0);
    auto sightings = SightingsOf(town.view, town.hovers[i]);
    const auto shares = graph.SharesFrom(town.hovers[i].position, sightings);
    graph.Insert(i, town.hovers[i].position, std::move(sightings), shares);
  }
  town.ExpectAlike(graph);
}

TEST(ViewGraph, CountsHoversAndPhotosStraightDown) {
  const Town town;
  ViewGraph graph(town.view, kFarthestMatch, 1);
  graph.AddAll(town.hovers);
  std::vector<SampleState> expected(town.view.samples.size());
  for (uint32_t i = 0; i < graph.size(); ++i) {
    if (i == 4) graph.Remove(i, graph.Shares(i));
    if (i == 4) continue;
    for (const Sighting& sighting : SightingsOf(town.view, town.hovers[i])) {
      ++expected[sighting.sample].hovers;
      expected[sighting.sample].nadirs += sighting.nadir;
    }
  }
  for (uint32_t s = 0; s < expected.size(); ++s) {
    EXPECT_EQ(graph.state(s).hovers, expected[s].hovers);
    EXPECT_EQ(graph.state(s).nadirs, expected[s].nadirs);
  }
}

TEST(ViewGraph, IsTheSameAtAnyNumberOfThreads) {
  const Town town;
  ViewGraph one(town.view, kFarthestMatch, 1);
  ViewGraph two(town.view, kFarthestMatch, 2);
  one.AddAll(town.hovers);
  two.AddAll(town.hovers);
  for (uint32_t s = 0; s < town.view.samples.size(); ++s) {
    EXPECT_EQ(one.state(s).reconstructability, two.state(s).reconstructability);
  }
  EXPECT_EQ(one.Shares(5), two.Shares(5));
}

TEST(ViewGraph, WithoutHoversNothingIsSeen) {
  const Town town;
  ViewGraph graph(town.view, kFarthestMatch, 1);
  graph.AddAll({});
  EXPECT_EQ(graph.size(), 0U);
  EXPECT_EQ(graph.state(0).hovers, 0);
  EXPECT_EQ(graph.state(0).reconstructability, 0);
}

}  // namespace
}  // namespace stucco::plan
