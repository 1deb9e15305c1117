// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/sightings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "tests/site/made_site.h"

namespace stucco {
namespace {

constexpr FieldOfView kField{0.7, 0.53};
constexpr double kReach_m = 90;

Frustum Picture(const Eigen::Vector3d& from, double yaw_rad, double pitch_rad) {
  return LevelFrustum(kField, from, yaw_rad, pitch_rad, kReach_m);
}

Viewpoint RandomPlace(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Viewpoint out;
  out.position = {300 * unit(random) - 150, 300 * unit(random) - 150, 30 + 40 * unit(random)};
  const int pictures = 1 + static_cast<int>(5 * unit(random));
  for (int i = 0; i < pictures; ++i) {
    const bool nadir = unit(random) < 0.3;
    const double pitch = nadir ? -std::numbers::pi / 2 : -std::numbers::pi / 2 * unit(random);
    out.pictures.push_back(Picture(out.position, 2 * std::numbers::pi * unit(random), pitch));
  }
  return out;
}

TEST(Sightings, AreThoseOfAskingEverySample) {
  MadeSiteOptions options{.safe_altitude_m = 30};
  const std::vector<Ring> town = RandomTown(4, 16);
  for (size_t i = 0; i < town.size(); ++i)
    options.heights_m.push_back(5.0 + static_cast<double>(i));
  const Site site = MadeSite(town, options);
  const SurfaceView view(site, kField, SampleSurface(site, {}), kReach_m);
  std::mt19937 random(5);
  size_t seen = 0;
  for (int i = 0; i < 60; ++i) {
    const Viewpoint place = RandomPlace(random);
    std::vector<Sighting> expected;
    for (uint32_t s = 0; s < view.samples.size(); ++s) {
      const SurfaceSample& sample = view.samples[s];
      const Eigen::Vector3d ray = place.position - sample.position;
      if (!(ray.dot(sample.normal) > 1e-3 * ray.norm())) continue;
      if (!view.model.Sees(place.position, sample.position)) continue;
      Sighting sighting{s, false};
      bool shown = false;
      for (const Frustum& picture : place.pictures) {
        if (!picture.Contains(sample.position)) continue;
        shown = true;
        sighting.nadir |= picture.forward.z() < -1 + 1e-12;
      }
      if (shown) expected.push_back(sighting);
    }
    const std::vector<Sighting> found = SightingsFrom(place, view);
    ASSERT_EQ(found.size(), expected.size());
    for (size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k].sample, expected[k].sample);
      EXPECT_EQ(found[k].nadir, expected[k].nadir);
    }
    seen += found.size();
  }
  EXPECT_GT(seen, 5000U);
}

TEST(Sightings, APlaceWithoutPicturesSeesNothing) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10)}, {.heights_m = {10}});
  const SurfaceView view(site, kField, SampleSurface(site, {}), kReach_m);
  const Eigen::Vector3d above(5, 5, 40);
  EXPECT_TRUE(SightingsFrom({above, {}}, view).empty());
  EXPECT_FALSE(SightingsFrom({above, {Picture(above, 0, -std::numbers::pi / 2)}}, view).empty());
}

TEST(SampleIndex, NearFindsAllOfTheSquareAndNothingBeyondItsCells) {
  const Site site = MadeSite(RandomTown(4, 16), {.safe_altitude_m = 30});
  const std::vector<SurfaceSample> samples = SampleSurface(site, {});
  const double cell = 12;
  const SampleIndex index(samples, cell);
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(0, 0), {-40, 25}, {500, 0}}) {
    const double half_width = 30;
    std::vector<uint32_t> found = index.Near(place, half_width);
    std::ranges::sort(found);
    EXPECT_EQ(found.empty(), place.x() == 500);
    for (uint32_t s = 0; s < samples.size(); ++s) {
      const double away = (samples[s].position.head<2>() - place).cwiseAbs().maxCoeff();
      const bool is_found = std::ranges::binary_search(found, s);
      if (away <= half_width) {
        EXPECT_TRUE(is_found);
      }
      if (away > half_width + cell) {
        EXPECT_FALSE(is_found);
      }
    }
  }
}

}  // namespace
}  // namespace stucco
