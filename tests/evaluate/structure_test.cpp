// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/structure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality/qualityssim.hpp>

#include "evaluate/figures/evaluation.h"
#include "survey/error.h"
#include "tests/evaluate/made_pictures.h"

namespace stucco::evaluate {
namespace {

constexpr double kC1 = 6.5025;
constexpr double kC2 = 58.5225;

TEST(Ssim, IsOneForEqualPictures) {
  const Image picture = Waves(200, 190);
  EXPECT_NEAR(Ssim({picture, picture, {}}), 1, 1e-7);
  EXPECT_NEAR(MultiScaleSsim({picture, picture, {}}), 1, 1e-7);
}

TEST(Ssim, OfPlainPicturesIsItsLevelTerm) {
  const double expected = (2 * 100 * 150 + kC1) / (100 * 100 + 150 * 150 + kC1);
  EXPECT_NEAR(Ssim({Plain(20, 20, 100, 100, 100), Plain(20, 20, 150, 150, 150), {}}), expected,
              1e-6);
}

TEST(Ssim, IsThatOfOpenCvInside) {
  const Image truth = Waves(160, 120);
  const Image result = Noisy(Smoothed(truth, 1), 10);
  const auto grey = [](const Image& image) {
    cv::Mat luma;
    const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3,
                      const_cast<uint8_t*>(image.data.data()));
    rgb.convertTo(luma, CV_32F);
    cv::transform(luma, luma, cv::Matx13f(0.299f, 0.587f, 0.114f));
    return luma;
  };
  cv::Mat map;
  cv::quality::QualitySSIM::compute(grey(truth), grey(result), map);
  const double expected = cv::mean(map(cv::Rect(5, 5, 150, 110)))[0];
  EXPECT_LT(expected, 0.95);
  EXPECT_NEAR(Ssim({truth, result, {}}), expected, 1e-5);
}

TEST(Ssim, FallsWithNoiseBlurAndShift) {
  const Image truth = Waves(200, 200);
  double last_noise = 1;
  double last_blur = 1;
  double last_shift = 1;
  for (const double amount : {0.5, 1.0, 2.0}) {
    const double noise = Ssim({truth, Noisy(truth, 8 * amount), {}});
    const double blur = Ssim({truth, Smoothed(truth, amount), {}});
    const double shift = Ssim({truth, Waves(200, 200, amount), {}});
    EXPECT_LT(noise, last_noise);
    EXPECT_LT(blur, last_blur);
    EXPECT_LT(shift, last_shift);
    last_noise = noise;
    last_blur = blur;
    last_shift = shift;
  }
  // A little brighter is nearly the same to it.
  EXPECT_GT(Ssim({truth, Changed(truth, [](double code) { return code + 8; }), {}}), 0.98);
}

TEST(Ssim, OfANegativeIsNegative) {
  const Image truth = Waves(200, 200);
  const Image negative = Changed(truth, [](double code) { return 255 - code; });
  EXPECT_LT(Ssim({truth, negative, {}}), -0.5);
  EXPECT_EQ(MultiScaleSsim({truth, negative, {}}), 0);
}

TEST(MultiScaleSsim, WeighsItsScales) {
  // Equal contrasts on five scales, levels apart on the coarsest: its weight is the exponent.
  const double level = (2 * 100 * 150 + kC1) / (100 * 100 + 150 * 150 + kC1);
  const auto of = [](int side) {
    return MultiScaleSsim({Plain(side, side, 100, 100, 100), Plain(side, side, 150, 150, 150), {}});
  };
  EXPECT_NEAR(of(176), std::pow(level, 0.1333), 1e-5);
  // Four scales, then one: the weights of the others are left out.
  EXPECT_NEAR(of(175), std::pow(level, 0.2363 / (0.0448 + 0.2856 + 0.3001 + 0.2363)), 1e-5);
  EXPECT_NEAR(of(11), level, 1e-6);
}

TEST(MultiScaleSsim, ForgivesFineNoiseMoreThanSsim) {
  const Image truth = Waves(300, 300);
  const Image noisy = Noisy(truth, 15);
  EXPECT_GT(MultiScaleSsim({truth, noisy, {}}), Ssim({truth, noisy, {}}) + 0.02);
}

TEST(Gmsd, IsZeroForEqualPicturesAndForAConstantShiftOfTheLight) {
  const Image picture = Waves(100, 101);
  EXPECT_EQ(Gmsd({picture, picture, {}}), 0);
  EXPECT_EQ(Gmsd({Plain(30, 30, 10, 10, 10), Plain(30, 30, 90, 90, 90), {}}), 0);
}

TEST(Gmsd, OfAStepThatIsMissing) {
  // At half the size the step has Prewitt magnitude 60 in two of the 18 columns of whole windows.
  Image step = Plain(40, 40, 100, 100, 100);
  for (int y = 0; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) {
      for (int c = 0; c < 3; ++c) step.Pixel(x, y)[c] = 160;
    }
  }
  const double similarity = 170 / (60.0 * 60 + 170);
  const double share = 2.0 / 18;
  EXPECT_NEAR(Gmsd({step, Plain(40, 40, 100, 100, 100), {}}),
              (1 - similarity) * std::sqrt(share * (1 - share)), 1e-5);
}

TEST(Gmsd, GrowsWithBlurAndNoise) {
  const Image truth = Waves(200, 200);
  EXPECT_LT(Gmsd({truth, Smoothed(truth, 0.7), {}}), Gmsd({truth, Smoothed(truth, 2), {}}));
  EXPECT_LT(Gmsd({truth, Noisy(truth, 5), {}}), Gmsd({truth, Noisy(truth, 20), {}}));
}

TEST(Psnr, OfAKnownDifference) {
  const Image truth = Waves(50, 40);
  const Image result =
      Changed(truth, [](double code) { return code < 128 ? code + 10 : code - 10; });
  EXPECT_NEAR(Psnr({truth, result, {}}), 20 * std::log10(25.5), 1e-9);
  EXPECT_NEAR(Psnr({truth, Noisy(Plain(50, 40, 128, 128, 128), 0), {}}),
              Psnr({Plain(50, 40, 128, 128, 128), truth, {}}), 1e-12);
}

TEST(Psnr, HasALimitForEqualPictures) {
  const Image truth = Waves(50, 40);
  EXPECT_EQ(Psnr({truth, truth, {}}), kMaxPsnr_db);
}

// By the papers' formulas in double precision (numpy). The weights of the five scales add up to
// 1.0001, which is taken off here and was not there.
TEST(Structure, AgreesWithAnIndependentProgram) {
  const PicturePair pair{Waves(240, 200), Waves(240, 200, 1.5, 0.5), {}};
  EXPECT_NEAR(Ssim(pair), 0.7288668, 1e-6);
  EXPECT_NEAR(MultiScaleSsim(pair), std::pow(0.8994454, 1 / 1.0001), 1e-6);
  EXPECT_NEAR(Gmsd(pair), 0.1400878, 1e-6);
}

TEST(Structure, WhatTheMaskHidesDoesNotMatter) {
  const Image truth = Waves(260, 240);
  const Image result = Noisy(truth, 10);
  Image spoilt = result;
  Image spoilt_truth = truth;
  std::vector<uint8_t> mask(size_t{260} * 240, 1);
  for (int y = 100; y < 140; ++y) {
    for (int x = 0; x < 30; ++x) {
      mask[static_cast<size_t>(y) * 260 + x] = 0;
      for (int c = 0; c < 3; ++c) spoilt.Pixel(x, y)[c] = 255;
      for (int c = 0; c < 3; ++c) spoilt_truth.Pixel(x, y)[c] = 0;
    }
  }
  for (const auto measure : {Ssim, MultiScaleSsim, Gmsd, Psnr}) {
    EXPECT_EQ(measure({truth, result, mask}), measure({spoilt_truth, spoilt, mask}));
    EXPECT_NE(measure({truth, result, {}}), measure({spoilt_truth, spoilt, {}}));
  }
}

TEST(Structure, TinyAndHiddenPicturesAreNotMeasured) {
  const PicturePair pixel{Plain(1, 1, 0, 0, 0), Plain(1, 1, 255, 255, 255), {}};
  EXPECT_TRUE(std::isnan(Ssim(pixel)));
  EXPECT_TRUE(std::isnan(MultiScaleSsim(pixel)));
  EXPECT_TRUE(std::isnan(Gmsd(pixel)));
  EXPECT_EQ(Psnr(pixel), 0);
  const Image picture = Waves(64, 64);
  const PicturePair hidden{picture, picture, std::vector<uint8_t>(size_t{64} * 64, 0)};
  for (const auto measure : {Ssim, MultiScaleSsim, Gmsd, Psnr}) {
    EXPECT_TRUE(std::isnan(measure(hidden)));
  }
}

TEST(Structure, PicturesOfOtherSizesAreRefused) {
  const Image picture = Waves(20, 20);
  for (const auto measure : {Ssim, MultiScaleSsim, Gmsd, Psnr}) {
    EXPECT_THROW(measure({picture, Waves(20, 21), {}}), Error);
    EXPECT_THROW(measure({picture, picture, std::vector<uint8_t>(3, 1)}), Error);
    EXPECT_THROW(measure({Image{}, Image{}, {}}), Error);
    EXPECT_THROW(measure({picture, Image{20, 20, 1, std::vector<uint8_t>(400)}, {}}), Error);
  }
}

}  // namespace
}  // namespace stucco::evaluate
