// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/internal/planes.h"
#include "survey/srgb.h"

namespace stucco::evaluate {
namespace {

constexpr double kPi = std::numbers::pi;

// Light of sRGB's primaries to XYZ (IEC 61966-2-1); white is the sum of its columns.
const cv::Matx33f kXyzFromRgb(0.4124564f, 0.3575761f, 0.1804375f, 0.2126729f, 0.7151522f,
                              0.0721750f, 0.0193339f, 0.1191920f, 0.9503041f);
const cv::Matx33f kRgbFromXyz = kXyzFromRgb.inv();
const cv::Vec3f kWhite = kXyzFromRgb * cv::Vec3f(1, 1, 1);

// Table 1 of the paper: the contrast sensitivity of a channel as two Gaussians in frequency.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivities = {
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidestB = 0.04;

// Section 4.1 and 4.2.
constexpr double kColourExponent = 0.7;
constexpr double kBendError = 0.4;   // of the largest colour error ...
constexpr double kBendShare = 0.95;  // ... is mapped to this
constexpr double kFeatureExponent = 0.5;
constexpr double kFeatureWidth_deg = 0.082;

int FilterRadius_px(double pixels_per_degree) {
  return static_cast<int>(std::ceil(3 * std::sqrt(kWidestB / (2 * kPi * kPi)) * pixels_per_degree));
}

double FeatureSigma_px(double pixels_per_degree) {
  return 0.5 * kFeatureWidth_deg * pixels_per_degree;
}

int FeatureRadius_px(double pixels_per_degree) {
  return static_cast<int>(std::ceil(3 * FeatureSigma_px(pixels_per_degree)));
}

cv::Vec3f OpponentFromXyz(const cv::Vec3f& xyz) {
  const float x = xyz[0] / kWhite[0];
  const float y = xyz[1] / kWhite[1];
  const float z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

cv::Vec3f XyzFromOpponent(const cv::Vec3f& opponent) {
  const float y = (opponent[0] + 16) / 116;
  return {(opponent[1] / 500 + y) * kWhite[0], y * kWhite[1], (y - opponent[2] / 200) * kWhite[2]};
}

// CIELAB of light, a and b made smaller in the dark (Hunt's effect).
cv::Vec3f HuntLab(const cv::Vec3f& rgb) {
  const auto root = [](float t) {
    constexpr float kDelta = 6.0f / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
  };
  const cv::Vec3f xyz = kXyzFromRgb * rgb;
  const float x = root(xyz[0] / kWhite[0]);
  const float y = root(xyz[1] / kWhite[1]);
  const float z = root(xyz[2] / kWhite[2]);
  const float lightness = 116 * y - 16;
  return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

double HyAb(const cv::Vec3f& a, const cv::Vec3f& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

cv::Mat Opponent(const Image& image) {
  cv::Mat opponent(image.height_px, image.width_px, CV_32FC3);
  const uint8_t* code = image.data.data();
  for (auto pixel = opponent.begin<cv::Vec3f>(); pixel != opponent.end<cv::Vec3f>(); ++pixel) {
    const cv::Vec3f rgb(LinearFromSrgb(code[0]), LinearFromSrgb(code[1]), LinearFromSrgb(code[2]));
    *pixel = OpponentFromXyz(kXyzFromRgb * rgb);
    code += 3;
  }
  return opponent;
}

// One Gaussian of a channel's filter, exp(-pi^2 x^2 / b) with x in degrees, and its weight among
// the channel's Gaussians. The filter as a whole sums to one.
struct Gaussian {
  cv::Mat kernel;
  double weight = 0;
};

Gaussian MakeGaussian(double a, double b, double pixels_per_degree) {
  const int radius = FilterRadius_px(pixels_per_degree);
  cv::Mat kernel(1, 2 * radius + 1, CV_64F);
  for (int i = -radius; i <= radius; ++i) {
    const double degrees = i / pixels_per_degree;
    kernel.at<double>(i + radius) = std::exp(-kPi * kPi * degrees * degrees / b);
  }
  const double sum = cv::sum(kernel)[0];
  return {kernel / sum, a * std::sqrt(kPi / b) * sum * sum};
}

cv::Mat Filtered(const cv::Mat& plane, const cv::Mat& kernel_x, const cv::Mat& kernel_y) {
  cv::Mat filtered;
  cv::sepFilter2D(plane, filtered, CV_32F, kernel_x, kernel_y, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return filtered;
}

cv::Mat Seen(const cv::Mat& plane, const Sensitivity& sensitivity, double pixels_per_degree) {
  const Gaussian first = MakeGaussian(sensitivity.a1, sensitivity.b1, pixels_per_degree);
  cv::Mat seen = Filtered(plane, first.kernel, first.kernel);
  if (sensitivity.a2 == 0) return seen;
  const Gaussian second = MakeGaussian(sensitivity.a2, sensitivity.b2, pixels_per_degree);
  const cv::Mat more = Filtered(plane, second.kernel, second.kernel);
  return (first.weight * seen + second.weight * more) / (first.weight + second.weight);
}

// What of the picture's colours is seen from the distance, as Hunt-adjusted CIELAB.
cv::Mat SeenLab(const cv::Mat& opponent, double pixels_per_degree) {
  std::array<cv::Mat, 3> planes;
  cv::split(opponent, planes.data());
  for (size_t i = 0; i < 3; ++i) planes[i] = Seen(planes[i], kSensitivities[i], pixels_per_degree);
  cv::Mat lab;
  cv::merge(planes.data(), 3, lab);
  for (auto pixel = lab.begin<cv::Vec3f>(); pixel != lab.end<cv::Vec3f>(); ++pixel) {
    cv::Vec3f rgb = kRgbFromXyz * XyzFromOpponent(*pixel);
    for (int c = 0; c < 3; ++c) rgb[c] = std::clamp(rgb[c], 0.0f, 1.0f);
    *pixel = HuntLab(rgb);
  }
  return lab;
}

// Derivatives of a Gaussian, their positive and their negative weights summing to 1 and -1.
cv::Mat DerivativeKernel(int order, double pixels_per_degree) {
  const double sigma = FeatureSigma_px(pixels_per_degree);
  const int radius = FeatureRadius_px(pixels_per_degree);
  cv::Mat kernel(1, 2 * radius + 1, CV_64F);
  double positive = 0;
  double negative = 0;
  for (int i = -radius; i <= radius; ++i) {
    const double factor = order == 1 ? -i : i * i / (sigma * sigma) - 1;
    const double value = factor * std::exp(-i * i / (2 * sigma * sigma));
    kernel.at<double>(i + radius) = value;
    (value > 0 ? positive : negative) += std::abs(value);
  }
  for (int i = 0; i < kernel.cols; ++i) {
    double& value = kernel.at<double>(i);
    value /= value > 0 ? positive : negative;
  }
  return kernel;
}

cv::Mat FeatureStrength(const cv::Mat& grey, int order, double pixels_per_degree) {
  const cv::Mat along = DerivativeKernel(order, pixels_per_degree);
  const cv::Mat across = cv::getGaussianKernel(along.cols, FeatureSigma_px(pixels_per_degree));
  cv::Mat strength;
  cv::magnitude(Filtered(grey, along, across), Filtered(grey, across, along), strength);
  return strength;
}

cv::Mat Grey(const cv::Mat& opponent) {
  cv::Mat grey;
  cv::extractChannel(opponent, grey, 0);
  return (grey + 16) / 116;
}

// The larger difference of edges and of points.
cv::Mat FeatureDifference(const cv::Mat& truth, const cv::Mat& result, double pixels_per_degree) {
  const cv::Mat grey_truth = Grey(truth);
  const cv::Mat grey_result = Grey(result);
  std::array<cv::Mat, 2> difference;
  for (int order = 1; order <= 2; ++order) {
    cv::absdiff(FeatureStrength(grey_truth, order, pixels_per_degree),
                FeatureStrength(grey_result, order, pixels_per_degree),
                difference[static_cast<size_t>(order - 1)]);
  }
  return cv::max(difference[0], difference[1]);
}

double LargestColourError() {
  return std::pow(HyAb(HuntLab({0, 1, 0}), HuntLab({0, 0, 1})), kColourExponent);
}

// The colour error in [0, 1]: small ones get most of the range.
double ColourShare(double hyab, double largest) {
  const double error = std::pow(hyab, kColourExponent);
  const double bend = kBendError * largest;
  if (error < bend) return kBendShare / bend * error;
  return kBendShare + (error - bend) / (largest - bend) * (1 - kBendShare);
}

}  // namespace

FlipMap Flip(const PicturePair& pair, double pixels_per_degree) {
  CheckPair(pair);
  const cv::Mat truth = Opponent(pair.truth);
  const cv::Mat result = Opponent(pair.result);
  const cv::Mat feature = FeatureDifference(truth, result, pixels_per_degree);
  const cv::Mat truth_lab = SeenLab(truth, pixels_per_degree);
  const cv::Mat result_lab = SeenLab(result, pixels_per_degree);
  const int radius =
      std::max(FilterRadius_px(pixels_per_degree), FeatureRadius_px(pixels_per_degree));
  const cv::Mat measured =
      internal::WholeWindows(internal::MaskOf(pair), radius, internal::BeyondThePicture::kContent);
  const double largest = LargestColourError();
  FlipMap map{truth.cols, truth.rows, {}};
  map.error.reserve(truth.total());
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (measured.at<uint8_t>(y, x) == 0) {
        map.error.push_back(std::numeric_limits<float>::quiet_NaN());
        continue;
      }
      const double colour =
          ColourShare(HyAb(truth_lab.at<cv::Vec3f>(y, x), result_lab.at<cv::Vec3f>(y, x)), largest);
      const double detail =
          std::pow(std::min(1.0, feature.at<float>(y, x) / std::numbers::sqrt2), kFeatureExponent);
      map.error.push_back(static_cast<float>(std::pow(colour, 1 - detail)));
    }
  }
  return map;
}

double MeanError(const FlipMap& map) {
  double sum = 0;
  size_t count = 0;
  for (const float error : map.error) {
    if (std::isnan(error)) continue;
    sum += error;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : kNotMeasured;
}

Image Coloured(const FlipMap& map) {
  constexpr uint8_t kNothing = 0x80;
  Image image{map.width_px, map.height_px, 3, {}};
  image.data.resize(map.error.size() * 3);
  cv::Mat codes(map.height_px, map.width_px, CV_8UC1);
  for (size_t i = 0; i < map.error.size(); ++i) {
    const float error = map.error[i];
    codes.data[i] = std::isnan(error) ? 0 : static_cast<uint8_t>(std::lround(255 * error));
  }
  cv::Mat bgr;
  cv::applyColorMap(codes, bgr, cv::COLORMAP_MAGMA);
  for (size_t i = 0; i < map.error.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      image.data[3 * i + c] = std::isnan(map.error[i]) ? kNothing : bgr.data[3 * i + 2 - c];
    }
  }
  return image;
}

}  // namespace stucco::evaluate
