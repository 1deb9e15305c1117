// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/facet_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco {
namespace {

// Photos of these hours that agree with each other on the whole.
PhotosLight LightOf(const std::vector<double>& hours) {
  PhotosLight light{std::vector<Eigen::Vector3d>(hours.size(), Eigen::Vector3d::Ones()),
                    std::vector<Falloff>(hours.size()),
                    {}};
  for (const double time_h : hours) light.photos.push_back({0, {}, time_h});
  return light;
}

// Of a facet that the photos show so bright.
std::vector<ColourRatio> RatiosOf(const std::vector<double>& brightness) {
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < std::ssize(brightness); ++a) {
    for (int b = a + 1; b < std::ssize(brightness); ++b) {
      const double log_ratio = std::log(brightness[a] / brightness[b]);
      ratios.push_back(
          {.a = a, .b = b, .log_ratio = Eigen::Vector3d::Constant(log_ratio), .weight = 500});
    }
  }
  return ratios;
}

TEST(LightOnFacet, BringsPhotosOfAnotherHourToTheOthers) {
  const PhotosLight light = LightOf({10, 10.05, 10.1, 10.15, 13, 13});
  const PhotosLight on_facet = LightOnFacet(light, RatiosOf({1, 1, 1, 1, 1.5, 1}));
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(on_facet.gains[i][1], 1, 0.02);
  EXPECT_NEAR(on_facet.gains[4][1], 1 / 1.5, 0.03);
  EXPECT_NEAR(on_facet.gains[5][1], 1, 0.02);
}

TEST(LightOnFacet, IsThatOfThePhotosWhereTheSunHasNotMoved) {
  const PhotosLight light = LightOf({10, 10.02, 10.02, 10.04});
  const PhotosLight on_facet = LightOnFacet(light, RatiosOf({1, 1.5, 1, 1}));
  for (const Eigen::Vector3d& gain : on_facet.gains) EXPECT_NEAR(gain[0], 1, 0.06);
}

TEST(LightOnFacet, GoesByGainsAndFalloffsThatAreKnown) {
  PhotosLight light = LightOf({10, 13, 13});
  light.gains[1] = Eigen::Vector3d::Constant(0.5);
  light.falloffs[2] = {{-0.2, 0}};
  std::vector<ColourRatio> ratios = RatiosOf({1, 2, std::exp(-0.1)});
  for (ColourRatio& ratio : ratios) {
    if (ratio.b == 2) ratio.corner_b = {0.5, 0.25};
  }
  const PhotosLight on_facet = LightOnFacet(light, ratios);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(on_facet.gains[i][k], light.gains[i][k], 1e-6);
  }
}

TEST(LightOnFacet, LeavesPhotosThatTheFacetIsNotComparedIn) {
  PhotosLight light = LightOf({10, 13, 16});
  light.gains[2] = {0.8, 0.9, 1.1};
  EXPECT_EQ(LightOnFacet(light, RatiosOf({1, 1.4})).gains[2], light.gains[2]);
  EXPECT_EQ(LightOnFacet(light, {}).gains, light.gains);
}

}  // namespace
}  // namespace stucco
