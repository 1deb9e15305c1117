// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/ocl.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality/qualitygmsd.hpp>
#include <optional>

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/internal/planes.h"

namespace stucco::evaluate {
namespace {

using internal::BeyondThePicture;

constexpr int kSsimRadius_px = 5;
constexpr double kWindowSigma_px = 1.5;
constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
constexpr double kC2 = (0.03 * 255) * (0.03 * 255);
constexpr std::array<double, 5> kScaleWeights = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};

// Means over the whole windows of one scale.
struct Similarity {
  double ssim = 0;
  double contrast = 0;  // contrast times structure
};

cv::Mat Smoothed(const cv::Mat& plane) {
  cv::Mat smooth;
  cv::GaussianBlur(plane, smooth, {2 * kSsimRadius_px + 1, 2 * kSsimRadius_px + 1}, kWindowSigma_px,
                   kWindowSigma_px, cv::BORDER_REPLICATE);
  return smooth;
}

// Second moments about `mean_a` and `mean_b`. The planes are centred on grey: squares of codes up
// to 255 would cost half of a float's digits.
cv::Mat Covariance(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mean_a,
                   const cv::Mat& mean_b) {
  return Smoothed(a.mul(b)) - mean_a.mul(mean_b);
}

std::optional<Similarity> SimilarityOf(const cv::Mat& truth, const cv::Mat& result,
                                       const cv::Mat& mask) {
  const cv::Mat windows = internal::WholeWindows(mask, kSsimRadius_px, BeyondThePicture::kNothing);
  if (cv::countNonZero(windows) == 0) return std::nullopt;
  constexpr double kGrey = 128;
  const cv::Mat a = truth - kGrey;
  const cv::Mat b = result - kGrey;
  const cv::Mat mean_a = Smoothed(a);
  const cv::Mat mean_b = Smoothed(b);
  const cv::Mat var_a = Covariance(a, a, mean_a, mean_a);
  const cv::Mat var_b = Covariance(b, b, mean_b, mean_b);
  const cv::Mat covariance = Covariance(a, b, mean_a, mean_b);
  const cv::Mat contrast = (2 * covariance + kC2) / (var_a + var_b + kC2);
  const cv::Mat level_a = mean_a + kGrey;
  const cv::Mat level_b = mean_b + kGrey;
  const cv::Mat level =
      (2 * level_a.mul(level_b) + kC1) / (level_a.mul(level_a) + level_b.mul(level_b) + kC1);
  return Similarity{cv::mean(contrast.mul(level), windows)[0], cv::mean(contrast, windows)[0]};
}

cv::Mat Even(const cv::Mat& plane) {
  return plane(cv::Rect(0, 0, plane.cols / 2 * 2, plane.rows / 2 * 2));
}

cv::Mat Halved(const cv::Mat& plane) {
  cv::Mat half;
  cv::resize(Even(plane), half, {plane.cols / 2, plane.rows / 2}, 0, 0, cv::INTER_AREA);
  return half;
}

// Content where all four pixels have it.
cv::Mat HalvedMask(const cv::Mat& mask) {
  cv::Mat content;
  mask.convertTo(content, CV_32F);
  return Halved(content) == 255;
}

}  // namespace

double Ssim(const PicturePair& pair) {
  CheckPair(pair);
  const auto similarity =
      SimilarityOf(internal::Luma(pair.truth), internal::Luma(pair.result), internal::MaskOf(pair));
  return similarity ? similarity->ssim : kNotMeasured;
}

double MultiScaleSsim(const PicturePair& pair) {
  CheckPair(pair);
  cv::Mat truth = internal::Luma(pair.truth);
  cv::Mat result = internal::Luma(pair.result);
  cv::Mat mask = internal::MaskOf(pair);
  std::vector<Similarity> scales;
  while (scales.size() < kScaleWeights.size()) {
    const auto similarity = SimilarityOf(truth, result, mask);
    if (!similarity) break;
    scales.push_back(*similarity);
    if (truth.cols < 2 || truth.rows < 2) break;
    truth = Halved(truth);
    result = Halved(result);
    mask = HalvedMask(mask);
  }
  if (scales.empty()) return kNotMeasured;
  double sum = 0;
  for (size_t i = 0; i < scales.size(); ++i) sum += kScaleWeights[i];
  double product = 1;
  for (size_t i = 0; i < scales.size(); ++i) {
    const double value = i + 1 == scales.size() ? scales[i].ssim : scales[i].contrast;
    product *= std::pow(std::max(0.0, value), kScaleWeights[i] / sum);
  }
  return product;
}

double Gmsd(const PicturePair& pair) {
  CheckPair(pair);
  // A pixel of the map sees 3 x 3 means of 2 x 2 pixels.
  if (pair.truth.width_px < 6 || pair.truth.height_px < 6) return kNotMeasured;
  const cv::Mat windows =
      internal::WholeWindows(HalvedMask(internal::MaskOf(pair)), 1, BeyondThePicture::kNothing);
  if (cv::countNonZero(windows) == 0) return kNotMeasured;
  // On graphics cards the digits would depend on the card. The setting is this thread's own.
  cv::ocl::setUseOpenCL(false);
  cv::Mat similarity;
  cv::quality::QualityGMSD::compute(Even(internal::Luma(pair.truth)),
                                    Even(internal::Luma(pair.result)), similarity);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(similarity, mean, deviation, windows);
  return deviation[0];
}

double Psnr(const PicturePair& pair) {
  CheckPair(pair);
  double sum = 0;  // of whole numbers: exact
  double count = 0;
  for (size_t i = 0; i < pair.truth.data.size(); ++i) {
    if (!pair.mask.empty() && pair.mask[i / 3] == 0) continue;
    const int difference = int{pair.truth.data[i]} - int{pair.result.data[i]};
    sum += difference * difference;
    count += 1;
  }
  if (count == 0) return kNotMeasured;
  if (sum == 0) return kMaxPsnr_db;
  return std::min(kMaxPsnr_db, 10 * std::log10(255.0 * 255.0 * count / sum));
}

}  // namespace stucco::evaluate
