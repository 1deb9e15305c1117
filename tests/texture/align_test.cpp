// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

const Eigen::Vector2d kSize(400, 300);

// What a picture shows whose content is moved by `shift`: its texel x is the wall at x - shift(x).
GreyPicture Shifted(const GridShift& shift) {
  GreyPicture picture{400, 300, {}, std::vector<uint8_t>(400 * 300, 1)};
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      double sum = 0;
      for (int part = 0; part < 9; ++part) {
        const Eigen::Vector2d at(x + (part % 3 + 0.5) / 3, y + (part / 3 + 0.5) / 3);
        const Eigen::Vector2d wall = at - shift.At(at);
        sum += test::WallColour(0.01 * wall.x(), 3 - 0.01 * wall.y()).mean() / 9;
      }
      picture.grey.push_back(static_cast<uint8_t>(sum));
    }
  }
  return picture;
}

GridShift MakeShift(std::initializer_list<double> terms) {
  GridShift shift;
  shift.center = kSize / 2;
  shift.radius = 200;
  int i = 0;
  for (double term : terms) shift.terms[i++] = term;
  return shift;
}

std::vector<GridMatch> MatchesFor(const std::vector<GridShift>& shifts, int count, double sigma,
                                  double outliers) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> noise(0, sigma);
  std::vector<GridMatch> matches;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d x(400 * unit(random), 300 * unit(random));
    for (int b = 1; b < static_cast<int>(shifts.size()); ++b) {
      GridMatch match{0, b, x + shifts[0].At(x), x + shifts[b].At(x)};
      match.in_b += Eigen::Vector2d(noise(random), noise(random));
      if (unit(random) < outliers) match.in_b += Eigen::Vector2d(7, -6) * (unit(random) + 0.5);
      matches.push_back(match);
    }
  }
  return matches;
}

// Pictures that show the whole raster.
std::vector<GridArea> Whole(size_t pictures) {
  return std::vector<GridArea>(pictures, GridArea{{0, 0}, kSize});
}

// Largest error of the relative shift between pictures 0 and 1 over the raster's corners.
double RelativeError(const Alignment& alignment, const GridShift& truth) {
  double error = 0;
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(400, 0), Eigen::Vector2d(200, 300)}) {
    const Eigen::Vector2d found = alignment.shifts[1].At(at) - alignment.shifts[0].At(at);
    error = std::max(error, (found - truth.At(at)).norm());
  }
  return error;
}

TEST(SolveAlignment, RecoversAHomographyAndSharesIt) {
  const GridShift truth = MakeShift({2, -1, 0.5, 0.8, -0.6, 0.3, 0.4, -0.3});
  const auto matches = MatchesFor({MakeShift({}), truth}, 200, 0, 0);
  const Alignment alignment = SolveAlignment(matches, Whole(2), kSize, 8);
  EXPECT_GT(alignment.before_px, 1);
  EXPECT_LT(alignment.after_px, 0.05);
  EXPECT_LT(RelativeError(alignment, truth), 0.1);
  // Neither picture is the reference.
  EXPECT_NEAR(alignment.shifts[0].terms[0], -1, 0.1);
  EXPECT_NEAR(alignment.shifts[1].terms[0], 1, 0.1);
}

TEST(SolveAlignment, SurvivesNoiseAndOutliers) {
  const GridShift truth = MakeShift({3, 1, 0.5, 0.8, -0.6, 0.3});
  const auto matches = MatchesFor({MakeShift({}), truth}, 200, 0.3, 0.3);
  const Alignment alignment = SolveAlignment(matches, Whole(2), kSize, 8);
  EXPECT_LT(RelativeError(alignment, truth), 0.5);
}

TEST(SolveAlignment, JoinsThreePictures) {
  const auto matches =
      MatchesFor({MakeShift({}), MakeShift({2, 0}), MakeShift({-2, 1})}, 60, 0.1, 0);
  const Alignment alignment = SolveAlignment(matches, Whole(3), kSize, 8);
  EXPECT_LT(alignment.after_px, 0.3);
  EXPECT_NEAR(
      alignment.shifts[0].terms[0] + alignment.shifts[1].terms[0] + alignment.shifts[2].terms[0], 0,
      0.05);
}

TEST(SolveAlignment, StaysWhereItIsWhenUnsure) {
  const auto few = MatchesFor({MakeShift({}), MakeShift({3, 0})}, 5, 0, 0);
  const Alignment unsure = SolveAlignment(few, Whole(2), kSize, 8);
  EXPECT_EQ(unsure.before_px, -1);
  for (const GridShift& shift : unsure.shifts) EXPECT_TRUE(shift.IsZero());
  const auto far = MatchesFor({MakeShift({}), MakeShift({30, 0})}, 50, 0, 0);
  for (const GridShift& shift : SolveAlignment(far, Whole(2), kSize, 8).shifts) {
    EXPECT_LE(shift.At({0, 0}).norm(), 8);
  }
  EXPECT_EQ(SolveAlignment({}, Whole(2), kSize, 8).after_px, -1);
  const Alignment measured =
      SolveAlignment(MatchesFor({MakeShift({}), MakeShift({3, 0})}, 50, 0, 0), Whole(2), kSize, 0);
  EXPECT_NEAR(measured.before_px, 3, 1e-6);
  EXPECT_TRUE(measured.shifts[1].IsZero());
}

// A stretch about the raster's centre moves far corners out of bounds, but not those of the strip
// that the pictures show.
TEST(SolveAlignment, JudgesAPictureWhereItShowsSomething) {
  const GridShift truth = MakeShift({0, 0, 16, 0, 0, 0, 0, 0});
  std::vector<GridMatch> matches;
  for (const GridMatch& match : MatchesFor({MakeShift({}), truth}, 800, 0, 0)) {
    if (std::abs(match.in_a.x() - 200) < 60) matches.push_back(match);
  }
  const std::vector<GridArea> strips(2, GridArea{{140, 0}, {260, 300}});
  const Alignment partial = SolveAlignment(matches, strips, kSize, 6);
  EXPECT_LT(partial.after_px, 0.3);
  EXPECT_GT(partial.before_px, 2);
  EXPECT_GT(SolveAlignment(matches, Whole(2), kSize, 6).after_px, partial.after_px + 0.5);
}

TEST(SolveAlignment, LeavesOutOneBadPictureAndAlignsTheRest) {
  const std::vector<GridShift> truth = {MakeShift({}), MakeShift({3, 1, 1}),
                                        MakeShift({-2, 2, 0, 1}), MakeShift({40, -30})};
  const std::vector<GridMatch> matches = MatchesFor(truth, 100, 0, 0);
  const Alignment alignment = SolveAlignment(matches, Whole(4), kSize, 8);
  EXPECT_TRUE(alignment.shifts[3].IsZero());
  EXPECT_FALSE(alignment.shifts[1].IsZero());
  EXPECT_LT(RelativeError(alignment, truth[1]), 0.1);
  EXPECT_LT(alignment.after_px, alignment.before_px);
}

// One picture whose matches cover a corner of what it shows bends too far elsewhere.
TEST(SolveAlignment, FitsAPictureThatBendsTooFarWithFewerTerms) {
  const std::vector<GridShift> truth = {MakeShift({}), MakeShift({3, 1, 1, 0, 0, 1, 2, 1}),
                                        MakeShift({-2, 2, 0, 1}), MakeShift({2, 2})};
  std::vector<GridMatch> matches;
  for (GridMatch match : MatchesFor(truth, 400, 0, 0)) {
    if (match.b == 3) {
      if (match.in_a.norm() > 150) continue;
      const double bend = match.in_a.x() / 60;
      match.in_b.x() -= bend * bend;
    }
    matches.push_back(match);
  }
  const Alignment alignment = SolveAlignment(matches, Whole(4), kSize, 8);
  EXPECT_LT(RelativeError(alignment, truth[1]), 0.1);  // in all its eight terms
  EXPECT_FALSE(alignment.shifts[3].IsZero());
  for (const GridShift& shift : alignment.shifts) {
    for (double x : {0.0, 400.0}) EXPECT_LE(shift.At({x, 300}).norm(), 8);
  }
}

TEST(MatchPictures, MatchesPicturesOfPartsOfTheRaster) {
  const std::vector<GreyPicture> whole = {Shifted(MakeShift({})), Shifted(MakeShift({2.3, -1.6}))};
  GreyPicture part{250, 200, {}, std::vector<uint8_t>(250 * 200, 1), 150, 40};
  for (int y = 0; y < 200; ++y) {
    const auto from = whole[1].grey.begin() + (y + 40) * 400 + 150;
    part.grey.insert(part.grey.end(), from, from + 250);
  }
  const std::vector<GreyPicture> pictures = {whole[0], part};
  const auto matches = MatchPictures(pictures, 0, 1, 8);
  ASSERT_GT(matches.size(), 50u);
  size_t good = 0;
  for (const GridMatch& match : matches) {
    good += (match.in_b - match.in_a - Eigen::Vector2d(2.3, -1.6)).norm() < 0.3;
    EXPECT_GE(match.in_a.x(), 150);
    EXPECT_GE(match.in_a.y(), 40);
  }
  EXPECT_GT(good, 8 * matches.size() / 10);
  const std::vector<GreyPicture> apart = {whole[0], GreyPicture{10, 10, {}, {}, 400, 0}};
  EXPECT_TRUE(MatchPictures(apart, 0, 1, 8).empty());
}

TEST(MatchPictures, FindsTheShiftToAFractionOfATexel) {
  const std::vector<GreyPicture> pictures = {Shifted(MakeShift({})),
                                             Shifted(MakeShift({2.3, -1.6}))};
  const auto matches = MatchPictures(pictures, 0, 1, 8);
  ASSERT_GT(matches.size(), 100u);
  size_t good = 0;
  for (const GridMatch& match : matches) {
    good += (match.in_b - match.in_a - Eigen::Vector2d(2.3, -1.6)).norm() < 0.3;
  }
  EXPECT_GT(good, 9 * matches.size() / 10);
}

TEST(MatchPictures, IgnoresWhatIsNotValidAndBlankWalls) {
  std::vector<GreyPicture> pictures = {Shifted(MakeShift({})), Shifted(MakeShift({1, 0}))};
  for (int i = 0; i < 400 * 300; ++i) pictures[1].valid[i] = i % 400 < 200;
  for (const GridMatch& match : MatchPictures(pictures, 0, 1, 8)) {
    EXPECT_LT(match.in_b.x(), 200);
  }
  pictures[0].grey.assign(400 * 300, 120);
  EXPECT_TRUE(MatchPictures(pictures, 0, 1, 8).empty());
}

TEST(AlignPictures, BringsThreePicturesTogether) {
  const std::vector<GreyPicture> pictures = {Shifted(MakeShift({})),
                                             Shifted(MakeShift({3, -2, 1, 0, 0, -1})),
                                             Shifted(MakeShift({-2, 1, 0, 1, 0, 0}))};
  const Alignment alignment = AlignPictures(pictures, kSize, 8);
  EXPECT_GT(alignment.before_px, 2);
  EXPECT_LT(alignment.after_px, 0.4);
  EXPECT_EQ(AlignPictures({}, kSize, 8).shifts.size(), 0u);
}

}  // namespace
}  // namespace stucco
