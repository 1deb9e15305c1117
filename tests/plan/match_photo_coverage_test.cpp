// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plan/camera/preset.h"
#include "plan/match/photo_coverage.h"
#include "plan/match/photo_graph.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// At the south wall of a house of 60 x 20 x 20 m, turned by `yaw_deg`.
Hover At(double distance_m, double yaw_deg = 0) {
  return {{0, -distance_m, 10},
          {{.yaw_rad = yaw_deg * kDegree, .kind = ViewKind::kDipping, .targets = {}}}};
}

class Coverage : public testing::Test {
 protected:
  PhotoCoverage Of(const std::vector<Hover>& hovers) {
    const PhotoGraph photos({site_, camera_, 1}, hovers);
    return CoverageOf(photos, camera_.camera);
  }
  // On the south wall, the nearest to its middle.
  static CoveredPlace Middle(const PhotoCoverage& coverage) {
    return *std::ranges::min_element(coverage.places, {}, [](const CoveredPlace& place) {
      return (place.position_m - Eigen::Vector3d(0, 0, 10)).norm();
    });
  }
  CameraPreset camera_ = FindCamera("mavic-3e");
  Site site_ = MadeSite({Rectangle(-30, 0, 30, 20)}, {.heights_m = {20}});
};

TEST_F(Coverage, APixelStraightAheadIsItsDistanceOverTheFocalLength) {
  const PhotoCoverage coverage = Of({At(20)});
  const CoveredPlace middle = Middle(coverage);
  EXPECT_EQ(middle.photos, 1);
  EXPECT_EQ(middle.kind, SurfaceKind::kWall);
  EXPECT_NEAR(middle.gsd_m, 20 * camera_.PixelPitch() / camera_.camera.focal_m,
              0.03 * middle.gsd_m);
}

TEST_F(Coverage, CountsPhotosAndKeepsTheFinestPixel) {
  const CoveredPlace far = Middle(Of({At(40)}));
  const CoveredPlace both = Middle(Of({At(40), At(20)}));
  EXPECT_EQ(both.photos, 2);
  EXPECT_NEAR(both.gsd_m, far.gsd_m / 2, 0.03 * far.gsd_m);
}

TEST_F(Coverage, TheBackIsNotShown) {
  const PhotoCoverage coverage = Of({At(20)});
  EXPECT_NEAR(coverage.spacing_m, 2.5, 1e-9);
  int backs = 0;
  for (const CoveredPlace& place : coverage.places) {
    if (place.kind != SurfaceKind::kWall || place.normal.y() < 0.5) continue;
    ++backs;
    EXPECT_EQ(place.photos, 0);
    EXPECT_EQ(place.gsd_m, 0);
  }
  EXPECT_GT(backs, 0);
}

PhotoCoverage Walls(int fine, int coarse, SurfaceKind kind = SurfaceKind::kWall) {
  PhotoCoverage coverage;
  for (int i = 0; i < fine + coarse; ++i) {
    coverage.places.push_back({.kind = kind, .photos = 1, .gsd_m = i < fine ? 0.021 : 0.034});
  }
  return coverage;
}

TEST(CoverageWarnings, NameWhatIsCoarserThanAskedFor) {
  EXPECT_TRUE(CoverageWarnings({}, 0.02).empty());
  EXPECT_TRUE(CoverageWarnings(Walls(99, 1), 0.02).empty());
  EXPECT_TRUE(CoverageWarnings(Walls(10, 90, SurfaceKind::kGround), 0.02).empty());
  PhotoCoverage walls = Walls(75, 25);
  walls.places.push_back({.kind = SurfaceKind::kWall});  // shown by none
  EXPECT_THAT(CoverageWarnings(walls, 0.02),
              testing::ElementsAre(
                  testing::HasSubstr("2.0 cm asked for on 25 % of the walls (up to 3.4 cm)")));
}

}  // namespace
}  // namespace stucco::plan
