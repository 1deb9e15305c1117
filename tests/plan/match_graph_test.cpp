// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/match_graph.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <optional>

#include "plan/camera/preset.h"
#include "plan/match/photo_graph.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector3d;

constexpr double kDegrees = std::numbers::pi / 180;

// In front of the south wall of a house of 60 x 20 x 20 m, `aside_m` from its middle, turned to it.
Hover Facing(double aside_m, double distance_m, double yaw_deg = 0, double pitch_deg = 0) {
  return {{aside_m, -distance_m, 10},
          {{.yaw_rad = yaw_deg * kDegrees,
            .pitch_rad = pitch_deg * kDegrees,
            .kind = ViewKind::kDipping,
            .targets = {}}}};
}

// What the graph expects of the second photo of a pair, as the first sees it.
class Pair : public testing::Test {
 protected:
  std::optional<Partner> Expect(const Hover& one, const Hover& other) {
    const CameraPreset camera = FindCamera("mavic-3e");
    const std::vector<Hover> hovers{one, other};
    const PhotoGraph photos({site_, camera, 1}, hovers);
    const std::vector<Partner> partners = photos.graph.PartnersOf(0);
    const auto found = std::ranges::find(partners, 1U, &Partner::photo);
    const float strength = found == partners.end() ? 0 : found->strength;
    if (one.position != other.position) {
      EXPECT_NEAR(photos.graph.StrengthBetween(0, photos.graph.sights(1)), strength, 1e-6);
    }
    return found == partners.end() ? std::nullopt : std::optional(*found);
  }
  Site site_ = MadeSite({Rectangle(-30, 0, 30, 20)}, {.heights_m = {20}});
};

TEST_F(Pair, NeighboursOnAWallAreStrongAndClose) {
  const auto partner = Expect(Facing(0, 12), Facing(6, 12));
  ASSERT_TRUE(partner);
  EXPECT_GT(partner->strength, 0.3);
  EXPECT_GT(partner->close_walls, kCloseShare);
  EXPECT_LE(partner->strength, 1);
}

TEST_F(Pair, ExpectsAlikeFromBothSides) {
  const auto one = Expect(Facing(0, 12), Facing(5, 20));
  const auto other = Expect(Facing(5, 20), Facing(0, 12));
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->strength, other->strength, 1e-6);
}

TEST_F(Pair, PhotosFromOnePlaceAreNoPartners) {
  EXPECT_FALSE(Expect(Facing(0, 12), Facing(0, 12, 10)));
}

TEST_F(Pair, PhotosBackToBackAreNoPartners) {
  EXPECT_FALSE(Expect(Facing(0, 12), Facing(6, 12, 180)));
}

TEST_F(Pair, GetsWeakerWithTheRatioOfDistances) {
  const auto near = Expect(Facing(0, 12), Facing(2, 18));
  const auto far = Expect(Facing(0, 12), Facing(2, 36));
  ASSERT_TRUE(near && far);
  EXPECT_GT(near->strength, 4 * far->strength);
  EXPECT_GT(near->close_walls, kCloseShare);
  EXPECT_LT(far->close_walls, kCloseShare);  // three times the distance
}

TEST_F(Pair, GetsWeakerWithTheAngle) {
  const auto from = [&](double angle_deg) {
    const double angle = angle_deg * kDegrees;
    return Expect(Facing(0, 12), Facing(-12 * std::sin(angle), 12 * std::cos(angle), angle_deg));
  };
  const auto frontal = from(15), slanted = from(75);
  ASSERT_TRUE(frontal && slanted);
  EXPECT_GT(frontal->strength, 2 * slanted->strength);
  EXPECT_GT(frontal->close_walls, kCloseShare);
  EXPECT_LT(from(55)->close_walls, kCloseShare);
}

Sight SightFrom(double azimuth_deg, double elevation_deg, float distance_m) {
  const double azimuth = azimuth_deg * kDegrees, elevation = elevation_deg * kDegrees;
  const Vector3d way(std::cos(elevation) * std::cos(azimuth),
                     std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return {0, 1, way.cast<float>(), distance_m};
}

Warp WarpOf(const Eigen::Vector3f& normal, const Sight& one, const Sight& other) {
  return WarpBetween(one, one.way.dot(normal), other, other.way.dot(normal));
}

TEST(Warp, OfLevelGround) {
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  // From straight above, ground seen at 30 degrees is squeezed to a half one way.
  const Warp slanted = WarpOf(up, SightFrom(0, 90, 10), SightFrom(40, 30, 10));
  EXPECT_NEAR(slanted.tilt, 2, 1e-4);
  EXPECT_NEAR(slanted.scale_squared, 2, 1e-4);
  // From opposite sides it is squeezed the same way; from a right angle, both ways.
  EXPECT_NEAR(WarpOf(up, SightFrom(0, 30, 10), SightFrom(180, 30, 10)).tilt, 1, 1e-3);
  EXPECT_NEAR(WarpOf(up, SightFrom(0, 30, 10), SightFrom(90, 30, 10)).tilt, 4, 1e-3);
  const Warp farther = WarpOf(up, SightFrom(0, 50, 10), SightFrom(0, 50, 30));
  EXPECT_NEAR(farther.tilt, 1, 1e-3);
  EXPECT_NEAR(farther.scale_squared, 9, 1e-3);
}

TEST(Warp, IsTheSameFromBothSides) {
  const Eigen::Vector3f normal = Eigen::Vector3f(0.1F, -0.2F, 1).normalized();
  const Sight one = SightFrom(10, 25, 14), other = SightFrom(70, 60, 31);
  EXPECT_NEAR(WarpOf(normal, one, other).tilt, WarpOf(normal, other, one).tilt, 1e-4);
  EXPECT_NEAR(WarpOf(normal, one, other).scale_squared, WarpOf(normal, other, one).scale_squared,
              1e-4);
}

TEST(Likeness, FallsWithTiltAndScale) {
  EXPECT_GT(Likeness({1, 1}), 0.98);
  EXPECT_LT(Likeness({8, 1}), 0.02);
  EXPECT_LT(Likeness({1, 256}), 0.02);
  for (int k = 1; k < 9; ++k) {
    EXPECT_LT(Likeness({1 + 0.5 * k, 1}), Likeness({0.5 + 0.5 * k, 1}));
    EXPECT_LT(Likeness({1, 1 + 5.0 * k}), Likeness({1, 5.0 * k - 4}));
  }
}

TEST(Richness, IsThatOfGroundWhichIsSeenFromAbove) {
  EXPECT_GT(Richness(SurfaceKind::kGround, 1), 0.9);
  EXPECT_LE(Richness(SurfaceKind::kGround, 1), 1);
  for (const float cosine : {0.2F, 0.5F, 1.0F}) {
    EXPECT_GT(Richness(SurfaceKind::kGround, cosine), Richness(SurfaceKind::kWall, cosine));
    EXPECT_GT(Richness(SurfaceKind::kWall, cosine), Richness(SurfaceKind::kRoof, cosine));
    EXPECT_GT(Richness(SurfaceKind::kRoof, cosine), Richness(SurfaceKind::kRoof, cosine / 2));
  }
  EXPECT_LT(Richness(SurfaceKind::kGround, 0.05F), 0.05);  // pavement at 87 degrees
}

TEST(PhotoSights, AWallThatFillsThePhotoFillsItsFrame) {
  const Site site = MadeSite({Rectangle(-30, 0, 30, 20)}, {.heights_m = {40}});
  const CameraPreset camera = FindCamera("mavic-3e");
  const std::vector<Hover> hovers{{{0, -12, 20}, {{.kind = ViewKind::kDipping, .targets = {}}}}};
  const PhotoGraph photos({site, camera, 1}, hovers);
  double share = 0;
  for (const Sight& sight : photos.graph.sights(0)) share += sight.share;
  EXPECT_NEAR(share, 1, 0.2);  // patches at the rim are in or out as wholes
}

TEST(PhotoGraph, KnowsWhoShowsASampleFromElsewhere) {
  const Site site = MadeSite({Rectangle(-30, 0, 30, 20)}, {.heights_m = {20}});
  const CameraPreset camera = FindCamera("mavic-3e");
  const std::vector<Hover> hovers{Facing(0, 12), Facing(2, 12), Facing(4, 12), Facing(0, 12, 180)};
  const PhotoGraph photos({site, camera, 1}, hovers);
  const auto showing = [&](const Eigen::Vector3d& position, uint32_t unwanted) {
    return photos.graph.PhotosThatShow(position, photos.graph.sights(0),
                                       [&](uint32_t photo) { return photo != unwanted; });
  };
  EXPECT_EQ(showing({0, -40, 2}, 9), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(showing({0, -40, 2}, 1), (std::vector<uint32_t>{0, 2}));
  EXPECT_EQ(showing(hovers[1].position, 9), (std::vector<uint32_t>{0, 2}));
}

TEST(PhotoGraph, CountsShotsByHover) {
  const Site site = MadeSite({Rectangle(-30, 0, 30, 20)}, {.heights_m = {20}});
  const CameraPreset camera = FindCamera("mavic-3e");
  Hover two = Facing(8, 12);
  two.shots.push_back(two.shots.front());
  const std::vector<Hover> hovers{Facing(0, 12), two, Facing(16, 12)};
  const PhotoGraph photos({site, camera, 2}, hovers);
  ASSERT_EQ(photos.places.size(), 4u);
  EXPECT_EQ(photos.places[2].hover, 1u);
  EXPECT_EQ(photos.places[2].shot, 1u);
  EXPECT_EQ(photos.graph.size(), 4U);
  EXPECT_EQ(photos.graph.position(2), hovers[1].position);
}

}  // namespace
}  // namespace stucco::plan
