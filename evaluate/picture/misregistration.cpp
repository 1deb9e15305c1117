// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/misregistration.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "evaluate/evaluation.h"
#include "evaluate/picture/internal/planes.h"
#include "survey/median.h"

namespace stucco::evaluate {
namespace {

constexpr int kStep_px = 4;
constexpr int kWindowRadius_px = 10;
constexpr int kHalvings = 2;
constexpr size_t kFewestPlaces = 10;
// The mean square slope in the flattest direction, in grey levels per pixel: what JPEG and sensor
// noise leave on a plain wall is below one level.
constexpr double kLeastSlope = 2;
// Flow that is right comes back to where it began.
constexpr double kReturn_px = 0.5;
// Of the local mean and contrast: several windows wide, so that equalising shifts nothing.
constexpr double kEqualiseSigma_px = 12;
constexpr double kFlatContrast = 4;  // grey levels; keeps noise on plain walls from growing

cv::Mat Blurred(const cv::Mat& plane) {
  cv::Mat blurred;
  cv::GaussianBlur(plane, blurred, {0, 0}, kEqualiseSigma_px);
  return blurred;
}

// Local mean 128 and deviation 32.
cv::Mat Equalised(const cv::Mat& luma) {
  const cv::Mat centred = luma - Blurred(luma);
  cv::Mat deviation;
  cv::sqrt(Blurred(centred.mul(centred)) + kFlatContrast * kFlatContrast, deviation);
  cv::Mat equalised;
  cv::Mat(128 + 32 * (centred / deviation)).convertTo(equalised, CV_8U);
  return equalised;
}

// The smaller eigenvalue of the mean of the gradient's outer products over the window.
cv::Mat LeastSquareSlope(const cv::Mat& luma) {
  cv::Mat dx;
  cv::Mat dy;
  cv::Scharr(luma, dx, CV_32F, 1, 0, 1.0 / 32);  // grey levels per pixel
  cv::Scharr(luma, dy, CV_32F, 0, 1, 1.0 / 32);
  const cv::Size window(2 * kWindowRadius_px + 1, 2 * kWindowRadius_px + 1);
  cv::Mat xx;
  cv::Mat yy;
  cv::Mat xy;
  cv::blur(dx.mul(dx), xx, window);
  cv::blur(dy.mul(dy), yy, window);
  cv::blur(dx.mul(dy), xy, window);
  const cv::Mat half_difference = 0.5 * (xx - yy);
  cv::Mat spread;
  cv::magnitude(half_difference, xy, spread);
  return 0.5 * (xx + yy) - spread;
}

std::vector<cv::Point2f> TexturedPlaces(const cv::Mat& luma, const cv::Mat& mask) {
  const cv::Mat slope = LeastSquareSlope(luma);
  const cv::Mat whole =
      internal::WholeWindows(mask, kWindowRadius_px, internal::BeyondThePicture::kNothing);
  std::vector<cv::Point2f> places;
  for (int y = 0; y < luma.rows; y += kStep_px) {
    for (int x = 0; x < luma.cols; x += kStep_px) {
      if (whole.at<uint8_t>(y, x) != 0 && slope.at<float>(y, x) >= kLeastSlope * kLeastSlope) {
        places.emplace_back(static_cast<float>(x), static_cast<float>(y));
      }
    }
  }
  return places;
}

struct Tracks {
  std::vector<cv::Point2f> to;
  std::vector<uint8_t> found;
};

Tracks Track(const cv::Mat& from_picture, const cv::Mat& to_picture,
             const std::vector<cv::Point2f>& from) {
  Tracks tracks;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 0.005);
  const int side = 2 * kWindowRadius_px + 1;
  cv::calcOpticalFlowPyrLK(from_picture, to_picture, from, tracks.to, tracks.found, cv::noArray(),
                           {side, side}, kHalvings, until);
  return tracks;
}

// What has no content in one of the pictures is the same in both: it pulls no place anywhere.
cv::Mat FilledLike(const cv::Mat& truth, const cv::Mat& result, const cv::Mat& mask) {
  cv::Mat filled = truth.clone();
  result.copyTo(filled, mask);
  return filled;
}

}  // namespace

double Misregistration(const PicturePair& pair) {
  CheckPair(pair);
  const cv::Mat mask = internal::MaskOf(pair);
  const cv::Mat truth = internal::Luma(pair.truth);
  const cv::Mat result = FilledLike(truth, internal::Luma(pair.result), mask);
  const std::vector<cv::Point2f> places = TexturedPlaces(truth, mask);
  if (places.size() < kFewestPlaces) return kNotMeasured;
  const cv::Mat equal_truth = Equalised(truth);
  const cv::Mat equal_result = Equalised(result);
  const Tracks there = Track(equal_truth, equal_result, places);
  const Tracks back = Track(equal_result, equal_truth, there.to);
  std::vector<double> lengths;
  for (size_t i = 0; i < places.size(); ++i) {
    if (there.found[i] == 0 || back.found[i] == 0) continue;
    if (cv::norm(back.to[i] - places[i]) > kReturn_px) continue;
    lengths.push_back(cv::norm(there.to[i] - places[i]));
  }
  return lengths.size() < kFewestPlaces ? kNotMeasured : *Median(lengths);
}

}  // namespace stucco::evaluate
