// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::Colour;
using test::MakeWall;
using test::WallPicture;

// A wall of 256 x 192 texels, painted by one photo.
FacetPicture Wall() {
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), Eigen::Vector3d::UnitZ(), 1.0 / 64, 4096);
  FacetPicture wall{WallPicture(grid), {}};
  wall.labels.assign(grid.size(), 1);
  return wall;
}

using Repaint = std::function<Colour(int x, int y, const Colour& before)>;

FacetPicture Painted(const FacetPicture& before, const Repaint& repaint) {
  FacetPicture after = before;
  for (int y = 0; y < after.picture.height_px; ++y) {
    for (int x = 0; x < after.picture.width_px; ++x) {
      uint8_t* rgb = after.picture.Pixel(x, y);
      const Colour colour = repaint(x, y, Colour(rgb[0], rgb[1], rgb[2]));
      for (int k = 0; k < 3; ++k) {
        rgb[k] = static_cast<uint8_t>(std::clamp(colour[k], 0.0, 255.0));
      }
    }
  }
  return after;
}

FacetChanges Changes(const FacetPicture& before, const FacetPicture& after) {
  const std::vector<uint8_t> all(before.labels.size(), 1);
  return FindChanges(before, after, all, all);
}

double Changed(const FacetChanges& changes) {
  return changes.repainted + changes.other;
}

TEST(FindChanges, NothingChangedInTheSamePicture) {
  const FacetChanges changes = Changes(Wall(), Wall());
  EXPECT_DOUBLE_EQ(changes.compared, 1);
  EXPECT_DOUBLE_EQ(Changed(changes), 0);
}

TEST(FindChanges, LightIsNoChange) {
  const FacetPicture wall = Wall();
  // In the shade on the left, which is bluer; all of it exposed less.
  const FacetPicture shaded = Painted(wall, [](int x, int, const Colour& c) -> Colour {
    return x < 90 ? Colour(0.45 * c.x(), 0.5 * c.y(), 0.55 * c.z()) : 0.8 * c;
  });
  EXPECT_LT(Changed(Changes(wall, shaded)), 0.02);
}

TEST(FindChanges, SmallShiftIsNoChange) {
  const FacetPicture wall = Wall();
  const FacetPicture shifted = Painted(wall, [&](int x, int y, const Colour&) -> Colour {
    const uint8_t* rgb = wall.picture.Pixel(std::min(255, x + 5), y);
    return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
  });
  EXPECT_LT(Changed(Changes(wall, shifted)), 0.05);
}

TEST(FindChanges, NewColourIsFound) {
  const FacetPicture wall = Wall();
  const FacetPicture repainted = Painted(wall, [](int x, int, const Colour& c) -> Colour {
    return x < 128 ? Colour(c.x(), 0.55 * c.y(), 0.5 * c.z()) : c;
  });
  const FacetChanges changes = Changes(wall, repainted);
  EXPECT_NEAR(changes.repainted, 0.5, 0.05);
  EXPECT_LT(changes.other, 0.02);
}

TEST(FindChanges, NewPatternIsFound) {
  const FacetPicture wall = Wall();
  const FacetPicture with_sign = Painted(wall, [](int x, int y, const Colour& c) -> Colour {
    const bool in_sign = x >= 64 && x < 192 && y >= 48 && y < 144;
    if (!in_sign) return c;
    return (x / 9 + y / 7) % 2 == 0 ? Colour(20, 60, 160) : Colour(230, 230, 230);
  });
  const FacetChanges changes = Changes(wall, with_sign);
  EXPECT_NEAR(changes.other, 0.25, 0.08);
  ASSERT_EQ(changes.boxes.size(), 1u);
  const ChangedBox& box = changes.boxes[0];
  EXPECT_TRUE(box.pattern);
  EXPECT_NEAR(box.left, 64, 16);
  EXPECT_NEAR(box.left + box.width, 192, 16);
  EXPECT_NEAR(box.top, 48, 16);
  EXPECT_NEAR(box.top + box.height, 144, 16);
  EXPECT_NEAR(box.share, changes.repainted + changes.other, 1e-9);
}

TEST(FindChanges, WhatNobodySeesIsOutdatedWhereAllAroundItChanged) {
  const FacetPicture wall = Wall();
  FacetPicture after = Painted(wall, [](int x, int, const Colour& c) -> Colour {
    return x < 128 ? Colour(c.x(), 0.55 * c.y(), 0.5 * c.z()) : c;
  });
  for (const int left : {32, 176}) {  // a hole in either half
    for (int y = 64; y < 112; ++y) {
      for (int x = left; x < left + 48; ++x) after.labels[static_cast<size_t>(y) * 256 + x] = 255;
    }
  }
  const FacetChanges changes = Changes(wall, after);
  const auto is_outdated = [&](int x, int y, double dimmed) {
    const uint8_t* rgb = wall.picture.Pixel(x, y);
    std::array<uint8_t, 3> dim = {};
    for (int k = 0; k < 3; ++k) dim[k] = static_cast<uint8_t>(dimmed * rgb[k]);
    return changes.IsOutdated(x, y, dim.data());
  };
  const auto share = [&](int x0, int y0, double dimmed) {
    int count = 0;
    for (int y = y0; y < y0 + 32; ++y) {
      for (int x = x0; x < x0 + 32; ++x) count += is_outdated(x, y, dimmed);
    }
    return count / (32.0 * 32);
  };
  EXPECT_GT(share(40, 72, 1), 0.4);     // the wall's blocks have other colours side by side
  EXPECT_GT(share(40, 72, 0.45), 0.4);  // below eaves
  EXPECT_EQ(share(40, 72, 0.1), 0);     // something dark in it
  EXPECT_EQ(share(184, 72, 1), 0);
}

TEST(FindChanges, PlacesApartAreListedTheLargestFirst) {
  const FacetPicture wall = Wall();
  const FacetPicture painted = Painted(wall, [](int x, int y, const Colour& c) -> Colour {
    const bool small = x < 64 && y < 64, large = x >= 128 && y >= 64;
    return small || large ? Colour(c.x(), 0.55 * c.y(), 0.5 * c.z()) : c;
  });
  const FacetChanges changes = Changes(wall, painted);
  ASSERT_EQ(changes.boxes.size(), 2u);
  EXPECT_GT(changes.boxes[0].share, changes.boxes[1].share);
  EXPECT_GE(changes.boxes[0].left, 112);
  EXPECT_LE(changes.boxes[1].left + changes.boxes[1].width, 80);
  EXPECT_FALSE(changes.boxes[0].pattern);
}

// From another side eaves cover another part of the wall: that is no change, a wall all painted is.
TEST(FindChanges, FromAnotherSideOnlyMuchColourCounts) {
  const FacetPicture wall = Wall();
  const std::vector<uint8_t> all(wall.labels.size(), 1);
  const std::vector<uint8_t> none(wall.labels.size(), 0);
  const auto changed_above = [&](int row) {
    const FacetPicture after = Painted(wall, [=](int, int y, const Colour& c) -> Colour {
      return y < row ? Colour(c.x(), 0.55 * c.y(), 0.5 * c.z()) : c;
    });
    return FindChanges(wall, after, all, none);
  };
  EXPECT_EQ(Changed(changed_above(32)), 0);
  EXPECT_EQ(changed_above(32).compared, 0);
  EXPECT_TRUE(changed_above(32).boxes.empty());
  EXPECT_NEAR(changed_above(144).repainted, 0.75, 0.05);
  EXPECT_GT(Changed(Changes(wall, Painted(wall,
                                          [](int, int y, const Colour& c) -> Colour {
                                            return y < 32 ? Colour(c.x(), 0.55 * c.y(), 0.5 * c.z())
                                                          : c;
                                          }))),
            0.1);
}

// A shadow with slanting edges, as of eaves and a tree, a fifth bluer than the sun.
TEST(FindChanges, ShadowsAreToldApart) {
  const FacetPicture wall = Wall();
  const auto draw = [&](int from, int to) {
    return Painted(wall, [=](int x, int y, const Colour& c) -> Colour {
      const int along = x + y / 2;
      const bool in_shade = along % 40 >= from && along % 40 < to;
      return in_shade ? Colour(0.32 * c.x(), 0.35 * c.y(), 0.39 * c.z()) : c;
    });
  };
  const FacetChanges changes = Changes(draw(0, 14), draw(20, 34));
  EXPECT_LT(Changed(changes), 0.02);
  EXPECT_GT(changes.shaded, 0.1);
}

TEST(FindChanges, OnlyWhatBothShowIsCompared) {
  const FacetPicture wall = Wall();
  FacetPicture after = Painted(wall, [](int, int, const Colour&) { return Colour(255, 0, 0); });
  for (size_t i = 0; i < after.labels.size(); ++i) {
    if (i % 256 >= 64) after.labels[i] = 255;  // filled in, seen by nobody
  }
  const FacetChanges changes = Changes(wall, after);
  EXPECT_DOUBLE_EQ(changes.compared, 0.25);
  EXPECT_NEAR(changes.repainted + changes.other, 0.25, 0.03);
  const std::vector<uint8_t> all(wall.labels.size(), 1);
  std::vector<uint8_t> upper = all;
  std::fill(upper.begin() + static_cast<long>(upper.size() / 2), upper.end(), uint8_t{0});
  EXPECT_DOUBLE_EQ(FindChanges(wall, after, all, upper).compared, 0.125);
  std::ranges::fill(after.labels, uint8_t{0});
  EXPECT_DOUBLE_EQ(Changes(wall, after).compared, 0);
  EXPECT_DOUBLE_EQ(Changed(Changes(wall, after)), 0);
}

}  // namespace
}  // namespace stucco
