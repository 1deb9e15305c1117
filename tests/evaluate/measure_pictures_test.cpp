// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/measure_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace stucco::evaluate {
namespace {

FacadeFigures Facade(double area_m2, double painted, double ssim, double shift_px) {
  FacadeFigures facade;
  facade.area_m2 = area_m2;
  facade.painted = painted;
  facade.picture.ssim = ssim;
  facade.misregistration_px = shift_px;
  return facade;
}

TEST(MeanOfFacades, WeighsByPaintedArea) {
  const std::vector<FacadeFigures> facades = {Facade(10, 1, 0.5, 1), Facade(60, 0.5, 0.9, 2),
                                              Facade(100, 0, 0.1, 3)};
  EXPECT_NEAR(MeanOfFacades(facades).ssim, 0.8, 1e-12);
  EXPECT_TRUE(std::isnan(MeanOfFacades({}).ssim));
}

TEST(PaintedShare, IsByArea) {
  const std::vector<FacadeFigures> facades = {Facade(10, 1, 0, 0), Facade(30, 0.5, 0, 0),
                                              Facade(60, 0, 0, 0)};
  EXPECT_NEAR(PaintedShare(facades), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(PaintedShare({})));
}

double InPixels(const FacadeFigures& facade) {
  return facade.misregistration_px;
}

TEST(MedianShift, IsThatOfHalfThePaintedArea) {
  std::vector<FacadeFigures> facades = {Facade(10, 1, 0, 4), Facade(60, 0.5, 0, 1),
                                        Facade(100, 0, 0, 9), Facade(15, 1, 0, 2),
                                        Facade(500, 1, 0, kNotMeasured)};
  EXPECT_EQ(MedianShift(facades, InPixels), 1);
  facades[3].area_m2 = 30;
  EXPECT_EQ(MedianShift(facades, InPixels), 2);
  EXPECT_TRUE(std::isnan(MedianShift({}, InPixels)));
}

}  // namespace
}  // namespace stucco::evaluate
