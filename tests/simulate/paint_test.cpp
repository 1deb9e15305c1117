// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/paint/paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "simulate/paint/internal/wall_look.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::simulate {
namespace {

constexpr Cladding kCladdings[] = {Cladding::kBrick,    Cladding::kPlaster, Cladding::kStone,
                                   Cladding::kConcrete, Cladding::kPanels,  Cladding::kGlass};
constexpr Covering kCoverings[] = {Covering::kTiles, Covering::kMembrane, Covering::kGravel,
                                   Covering::kMetal, Covering::kAsphalt,  Covering::kPaving,
                                   Covering::kGrass, Covering::kSoil,     Covering::kCrop};
constexpr PartKind kParts[] = {PartKind::kWindow,      PartKind::kDoor,    PartKind::kShopWindow,
                               PartKind::kBalconyDoor, PartKind::kBalcony, PartKind::kCornice,
                               PartKind::kLedge,       PartKind::kPlinth};

WallDesign Wall(Cladding cladding, double width_m, double height_m, uint64_t seed = 3) {
  WallDesign design;
  design.width_m = width_m;
  design.height_m = height_m;
  design.cladding = cladding;
  design.seed = seed;
  return design;
}

WallPart Part(PartKind kind, double left, double top, double right, double bottom) {
  WallPart part;
  part.kind = kind;
  part.top_left = {left, top};
  part.bottom_right = {right, bottom};
  return part;
}

// Every kind of part, and none.
WallDesign FullWall(Cladding cladding) {
  WallDesign design = Wall(cladding, 6.4, 7);
  design.floors_m = {3.2, 6.3};
  design.parts = {
      Part(PartKind::kCornice, 0, 0, 6.4, 0.4),     Part(PartKind::kPlinth, 0, 6.5, 6.4, 7),
      Part(PartKind::kWindow, 0.5, 1, 1.7, 2.4),    Part(PartKind::kBalconyDoor, 2.5, 0.8, 3.5, 3),
      Part(PartKind::kBalcony, 2.2, 2.2, 3.9, 3.3), Part(PartKind::kDoor, 0.5, 4.4, 1.7, 6.9),
      Part(PartKind::kShopWindow, 2, 4, 3.9, 6.8)};
  return design;
}

std::vector<double> Grey(const Image& image) {
  std::vector<double> grey;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const uint8_t* p = image.Pixel(x, y);
      grey.push_back(0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]);
    }
  }
  return grey;
}

// Pearson's correlation of a grey picture with itself, moved by (dx, dy).
double SelfCorrelation(const std::vector<double>& grey, int width, int height, int dx, int dy) {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0, n = 0;
  for (int y = 0; y + dy < height; ++y) {
    for (int x = 0; x + dx < width; ++x) {
      const double p = grey[static_cast<size_t>(y) * width + x];
      const double q = grey[static_cast<size_t>(y + dy) * width + x + dx];
      a += p;
      b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
      ++n;
    }
  }
  return (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
}

// Standard deviation of the difference of neighbours.
double Sharpness(const Image& image) {
  const std::vector<double> grey = Grey(image);
  double squares = 0;
  double count = 0;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x + 1 < image.width_px; ++x) {
      const size_t i = static_cast<size_t>(y) * image.width_px + x;
      squares += (grey[i + 1] - grey[i]) * (grey[i + 1] - grey[i]);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

double MeanDifference(const Image& a, const Image& b, int left, int top, int right, int bottom) {
  double sum = 0;
  double count = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      for (int c = 0; c < 3; ++c) {
        sum += std::abs(a.Pixel(x, y)[c] - b.Pixel(x, y)[c]);
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(Paint, PicturesHaveTheSizeOfTheWall) {
  const Image image = PaintWall(Wall(Cladding::kBrick, 2.345, 1.0), 0.01);
  EXPECT_EQ(image.width_px, 235);
  EXPECT_EQ(image.height_px, 100);
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(image.data.size(), 235u * 100 * 3);
  const Image coarse = PaintWall(Wall(Cladding::kStone, 2.345, 1.0), 0.05);
  EXPECT_EQ(coarse.width_px, 47);
  EXPECT_EQ(coarse.height_px, 20);
  const Image trim = PaintTrim(Wall(Cladding::kPlaster, 0.2, 1.5), 0.01);
  EXPECT_EQ(trim.width_px, 20);
  EXPECT_EQ(trim.height_px, 150);
}

TEST(Paint, TheSameDesignGivesTheSameBytesOnAnyThread) {
  std::vector<Image> alone;
  for (const Cladding cladding : kCladdings) alone.push_back(PaintWall(FullWall(cladding), 0.02));
  for (const Covering covering : kCoverings) {
    alone.push_back(PaintCovering({3, 2, covering, 1, 5}, 0.02));
  }
  std::vector<Image> together(alone.size());
  ParallelFor(together.size(), 4, [&](size_t i) {
    together[i] = i < std::size(kCladdings)
                      ? PaintWall(FullWall(kCladdings[i]), 0.02)
                      : PaintCovering({3, 2, kCoverings[i - std::size(kCladdings)], 1, 5}, 0.02);
  });
  for (size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(alone[i].data, together[i].data) << i;
}

// A picture is painted in tiles; where one ends must not be seen: what is painted of a wall does
// not change when the wall goes on to the right.
TEST(Paint, TilesAreNotSeen) {
  const WallDesign narrow = Wall(Cladding::kBrick, 1.5, 1.5);
  WallDesign wide = narrow;
  wide.width_m = 1.7;
  const Image a = PaintWall(narrow, 0.01);
  const Image b = PaintWall(wide, 0.01);
  EXPECT_EQ(MeanDifference(a, b, 0, 0, 150, 150), 0);
}

TEST(Paint, SeedsWallsAndPalettesDiffer) {
  const WallDesign one = Wall(Cladding::kBrick, 2, 2);
  WallDesign other_wall = one;
  other_wall.wall = 1;
  WallDesign other_palette = one;
  other_palette.palette = 1;
  const Image a = PaintWall(one, 0.01);
  EXPECT_GT(MeanDifference(a, PaintWall(Wall(Cladding::kBrick, 2, 2, 4), 0.01), 0, 0, 200, 200), 4);
  EXPECT_GT(MeanDifference(a, PaintWall(other_wall, 0.01), 0, 0, 200, 200), 4);
  EXPECT_GT(MeanDifference(a, PaintWall(other_palette, 0.01), 0, 0, 200, 200), 4);
}

// Tiles are as large and metal is as green on one face of a roof as on the other; moss is not.
TEST(Paint, FacesOfARoofHaveItsMaterialAndStainsOfTheirOwn) {
  const auto mean = [](const Image& image) {
    return std::accumulate(image.data.begin(), image.data.end(), 0.0) /
           static_cast<double>(image.data.size());
  };
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const Image one = PaintCovering({8, 8, Covering::kMetal, 0, seed, 0}, 0.04);
    const Image other = PaintCovering({8, 8, Covering::kMetal, 0, seed, 1}, 0.04);
    EXPECT_NE(one.data, other.data);
    EXPECT_NEAR(mean(one), mean(other), 5) << seed;
  }
}

TEST(Paint, PalettesAreTakenModulo) {
  for (const int palette : {-7, -1, 1000, 2147483647}) {
    WallDesign design = Wall(Cladding::kStone, 0.5, 0.5);
    design.palette = palette;
    EXPECT_EQ(PaintWall(design, 0.01).data.size(), 50u * 50 * 3);
  }
}

// Camera noise is one or two levels; a wall must show more between neighbours than that.
TEST(Paint, BareWallsAreSharpAtATexel) {
  for (const Cladding cladding : kCladdings) {
    EXPECT_GT(Sharpness(PaintWall(Wall(cladding, 3, 3), 0.01)), 1.5) << static_cast<int>(cladding);
  }
  for (const Covering covering : kCoverings) {
    EXPECT_GT(Sharpness(PaintCovering({3, 3, covering, 0, 8}, 0.01)), 1.5)
        << static_cast<int>(covering);
  }
}

// The largest correlation of a picture with itself moved by 0.4 m to 2.5 m.
double MostAlike(const Image& image) {
  const std::vector<double> grey = Grey(image);
  double most = 0;
  for (int d = 40; d <= 250; ++d) {
    most = std::max({most, SelfCorrelation(grey, image.width_px, image.height_px, d, 0),
                     SelfCorrelation(grey, image.width_px, image.height_px, 0, d)});
  }
  return most;
}

// Joints and seams come back, though never the whole picture with them; where there are none,
// nothing does.
TEST(Paint, NothingRepeats) {
  for (const Cladding cladding : {Cladding::kBrick, Cladding::kStone, Cladding::kPanels}) {
    EXPECT_LT(MostAlike(PaintWall(Wall(cladding, 5, 5), 0.01)), 0.87) << static_cast<int>(cladding);
  }
  for (const Covering covering : {Covering::kTiles, Covering::kMetal, Covering::kPaving}) {
    EXPECT_LT(MostAlike(PaintCovering({5, 5, covering, 0, 8}, 0.01)), 0.87)
        << static_cast<int>(covering);
  }
  for (const Cladding cladding : {Cladding::kPlaster, Cladding::kConcrete}) {
    EXPECT_LT(MostAlike(PaintWall(Wall(cladding, 5, 5), 0.01)), 0.6) << static_cast<int>(cladding);
  }
  for (const Covering covering : {Covering::kMembrane, Covering::kGravel, Covering::kAsphalt,
                                  Covering::kGrass, Covering::kSoil}) {
    EXPECT_LT(MostAlike(PaintCovering({5, 5, covering, 0, 8}, 0.01)), 0.6)
        << static_cast<int>(covering);
  }
}

TEST(Paint, BaysOfARepeatingWallAreTheSameToTheTexel) {
  WallDesign design = Wall(Cladding::kBrick, 9, 7);
  design.floors_m = {0.5, 3.5, 6.5};
  for (const double x : {1.0, 4.0, 7.0}) {
    for (const double y : {1.2, 4.2}) {
      design.parts.push_back(Part(PartKind::kWindow, x, y, x + 1.2, y + 1.5));
    }
  }
  const Image without = PaintWall(design, 0.02);
  design.repeated_bay_m = 3;
  const Image wall = PaintWall(design, 0.02);
  ASSERT_EQ(wall.width_px, without.width_px);
  ASSERT_EQ(wall.height_px, without.height_px);
  int differing = 0;
  for (int y = 25; y < 325; ++y) {
    for (int x = 0; x < 450; ++x) {
      const auto* reference = wall.Pixel(150 + x % 150, 25 + (y - 25) % 150);
      ASSERT_TRUE(std::equal(reference, reference + 3, wall.Pixel(x, y))) << x << " " << y;
      differing += !std::equal(reference, reference + 3, without.Pixel(x, y));
    }
  }
  EXPECT_GT(differing, 300 * 450 / 2);  // which they are not by themselves
  // Above and below the storeys nothing is copied.
  EXPECT_TRUE(
      std::equal(wall.data.begin(), wall.data.begin() + 25 * 450 * 3, without.data.begin()));
}

TEST(Paint, PartsArePaintedWhereTheyAre) {
  for (const PartKind kind : kParts) {
    WallDesign design = Wall(Cladding::kPlaster, 5, 5);
    const Image bare = PaintWall(design, 0.01);
    design.parts = {Part(kind, 1.5, 1.5, 3, 3.5)};
    const Image with = PaintWall(design, 0.01);
    EXPECT_GT(MeanDifference(bare, with, 155, 155, 295, 345), 10) << static_cast<int>(kind);
    // Surrounds, sills and the streaks below them end near the part.
    EXPECT_EQ(MeanDifference(bare, with, 0, 0, 500, 100), 0) << static_cast<int>(kind);
    EXPECT_EQ(MeanDifference(bare, with, 0, 0, 40, 500), 0) << static_cast<int>(kind);
    EXPECT_EQ(MeanDifference(bare, with, 430, 0, 500, 500), 0) << static_cast<int>(kind);
  }
}

WallDesign CornicedWall(Cladding cladding, uint64_t seed, std::vector<double> floors_m) {
  WallDesign design = Wall(cladding, 5, 4, seed);
  design.floors_m = std::move(floors_m);
  design.parts = {Part(PartKind::kCornice, 0, 0.1, 5, 0.45)};
  return design;
}

// A cornice stands out: belts, corner blocks, pipes and cables are behind it.
TEST(Paint, NothingIsPaintedOverACornice) {
  constexpr double kTexel_m = 0.02;
  for (const Cladding cladding : {Cladding::kBrick, Cladding::kPlaster, Cladding::kStone}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      const WallDesign design = CornicedWall(cladding, seed, {0.4, 3.4});
      const internal::WallLook look = internal::LookOf(design);
      internal::Tile tile{0, 0, 250, 22, static_cast<float>(kTexel_m), {}};
      tile.colours.resize(static_cast<size_t>(tile.width) * tile.height);
      internal::PaintPart(tile, look, design.parts[0]);
      const Image image = PaintWall(design, kTexel_m);
      for (int row = 6; row < tile.height; ++row) {
        for (int column = 0; column < tile.width; ++column) {
          const internal::Colour& colour = tile.At(column, row);
          ASSERT_NEAR(image.Pixel(column, row)[1], internal::FastSrgbCode(colour.g), 2)
              << "seed " << seed << " at " << column << " " << row;
        }
      }
    }
  }
}

TEST(Paint, NoBeltRunsIntoACornice) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const Image with = PaintWall(CornicedWall(Cladding::kPlaster, seed, {0.5}), 0.01);
    const Image without = PaintWall(CornicedWall(Cladding::kPlaster, seed, {}), 0.01);
    EXPECT_EQ(MeanDifference(with, without, 0, 10, 500, 50), 0) << seed;
  }
}

TEST(Paint, VariantsOfAWindowDiffer) {
  WallDesign design = Wall(Cladding::kPlaster, 3, 3);
  design.parts = {Part(PartKind::kWindow, 1, 1, 2, 2.4)};
  std::set<std::vector<uint8_t>> seen;
  for (uint32_t variant = 0; variant < 8; ++variant) {
    design.parts[0].variant = variant;
    seen.insert(PaintWall(design, 0.02).data);
  }
  EXPECT_EQ(seen.size(), 8u);
}

TEST(Paint, SmallWallsAndOddPartsArePainted) {
  for (const Cladding cladding : kCladdings) {
    const Image image = PaintWall(Wall(cladding, 0.01, 0.01), 0.01);
    EXPECT_EQ(image.data.size(), 3u);
    for (const PartKind kind : kParts) {
      WallDesign design = Wall(cladding, 1, 0.6);
      design.parts = {Part(kind, -2, -3, 0.4, 9),        // beyond every edge
                      Part(kind, 0.5, 0.2, 0.5, 0.4),    // no width
                      Part(kind, 0.8, 0.5, 0.6, 0.1),    // turned over
                      Part(kind, 0.7, 0.2, 0.71, 0.21),  // a texel
                      Part(kind, 50, 50, 60, 60),        // elsewhere
                      Part(kind, NAN, 0, 1, 1)};
      EXPECT_EQ(PaintWall(design, 0.01).data.size(), 100u * 60 * 3);
    }
  }
}

TEST(Paint, ImpossibleSizesAreRefused) {
  EXPECT_THROW(PaintWall(Wall(Cladding::kBrick, 0, 3), 0.01), Error);
  EXPECT_THROW(PaintWall(Wall(Cladding::kBrick, 3, NAN), 0.01), Error);
  EXPECT_THROW(PaintWall(Wall(Cladding::kBrick, 3, 3), 0), Error);
  EXPECT_THROW(PaintWall(Wall(Cladding::kBrick, 1e9, 3), 0.01), Error);
  EXPECT_THROW(PaintCovering({-1, 3, Covering::kGrass, 0, 0}, 0.01), Error);
}

// Texels larger than what is on the wall show its mean, not one sample of it.
TEST(Paint, CoarsePicturesShowTheMean) {
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (const uint8_t value : image.data) sum += value;
    return sum / static_cast<double>(image.data.size());
  };
  for (const Cladding cladding : kCladdings) {
    const WallDesign design = Wall(cladding, 8, 8);
    EXPECT_NEAR(mean(PaintWall(design, 0.01)), mean(PaintWall(design, 0.04)), 8)
        << static_cast<int>(cladding);
  }
}

TEST(PaintLeaves, HasLeavesAndGaps) {
  const Image image = PaintLeaves(7, 256);
  ASSERT_EQ(image.channels, 4);
  int solid = 0;
  for (size_t i = 3; i < image.data.size(); i += 4) {
    ASSERT_TRUE(image.data[i] == 0 || image.data[i] == 255);
    solid += image.data[i] == 255;
  }
  const double share = solid / (256.0 * 256);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.9);
  EXPECT_EQ(image.data[3], 0) << "corners are empty, so that a card's outline is not seen";
  EXPECT_NE(image.data, PaintLeaves(8, 256).data);
  EXPECT_EQ(PaintLeaves(7, 0).data.size(), 4u);
}

TEST(PaintCar, CarsDiffer) {
  const Image one = PaintCar(1, 0.02);
  EXPECT_EQ(one.width_px, 220);
  EXPECT_EQ(one.height_px, 238);
  std::set<std::vector<uint8_t>> seen;
  for (uint64_t seed = 0; seed < 6; ++seed) seen.insert(PaintCar(seed, 0.02).data);
  EXPECT_GT(seen.size(), 4u);
}

}  // namespace
}  // namespace stucco::simulate
