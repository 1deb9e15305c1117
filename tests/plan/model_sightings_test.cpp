// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "plan/model/sightings.h"
#include "tests/plan/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kPi = std::numbers::pi;

Hover RandomHover(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Hover out;
  out.position = {300 * unit(random) - 150, 300 * unit(random) - 150, 30 + 40 * unit(random)};
  const int shots = 1 + static_cast<int>(5 * unit(random));
  for (int i = 0; i < shots; ++i) {
    const bool nadir = unit(random) < 0.3;
    out.shots.push_back({.yaw_rad = 2 * kPi * unit(random),
                         .pitch_rad = nadir ? -kPi / 2 : -kPi / 2 * unit(random),
                         .kind = nadir ? ViewKind::kNadir : ViewKind::kOblique,
                         .targets = {}});
  }
  return out;
}

TEST(Sightings, AreThoseOfAskingEverySample) {
  MadeSiteOptions options{.safe_altitude_m = 30};
  const std::vector<Ring> town = RandomTown(4, 16);
  for (size_t i = 0; i < town.size(); ++i)
    options.heights_m.push_back(5.0 + static_cast<double>(i));
  const Site site = MadeSite(town, options);
  const SurfaceView view(site, FindCamera("mavic-3e"), SampleSurface(site, {}), 90);
  std::mt19937 random(5);
  size_t seen = 0;
  for (int i = 0; i < 60; ++i) {
    const Hover hover = RandomHover(random);
    std::vector<Sighting> expected;
    for (uint32_t s = 0; s < view.samples.size(); ++s) {
      const SurfaceSample& sample = view.samples[s];
      const Eigen::Vector3d ray = hover.position - sample.position;
      if (!(ray.dot(sample.normal) > 1e-3 * ray.norm())) continue;
      if (!view.model.Sees(hover.position, sample.position)) continue;
      Sighting sighting{s, 0, false};
      for (const Shot& shot : hover.shots) {
        if (!FrustumOf(view.camera, hover.position, shot, 90).Contains(sample.position)) continue;
        ++sighting.shots;
        sighting.nadir |= shot.kind == ViewKind::kNadir;
      }
      if (sighting.shots > 0) expected.push_back(sighting);
    }
    const std::vector<Sighting> found = SightingsOf(view, hover);
    ASSERT_EQ(found.size(), expected.size());
    for (size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k].sample, expected[k].sample);
      EXPECT_EQ(found[k].shots, expected[k].shots);
      EXPECT_EQ(found[k].nadir, expected[k].nadir);
    }
    seen += found.size();
  }
  EXPECT_GT(seen, 5000U);
}

TEST(Sightings, AHoverWithoutPhotosSeesNothing) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10)}, {.heights_m = {10}});
  const SurfaceView view(site, FindCamera("mavic-3e"), SampleSurface(site, {}), 90);
  EXPECT_TRUE(SightingsOf(view, {{5, 5, 40}, {}}).empty());
  EXPECT_FALSE(SightingsOf(view, {{5, 5, 40}, {{.pitch_rad = -kPi / 2, .targets = {}}}}).empty());
}

}  // namespace
}  // namespace stucco::plan
