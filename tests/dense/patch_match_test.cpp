// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "survey/error.h"
#include "tests/dense/made_views.h"

namespace stucco::test {
namespace {

using Pyramids = std::vector<std::shared_ptr<const ViewPyramid>>;

Pyramids MakePyramids(int count, const std::vector<MadePlane>& planes) {
  Pyramids pyramids;
  for (const Pose& pose : PosesAround(count)) pyramids.push_back(MadePyramid(pose, planes));
  return pyramids;
}

// The photo at `index` against all others; a few sparse points as calibration would give them.
PatchMatchInput InputOf(const Pyramids& pyramids, const std::vector<MadePlane>& planes, int index) {
  PatchMatchInput input;
  input.reference = pyramids[index];
  for (int i = 0; i < static_cast<int>(pyramids.size()); ++i) {
    if (i != index) input.sources.push_back(pyramids[i]);
  }
  for (int k = 0; k < 40; ++k) {
    const auto x = static_cast<float>(10 + k * 37 % 180);
    const auto y = static_cast<float>(10 + k * 53 % 130);
    const auto hit = FirstHit(pyramids[index]->cameras[0], planes, x, y);
    if (hit) input.seeds.push_back({x, y, static_cast<float>(hit->depth)});
  }
  return input;
}

PatchMatchOptions Options() {
  return {.min_depth = 2.5f, .max_depth = 9, .seed = 1};
}

struct Quality {
  double found = 0;         // share of the pixels at least 12 from the border
  double within = 0;        // share of the found depths within one per cent
  double normal_error = 0;  // median, radians
};

Quality Measure(const DepthMap& map, const PinholeCamera& view,
                const std::vector<MadePlane>& planes) {
  const DepthMap truth = TrueDepths(view, planes);
  Quality quality;
  int total = 0, found = 0, within = 0;
  std::vector<float> angles;
  for (int y = 12; y < map.height - 12; ++y) {
    for (int x = 12; x < map.width - 12; ++x) {
      const size_t i = map.Index(x, y);
      if (truth.depths[i] <= 0) continue;
      ++total;
      if (map.depths[i] <= 0) continue;
      ++found;
      within += std::abs(map.depths[i] - truth.depths[i]) < 0.01f * truth.depths[i];
      angles.push_back(std::acos(std::clamp(map.Normal(i).dot(truth.Normal(i)), -1.0f, 1.0f)));
    }
  }
  if (found == 0) return quality;
  std::nth_element(angles.begin(), angles.begin() + angles.size() / 2, angles.end());
  return {double(found) / total, double(within) / found, angles[angles.size() / 2]};
}

TEST(MatchDepths, FindsASlantedWall) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = MakePyramids(4, planes);
  const DepthMap map = MatchDepths(InputOf(pyramids, planes, 0), Options());
  const Quality quality = Measure(map, pyramids[0]->cameras[0], planes);
  EXPECT_GT(quality.found, 0.95);
  EXPECT_GT(quality.within, 0.95);
  EXPECT_LT(quality.normal_error, 0.15);
}

TEST(MatchDepths, FindsItWithoutSparsePointsToo) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = MakePyramids(3, planes);
  PatchMatchInput input = InputOf(pyramids, planes, 0);
  input.seeds.clear();
  const Quality quality = Measure(MatchDepths(input, Options()), pyramids[0]->cameras[0], planes);
  EXPECT_GT(quality.found, 0.9);
  EXPECT_GT(quality.within, 0.9);
}

TEST(MatchDepths, SecondPassDoesNotHurt) {
  const std::vector<MadePlane> planes = TwoWalls();
  const Pyramids pyramids = MakePyramids(3, planes);
  std::vector<DepthMap> first;
  for (int i = 0; i < 3; ++i) {
    first.push_back(MatchDepths(InputOf(pyramids, planes, i), Options()));
  }
  PatchMatchInput input = InputOf(pyramids, planes, 0);
  input.start = &first[0];
  input.source_maps = {&first[1], &first[2]};
  const DepthMap second = MatchDepths(input, Options());
  const Quality before = Measure(first[0], pyramids[0]->cameras[0], planes);
  const Quality after = Measure(second, pyramids[0]->cameras[0], planes);
  EXPECT_GT(before.within, 0.93);
  EXPECT_GE(after.within, before.within - 0.002);
  EXPECT_GE(after.found, before.found - 0.01);
}

// What other maps lack is no fault of a match: its cost would keep the depth out of the cloud.
TEST(MatchDepths, CostsAreThoseOfMatchingAlone) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = MakePyramids(3, planes);
  const DepthMap first = MatchDepths(InputOf(pyramids, planes, 0), Options());
  PatchMatchInput input = InputOf(pyramids, planes, 0);
  input.start = &first;
  const DepthMap nothing = EmptyDepthMap(200, 150);
  input.source_maps = {&nothing, &nothing};
  const DepthMap map = MatchDepths(input, Options());
  std::vector<uint8_t> costs;
  for (int y = 12; y < map.height - 12; ++y) {
    for (int x = 12; x < map.width - 12; ++x) {
      if (map.depths[map.Index(x, y)] > 0) costs.push_back(map.costs[map.Index(x, y)]);
    }
  }
  ASSERT_GT(costs.size(), 15000u);
  std::ranges::sort(costs);
  EXPECT_LT(costs[costs.size() / 2], 0.1 * 127);
}

// The same pictures with as little contrast as walls in the shade have.
Pyramids InTheShade(const Pyramids& pyramids, float contrast) {
  Pyramids shaded;
  for (const auto& pyramid : pyramids) {
    auto dark = std::make_shared<ViewPyramid>(*pyramid);
    for (PackedImage& image : dark->images) {
      for (uint8_t& grey : image.gray) {
        grey = static_cast<uint8_t>(std::lround(40 + contrast * (static_cast<float>(grey) - 128)));
      }
      image = Pack(image.width, image.height, image.gray);
    }
    shaded.push_back(std::move(dark));
  }
  return shaded;
}

TEST(MatchDepths, FindsAWallInTheShade) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = InTheShade(MakePyramids(4, planes), 0.12f);
  const DepthMap map = MatchDepths(InputOf(pyramids, planes, 0), Options());
  const Quality quality = Measure(map, pyramids[0]->cameras[0], planes);
  EXPECT_GT(quality.found, 0.6);
  EXPECT_GT(quality.within, 0.9);
}

TEST(MatchDepths, GivesTheSameTwice) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = MakePyramids(3, planes);
  const PatchMatchInput input = InputOf(pyramids, planes, 1);
  const PatchMatchOptions options = {.iterations = 1, .min_depth = 2.5f, .max_depth = 9, .seed = 1};
  const std::string first = Serialize(MatchDepths(input, options));
  EXPECT_EQ(first, Serialize(MatchDepths(input, options)));
}

TEST(MatchDepths, LeavesFlatSkyEmpty) {
  // The wall covers the lower half; above it is even grey.
  MadePlane wall{{0, 1.5, 5}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 4, 1.5};
  const std::vector<MadePlane> planes = {wall};
  const Pyramids pyramids = MakePyramids(3, planes);
  const DepthMap map = MatchDepths(InputOf(pyramids, planes, 0), Options());
  int sky = 0, sky_found = 0;
  for (int y = 0; y < 68; ++y) {  // the wall begins at row 74.5
    for (int x = 0; x < map.width; ++x) {
      ++sky;
      sky_found += map.depths[map.Index(x, y)] > 0;
    }
  }
  EXPECT_LT(sky_found, 0.002 * sky);
  EXPECT_GT(Measure(map, pyramids[0]->cameras[0], planes).found, 0.9);
}

TEST(MatchDepths, StaysInItsBounds) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = MakePyramids(2, planes);
  const PatchMatchOptions options = {
      .iterations = 1, .min_depth = 4.6f, .max_depth = 5.2f, .seed = 1};
  const DepthMap map = MatchDepths(InputOf(pyramids, planes, 0), options);
  for (const float depth : map.depths) {
    if (depth == 0) continue;
    EXPECT_GE(depth, 4.6f);
    EXPECT_LE(depth, 5.2f);
  }
}

TEST(MatchDepths, NormalsFaceTheCamera) {
  const std::vector<MadePlane> planes = TwoWalls();
  const Pyramids pyramids = MakePyramids(3, planes);
  PatchMatchOptions options = Options();
  options.iterations = 1;
  const DepthMap map = MatchDepths(InputOf(pyramids, planes, 0), options);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const size_t i = map.Index(x, y);
      if (map.depths[i] <= 0) continue;
      const Eigen::Vector3f ray =
          pyramids[0]->cameras[0].Ray(static_cast<float>(x), static_cast<float>(y));
      EXPECT_LT(map.Normal(i).dot(ray), 0);
    }
  }
}

TEST(MatchDepths, StopsWhenAsked) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  const Pyramids pyramids = MakePyramids(2, planes);
  PatchMatchInput input = InputOf(pyramids, planes, 0);
  input.check_cancelled = [] { throw Error(ErrorKind::kInterrupted, "stopped"); };
  EXPECT_THROW(MatchDepths(input, Options()), Error);
}

}  // namespace
}  // namespace stucco::test
