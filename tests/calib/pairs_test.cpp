// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "calib/features/descriptors.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Pairs = std::vector<std::pair<int, int>>;
using Positions = std::vector<std::optional<Eigen::Vector3d>>;

TEST(SelectPairs, TakesAllOfASmallSet) {
  const Pairs expected = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(SelectPairs({.exhaustive_below = 4}, Positions(4), {{}, {}, {}, {}}), expected);
  EXPECT_TRUE(SelectPairs({}, Positions(1), {{}}).empty());
  EXPECT_TRUE(SelectPairs({}, {}, {}).empty());
}

TEST(SelectPairs, TakesTheNearestByPosition) {
  Positions line;
  for (int i = 0; i < 20; ++i) line.emplace_back(Eigen::Vector3d(10.0 * i, 0, 100));
  const Pairs pairs = SelectPairs({.exhaustive_below = 5, .neighbours = 2, .followers = 0}, line,
                                  std::vector<std::vector<float>>(20));
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  const std::set<std::pair<int, int>> found(pairs.begin(), pairs.end());
  EXPECT_EQ(found.size(), pairs.size());
  for (int i = 0; i + 1 < 20; ++i) EXPECT_TRUE(found.contains({i, i + 1})) << i;
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, b);
    EXPECT_LE(b - a, 2);
  }
}

TEST(SelectPairs, FallsBackToAppearance) {
  // No positions; photos i and i + 10 look alike.
  std::vector<std::vector<float>> signatures(20, std::vector<float>(10, 0.0f));
  for (int i = 0; i < 20; ++i) signatures[i][i % 10] = 1;
  const Pairs pairs = SelectPairs({.exhaustive_below = 5, .neighbours = 1, .followers = 0},
                                  Positions(20), signatures);
  ASSERT_EQ(pairs.size(), 10u);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(pairs[i], std::make_pair(i, i + 10));
}

TEST(SelectPairs, MixesPositionAndAppearance) {
  Positions positions;
  for (int i = 0; i < 10; ++i) positions.emplace_back(Eigen::Vector3d(10.0 * i, 0, 0));
  positions[9].reset();
  std::vector<std::vector<float>> signatures(10, std::vector<float>(2, 0.0f));
  for (auto& s : signatures) s[0] = 1;
  signatures[2] = signatures[9] = {0, 1};
  const Pairs pairs =
      SelectPairs({.exhaustive_below = 5, .neighbours = 1, .followers = 0}, positions, signatures);
  const std::set<std::pair<int, int>> found(pairs.begin(), pairs.end());
  EXPECT_TRUE(found.contains({2, 9}));  // no position, but alike
  EXPECT_TRUE(found.contains({7, 8}));  // near
}

TEST(MostAlike, PairsEachPhotoWithThoseThatLookLikeIt) {
  const std::vector<std::vector<float>> signatures = {{1, 0}, {0, 1}, {0.8f, 0.6f}, {}};
  EXPECT_EQ(MostAlike(signatures, 1, 1), (Pairs{{0, 2}, {1, 2}}));
  EXPECT_EQ(MostAlike(signatures, 5, 2), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_TRUE(MostAlike({}, 5, 2).empty());
}

TEST(SelectPairs, TakesWhatFollows) {
  const Pairs pairs = SelectPairs({.exhaustive_below = 2, .neighbours = 1, .followers = 2},
                                  Positions(4), std::vector<std::vector<float>>(4));
  EXPECT_EQ(pairs, (Pairs{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(SelectPairs, TakesNeighboursInOrderWhereTheGpsStoodStill) {
  const Positions still(30, Eigen::Vector3d(1, 2, 3));
  for (const auto& [a, b] : SelectPairs({.exhaustive_below = 5, .neighbours = 4, .followers = 0},
                                        still, std::vector<std::vector<float>>(30))) {
    EXPECT_LE(b - a, 4);
  }
}

TEST(SelectPairs, SurvivesPhotosWithoutAnything) {
  EXPECT_TRUE(SelectPairs({.exhaustive_below = 2, .neighbours = 3, .followers = 0}, Positions(8),
                          std::vector<std::vector<float>>(8))
                  .empty());
}

// Descriptors around ten centres that belong to a place; some are common to all places.
Features FeaturesOfPlace(int place, uint32_t seed) {
  Random random(seed);
  Features features;
  for (int i = 0; i < 300; ++i) {
    const int word = random.Index(3) == 0 ? 100 + random.Index(10) : place * 10 + random.Index(10);
    Random center(1000 + word);
    std::array<uint8_t, 128> descriptor{};
    for (uint8_t& value : descriptor) {
      const double mean = center.Uniform(0, 1) < 0.3 ? center.Uniform(60, 120) : 0;
      value = static_cast<uint8_t>(std::clamp(mean + random.Gauss(8), 0.0, 255.0));
    }
    features.descriptors.push_back(descriptor);
    features.keypoints.push_back({});
  }
  return features;
}

TEST(Signature, FindsPhotosOfTheSamePlace) {
  constexpr int kPlaces = 5;
  std::vector<Features> photos;
  std::vector<int16_t> samples;
  for (int i = 0; i < 3 * kPlaces; ++i) {
    photos.push_back(FeaturesOfPlace(i % kPlaces, 50 + i));
    const auto rows = UnitDescriptors(photos.back());
    samples.insert(samples.end(), rows.begin(), rows.begin() + 100 * kDescriptorSize);
  }
  const std::vector<float> words = TrainVocabulary(samples, 16);
  ASSERT_EQ(words.size(), 16u * kDescriptorSize);
  std::vector<std::vector<float>> signatures;
  for (const Features& features : photos) {
    signatures.push_back(Signature(features, words));
    double squares = 0;
    for (const float v : signatures.back()) squares += double{v} * v;
    EXPECT_NEAR(squares, 1, 1e-4);
  }
  const Pairs pairs = SelectPairs({.exhaustive_below = 2, .neighbours = 2, .followers = 0},
                                  Positions(photos.size()), signatures);
  ASSERT_EQ(pairs.size(), 3u * kPlaces);
  for (const auto& [a, b] : pairs) EXPECT_EQ(a % kPlaces, b % kPlaces) << a << " " << b;
}

TEST(Signature, UsesManyDescriptorsAlike) {
  Features many = FeaturesOfPlace(1, 3);
  const size_t once = many.descriptors.size();
  for (int copy = 0; copy < 4; ++copy) {
    for (size_t i = 0; i < once; ++i) {
      many.descriptors.push_back(many.descriptors[i]);
      many.keypoints.push_back({});
    }
  }
  const std::vector<float> words = TrainVocabulary(UnitDescriptors(FeaturesOfPlace(1, 4)), 8);
  const auto a = Signature(FeaturesOfPlace(1, 3), words);
  const auto b = Signature(many, words);
  double product = 0;
  for (size_t i = 0; i < a.size(); ++i) product += double{a[i]} * b[i];
  EXPECT_GT(product, 0.9);
}

TEST(TrainVocabulary, HandlesFewSamples) {
  EXPECT_TRUE(TrainVocabulary({}, 8).empty());
  const auto rows = UnitDescriptors(FeaturesOfPlace(0, 1));
  const std::vector<int16_t> three(rows.begin(), rows.begin() + 3 * kDescriptorSize);
  EXPECT_EQ(TrainVocabulary(three, 8).size(), 8u * kDescriptorSize);
  EXPECT_TRUE(Signature({}, TrainVocabulary(three, 8)).empty());
  EXPECT_TRUE(Signature(FeaturesOfPlace(0, 1), {}).empty());
}

}  // namespace
}  // namespace stucco::test
