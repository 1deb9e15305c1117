// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/matches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/features/descriptors.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Rows = std::vector<float>;

Rows RandomRows(int count, Random& random) {
  Rows rows(static_cast<size_t>(count) * kDescriptorSize);
  for (float& value : rows) value = static_cast<float>(random.Uniform(0, 1));
  return rows;
}

void CopyWithNoise(const Rows& from, int row, double noise, Rows& to, int to_row, Random& random) {
  for (int d = 0; d < kDescriptorSize; ++d) {
    to[to_row * kDescriptorSize + d] =
        from[row * kDescriptorSize + d] + static_cast<float>(random.Gauss(noise));
  }
}

struct BestTwo {
  int index = -1;
  double best = 10;  // angles
  double second = 10;
};

double Angle(const std::vector<int16_t>& a, int i, const std::vector<int16_t>& b, int j) {
  int64_t product = 0;
  for (int d = 0; d < kDescriptorSize; ++d) {
    product += int64_t{a[i * kDescriptorSize + d]} * b[j * kDescriptorSize + d];
  }
  return std::acos(std::min(1.0, product / (kDescriptorUnit * kDescriptorUnit)));
}

std::vector<BestTwo> NearestOf(const std::vector<int16_t>& a, const std::vector<int16_t>& b) {
  std::vector<BestTwo> result(a.size() / kDescriptorSize);
  for (int i = 0; i < static_cast<int>(result.size()); ++i) {
    BestTwo& nearest = result[i];
    for (int j = 0; j < static_cast<int>(b.size() / kDescriptorSize); ++j) {
      const double angle = Angle(a, i, b, j);
      if (angle < nearest.best) {
        nearest = {j, angle, nearest.best};
      } else {
        nearest.second = std::min(nearest.second, angle);
      }
    }
  }
  return result;
}

// The definition, written out.
std::vector<Match> ReferenceMatches(const std::vector<int16_t>& a, const std::vector<int16_t>& b,
                                    double ratio) {
  const auto of_a = NearestOf(a, b);
  const auto of_b = NearestOf(b, a);
  std::vector<Match> matches;
  for (int i = 0; i < static_cast<int>(of_a.size()); ++i) {
    const int j = of_a[i].index;
    if (j < 0 || of_b[j].index != i) continue;
    if (of_a[i].best < ratio * of_a[i].second && of_b[j].best < ratio * of_b[j].second) {
      matches.push_back({i, j});
    }
  }
  return matches;
}

TEST(MatchDescriptors, AgreesWithItsDefinition) {
  Random random(5);
  // More than one block of 512, and no multiple of it.
  const Rows first = RandomRows(300, random);
  Rows second = RandomRows(1100, random);
  for (int i = 0; i < 300; i += 2) {
    CopyWithNoise(first, i, 0.02 + 0.002 * i, second, (i * 37) % 1100, random);
  }
  const auto a = UnitRows(first);
  const auto b = UnitRows(second);
  for (const double ratio : {0.6, 0.8, 0.95}) {
    const auto expected = ReferenceMatches(a, b, ratio);
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(MatchDescriptors(a, b, ratio), expected);
    auto turned = MatchDescriptors(b, a, ratio);
    for (Match& m : turned) std::swap(m.first, m.second);
    std::sort(turned.begin(), turned.end());
    EXPECT_EQ(turned, expected);
  }
}

TEST(MatchDescriptors, RatioRefusesTwins) {
  Random random(6);
  const Rows first = RandomRows(20, random);
  Rows second = RandomRows(20, random);
  CopyWithNoise(first, 4, 0.01, second, 9, random);
  EXPECT_EQ(MatchDescriptors(UnitRows(first), UnitRows(second), 0.8), (std::vector<Match>{{4, 9}}));
  CopyWithNoise(first, 4, 0.01, second, 13, random);  // a window like the next one
  EXPECT_TRUE(MatchDescriptors(UnitRows(first), UnitRows(second), 0.8).empty());
  // The ratio counts in the other direction too.
  EXPECT_TRUE(MatchDescriptors(UnitRows(second), UnitRows(first), 0.8).empty());
}

TEST(MatchDescriptors, EqualDescriptorsOfOnePairMatch) {
  Random random(7);
  const auto rows = UnitRows(RandomRows(1, random));
  EXPECT_EQ(MatchDescriptors(rows, rows, 0.8), (std::vector<Match>{{0, 0}}));
}

TEST(MatchDescriptors, NothingFromNothing) {
  Random random(8);
  const auto rows = UnitRows(RandomRows(5, random));
  EXPECT_TRUE(MatchDescriptors({}, {}, 0.8).empty());
  EXPECT_TRUE(MatchDescriptors(rows, {}, 0.8).empty());
  EXPECT_TRUE(MatchDescriptors({}, rows, 0.8).empty());
}

}  // namespace
}  // namespace stucco::test
