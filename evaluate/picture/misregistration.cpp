// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/misregistration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/internal/planes.h"
#include "survey/median.h"

namespace stucco::evaluate {
namespace {

constexpr int kStep_px = 4;
constexpr int kWindowRadius_px = 10;
constexpr int kHalvings = 2;
constexpr double kFewestPlaces = 10;
// Of the places with texture. By chance a few percent of unlike content lead home.
constexpr double kLeastShare = 0.1;
// The flow finds shifts of this length by itself.
constexpr double kNear_px = 6;
constexpr double kClearly = 1.25;
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

// `guess` is where the places may be.
Tracks Track(const cv::Mat& from_picture, const cv::Mat& to_picture,
             const std::vector<cv::Point2f>& from, std::vector<cv::Point2f> guess) {
  Tracks tracks{std::move(guess), {}};
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 0.005);
  const int side = 2 * kWindowRadius_px + 1;
  cv::calcOpticalFlowPyrLK(from_picture, to_picture, from, tracks.to, tracks.found, cv::noArray(),
                           {side, side}, kHalvings, until, cv::OPTFLOW_USE_INITIAL_FLOW);
  return tracks;
}

// Lengths of the flow that leads home, looked for around a shift of everything.
std::vector<double> ShiftsAround(const cv::Point2f& shift, const cv::Mat& truth,
                                 const cv::Mat& result, const std::vector<cv::Point2f>& places) {
  std::vector<cv::Point2f> shifted = places;
  for (cv::Point2f& place : shifted) place += shift;
  const Tracks there = Track(truth, result, places, shifted);
  std::vector<cv::Point2f> home = there.to;
  for (cv::Point2f& place : home) place -= shift;
  const Tracks back = Track(result, truth, there.to, home);
  std::vector<double> lengths;
  for (size_t i = 0; i < places.size(); ++i) {
    if (there.found[i] == 0 || back.found[i] == 0) continue;
    if (cv::norm(back.to[i] - places[i]) > kReturn_px) continue;
    lengths.push_back(cv::norm(there.to[i] - places[i]));
  }
  return lengths;
}

// The shift of the whole picture that phase correlation finds (Kuglin and Hines 1975).
cv::Point2f ShiftOfAll(const cv::Mat& truth, const cv::Mat& result, const cv::Mat& mask) {
  const auto content = [&](const cv::Mat& equalised) {
    cv::Mat centred = cv::Mat::zeros(equalised.size(), CV_32F);
    cv::Mat plane;
    equalised.convertTo(plane, CV_32F, 1, -128);
    plane.copyTo(centred, mask);
    return centred;
  };
  return cv::phaseCorrelate(content(truth), content(result));
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
  std::vector<double> lengths = ShiftsAround({0, 0}, equal_truth, equal_result, places);
  const cv::Point2f shift = ShiftOfAll(equal_truth, equal_result, mask);
  if (cv::norm(shift) > kNear_px) {
    // What repeats itself leads home from far away as well: then the nearer is believed.
    std::vector<double> far = ShiftsAround(shift, equal_truth, equal_result, places);
    if (static_cast<double>(far.size()) > kClearly * static_cast<double>(lengths.size())) {
      lengths = std::move(far);
    }
  }
  const auto fewest = std::max(kFewestPlaces, kLeastShare * static_cast<double>(places.size()));
  return static_cast<double>(lengths.size()) < fewest ? kNotMeasured : *Median(lengths);
}

}  // namespace stucco::evaluate
