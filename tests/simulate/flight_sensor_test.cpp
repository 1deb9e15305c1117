// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "simulate/flight/blur.h"
#include "simulate/flight/exposure.h"
#include "simulate/flight/sensor.h"
#include "simulate/flight/sharpen.h"
#include "simulate/random.h"

namespace stucco::simulate {
namespace {

Camera Lens(int width_px, int height_px) {
  Camera camera;
  camera.id = CameraId{1};
  camera.model = CameraModel::kOpenCv;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.params = {
      0.7 * width_px, 0.7 * width_px, 0.5 * width_px + 3, 0.5 * height_px - 2, -0.1, 0.01,
      1e-4,           -1e-4};
  return camera;
}

Radiance Plain(int width_px, int height_px, float light) {
  return {width_px, height_px, std::vector<float>(size_t{3} * width_px * height_px, light)};
}

Radiance Dot(int side_px, int x, int y) {
  Radiance picture = Plain(side_px, side_px, 0);
  for (int c = 0; c < 3; ++c) picture.rgb[3 * (size_t(y) * side_px + x) + c] = 1;
  return picture;
}

// Sum, mean and covariance of a picture's light.
struct Moments {
  double sum = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};
Moments MomentsOf(const Radiance& picture) {
  Moments moments;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const double light = picture.rgb[3 * (size_t(y) * picture.width_px + x) + 1];
      const Eigen::Vector2d at(x, y);
      moments.sum += light;
      moments.mean += light * at;
      second += light * at * at.transpose();
    }
  }
  moments.mean /= moments.sum;
  moments.covariance = second / moments.sum - moments.mean * moments.mean.transpose();
  return moments;
}

TEST(Blur, FocusHasTheWidthThatWasAskedFor) {
  for (const double sigma : {0.2, 0.5, 0.69, 0.71, 1.5, 4.0}) {
    Radiance picture = Dot(61, 30, 30);
    BlurByFocus(sigma, 1, picture);
    const Moments moments = MomentsOf(picture);
    EXPECT_NEAR(moments.sum, 1, 1e-5);
    EXPECT_NEAR(moments.mean.x(), 30, 1e-4);
    EXPECT_NEAR(moments.covariance(0, 0), sigma * sigma, 0.01 * sigma * sigma) << sigma;
    EXPECT_NEAR(moments.covariance(1, 1), sigma * sigma, 0.01 * sigma * sigma) << sigma;
    EXPECT_NEAR(moments.covariance(0, 1), 0, 1e-5);
  }
  Radiance sharp = Dot(9, 4, 4);
  BlurByFocus(0, 1, sharp);
  EXPECT_EQ(sharp.rgb, Dot(9, 4, 4).rgb);
}

TEST(Blur, TurningSmearsAlongTheWayOfThePicture) {
  const Camera camera = Lens(101, 101);
  for (const double length : {0.4, 1.5, 3.0, 8.0}) {
    const Eigen::Vector3d turn(0.4 * length / 70, 0.8 * length / 70, 0.02);
    const Eigen::Vector2d pixel(70.5, 40.5);
    const Eigen::Vector2d way = ImageMotion(camera, turn, pixel);
    EXPECT_NEAR(way.norm(), length, 0.5 * length);
    // On light enough that the small negative weights of interpolation are not cut off.
    Radiance picture = Dot(101, 70, 40);
    for (float& light : picture.rgb) light += 1;
    BlurByTurning(camera, turn, 1, picture);
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        // Beyond the dot's reach there is nothing but rounding.
        const bool is_near = std::abs(x - 70) < 9 && std::abs(y - 40) < 9;
        float* light = &picture.rgb[3 * (size_t(y) * 101 + x)];
        for (int c = 0; c < 3; ++c) light[c] = is_near ? light[c] - 1 : 0;
      }
    }
    const Moments moments = MomentsOf(picture);
    EXPECT_NEAR(moments.sum, 1, 0.03);
    EXPECT_NEAR((moments.mean - Eigen::Vector2d(70, 40)).norm(), 0, 0.1);
    // A uniform way has its length squared over twelve as variance.
    const Eigen::Matrix2d expected = way * way.transpose() / 12;
    EXPECT_LT((moments.covariance - expected).norm(), 0.06 * expected.norm() + 0.004) << length;
  }
}

TEST(Blur, MotionIsThatOfAFarPoint) {
  const Camera camera = Lens(400, 300);
  // To the right by a tenth of a degree: what is seen moves to the left.
  const Eigen::Vector2d way = ImageMotion(camera, {0, 0.1 / 57.29578, 0}, camera.PrincipalPoint());
  EXPECT_NEAR(way.x(), -0.1 / 57.29578 * 280, 1e-3);
  EXPECT_NEAR(way.y(), 0, 1e-3);
}

TEST(Sensor, VignettingTakesTheShareInTheFarthestCorner) {
  const Camera camera = Lens(400, 300);
  EXPECT_DOUBLE_EQ(Vignetting(camera, 0.3, camera.PrincipalPoint()), 1);
  EXPECT_NEAR(Vignetting(camera, 0.3, {0, 300}), 0.7, 1e-12);  // the principal point is off
  SensorEffects effects;
  effects.vignetting = 0.3;
  const Image image = Develop(Plain(400, 300, 0.4f), camera, effects, 1);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(203, 148), std::pair(399, 150)}) {
    const double light = 0.4 * Vignetting(camera, 0.3, {x + 0.5, y + 0.5});
    EXPECT_NEAR(image.Pixel(x, y)[1], 255 * CameraCurve(light), 0.51);
  }
}

TEST(Sensor, ExposureAndWhiteBalanceMultiplyTheLight) {
  SensorEffects effects;
  effects.exposure = 1.7;
  effects.white_balance = {1.1, 1, 0.8};
  const Image image = Develop(Plain(8, 8, 0.25f), Lens(8, 8), effects, 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(image.Pixel(3, 3)[c], 255 * CameraCurve(0.25 * 1.7 * effects.white_balance[c]),
                0.51);
  }
}

TEST(Sensor, NoiseGrowsWithTheRootOfTheLight) {
  // Through a straight piece of the curve the noise of the codes is that of the light.
  const Camera camera = Lens(300, 200);
  for (const double light : {0.1, 0.5}) {
    SensorEffects effects;
    effects.noise = 0.02;
    effects.seed = 5;
    const Image image = Develop(Plain(300, 200, static_cast<float>(light)), camera, effects, 1);
    double sum = 0, squares = 0;
    for (const uint8_t code : image.data) {
      sum += code;
      squares += double(code) * code;
    }
    const double count = static_cast<double>(image.data.size());
    const double variance = squares / count - sum / count * (sum / count) - 1.0 / 12;
    const double slope = 255 * (CameraCurve(light + 1e-3) - CameraCurve(light - 1e-3)) / 2e-3;
    const double expected = 0.02 * std::sqrt(light * 15 / 16 + 1.0 / 16) * slope;
    EXPECT_NEAR(std::sqrt(variance), expected, 0.03 * expected) << light;
    EXPECT_NEAR(sum / count, 255 * CameraCurve(light), 0.3);
  }
}

TEST(Sensor, NoiseOfTwoPhotosIsUnrelated) {
  const Camera camera = Lens(300, 200);
  SensorEffects effects;
  effects.noise = 0.05;
  effects.seed = 1;
  const Image one = Develop(Plain(300, 200, 0.3f), camera, effects, 1);
  effects.seed = 2;
  const Image two = Develop(Plain(300, 200, 0.3f), camera, effects, 1);
  double both = 0, square = 0;
  const double mean = 255 * CameraCurve(0.3);
  for (size_t i = 0; i < one.data.size(); ++i) {
    both += (one.data[i] - mean) * (two.data[i] - mean);
    square += (one.data[i] - mean) * (one.data[i] - mean);
  }
  EXPECT_LT(std::abs(both / square), 0.015);  // of 180 000 values: 0.0024 is one deviation
}

TEST(Sensor, SharpensThePictureThatItDeveloped) {
  const Camera camera = Lens(60, 60);
  SensorEffects effects;
  effects.noise = 0.02;
  effects.focus_blur_px = 0.8;
  const Image soft = Develop(Dot(60, 30, 20), camera, effects, 1);
  effects.sharpening = 1.5;
  const Image sharp = Develop(Dot(60, 30, 20), camera, effects, 1);
  EXPECT_NE(sharp.data, soft.data);
  EXPECT_EQ(sharp.data, Sharpened(soft, 1.5, 1).data);
}

TEST(Sensor, SameBytesAtAnyNumberOfThreads) {
  const Camera camera = Lens(333, 222);
  Radiance picture = Plain(333, 222, 0);
  Random random(3);
  for (float& light : picture.rgb) light = static_cast<float>(random.Unit());
  SensorEffects effects;
  effects.noise = 0.02;
  effects.focus_blur_px = 0.8;
  effects.turn_rad = {0.004, -0.01, 0.02};
  effects.vignetting = 0.2;
  effects.sharpening = 1;
  EXPECT_EQ(Develop(picture, camera, effects, 1).data, Develop(picture, camera, effects, 4).data);
}

TEST(Sensor, CurveRisesFromBlackToWhite) {
  EXPECT_EQ(CameraCurve(-1), 0);
  EXPECT_EQ(CameraCurve(0), 0);
  for (double light = 0.001; light < 3; light += 0.001) {
    EXPECT_GT(CameraCurve(light), CameraCurve(light - 0.001));
  }
  EXPECT_GT(CameraCurve(3), 0.995);
  EXPECT_LE(CameraCurve(1e9), 1);
}

TEST(Exposure, MeterWantsMiddleGreyAndKeepsHighlights) {
  EXPECT_NEAR(MeteredExposure(Plain(20, 20, 0.38f)), 0.5, 1e-3);
  Radiance sky = Plain(20, 20, 0.02f);
  for (size_t i = 0; i < 3 * 20 * 4; ++i) sky.rgb[i] = 1.9f;  // a fifth of the picture
  EXPECT_NEAR(MeteredExposure(sky), 0.475, 0.01);
  EXPECT_EQ(MeteredExposure(Plain(4, 4, 0)), 1);
}

TEST(Exposure, WandersNoFartherThanAskedAndSlowly) {
  std::vector<double> metered;
  for (int i = 0; i < 200; ++i) metered.push_back(i % 20 < 10 ? 0.5 : 2.0);
  FlightOptions options;
  options.exposure_drift = 0.15;
  const auto exposures = Exposures(metered, options);
  double least = 1e9, most = 0;
  for (const double exposure : exposures) {
    least = std::min(least, exposure);
    most = std::max(most, exposure);
  }
  EXPECT_GE(least, 2.0 / 1.1500001 / 4);
  EXPECT_LE(most, 2.0 * 1.1500001);
  EXPECT_GT(most / least, 1.1);
  // The photo after a change still has much of the exposure before.
  const double step = std::log(exposures[10] / exposures[9]);
  EXPECT_LT(std::abs(step), 0.95 * std::log(most / least));
  options.exposure_drift = 0;
  for (const double exposure : Exposures(metered, options)) EXPECT_EQ(exposure, 2.0);
  options.exposure_ev = -1;
  for (const double exposure : Exposures(metered, options)) EXPECT_EQ(exposure, 1.0);
}

TEST(Exposure, WhiteBalanceStaysInItsBounds) {
  FlightOptions options;
  options.white_balance_drift = 0.05;
  double least = 2, most = 0;
  for (int t = 0; t < 5000; t += 10) {
    const Eigen::Vector3d gains = WhiteBalance({1, 1, 1}, t, options);
    EXPECT_EQ(gains[1], 1);
    least = std::min({least, gains[0], gains[2]});
    most = std::max({most, gains[0], gains[2]});
  }
  EXPECT_GE(least, 0.95);
  EXPECT_LE(most, 1.05);
  EXPECT_GT(most - least, 0.04);
  options.white_balance_drift = 0;
  options.warmth = 0.1;
  EXPECT_LT((WhiteBalance({2, 1, 1}, 70, options) - Eigen::Vector3d(2.2, 1, 0.9)).norm(), 1e-12);
}

TEST(Exposure, ShutterGivesTheExposureByTimeAndIso) {
  EXPECT_NEAR(ShutterFor(1).time_s, 1.0 / 1600, 1e-9);
  EXPECT_EQ(ShutterFor(1).iso, 100);
  const Shutter dark = ShutterFor(20);
  EXPECT_EQ(dark.iso, 400);
  EXPECT_NEAR(dark.time_s * dark.iso, 20 * 100.0 / 1600, 1e-9);
}

}  // namespace
}  // namespace stucco::simulate
