// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/fused_points.h"

#include <gtest/gtest.h>

#include "tests/survey/stage_support.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

constexpr size_t kCount = 5000;

// A point whose every number tells its place; as many views as its last digit.
FusedPoint Made(size_t i, std::vector<uint32_t>& views) {
  FusedPoint made;
  const auto number = static_cast<float>(i);
  made.point.position = {400'000.125 + static_cast<double>(i), 2, -3};
  made.point.normal = {0, number, 1};
  made.point.color = {static_cast<uint8_t>(i), static_cast<uint8_t>(i / 256), 9};
  made.spacing = number + 0.5f;
  views.assign(i % 10, static_cast<uint32_t>(i));
  made.point.views = views;
  return made;
}

void ExpectMade(const FusedPoint& point, size_t i) {
  std::vector<uint32_t> views;
  const FusedPoint made = Made(i, views);
  EXPECT_EQ(point.point.position, made.point.position);
  EXPECT_EQ(point.point.normal, made.point.normal);
  EXPECT_EQ(point.point.color, made.point.color);
  EXPECT_EQ(point.spacing, made.spacing);
  EXPECT_TRUE(std::ranges::equal(point.point.views, views)) << i;
}

TEST(FusedPoints, KeepTheirViewsWhenPutTogether) {
  std::vector<uint32_t> views;
  FusedPoints odd, all;
  for (size_t i = 0; i < 20; ++i) (i < 5 ? all : odd).Add(Made(i, views));
  all.Add(odd);
  ASSERT_EQ(all.size(), 20u);
  for (size_t i = 0; i < 20; ++i) ExpectMade(all.at(i), i);
}

TEST(FusedPointsFile, GivesBackWhatWasAddedAsOftenAsAsked) {
  const TemporaryFolder folder;
  FusedPointsFile file(folder.path());
  std::vector<uint32_t> views;
  for (size_t i = 0; i < kCount / 2; ++i) file.Add(Made(i, views));
  file.ForEach([](const FusedPoint&) {});
  for (size_t i = kCount / 2; i < kCount; ++i) file.Add(Made(i, views));
  ASSERT_EQ(file.size(), kCount);
  for (int time = 0; time < 2; ++time) {
    size_t visited = 0;
    file.ForEach([&](const FusedPoint& point) { ExpectMade(point, visited++); });
    EXPECT_EQ(visited, kCount);
  }
}

TEST(FusedPointsFile, IsNotSeenInTheFolder) {
  const TemporaryFolder folder;
  std::vector<uint32_t> views;
  FusedPointsFile file(folder.path());
  file.Add(Made(3, views));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FusedPointsFile, NamesAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  ExpectBadInput([&] { FusedPointsFile file(folder / "missing"); }, "missing");
}

}  // namespace
}  // namespace stucco::test
