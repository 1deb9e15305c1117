// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/sharpen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "simulate/random.h"

namespace stucco::simulate {
namespace {

Image Grey(int width_px, int height_px, const std::function<double(int, int)>& value) {
  Image image{width_px, height_px, 3, {}};
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      image.data.insert(image.data.end(), 3, cv::saturate_cast<uint8_t>(value(x, y)));
    }
  }
  return image;
}

Image Noise(int width_px, int height_px) {
  Random random(7);
  Image image{width_px, height_px, 3, std::vector<uint8_t>(size_t{3} * width_px * height_px)};
  for (uint8_t& code : image.data) code = cv::saturate_cast<uint8_t>(255 * random.Unit());
  return image;
}

// Grey noise as a lens leaves it: little between neighbours.
Image SoftNoise(int side_px) {
  Random random(7);
  cv::Mat noise(side_px, side_px, CV_32F);
  for (float& value : cv::Mat_<float>(noise)) value = static_cast<float>(random.Normal());
  cv::GaussianBlur(noise, noise, {}, 1);
  return Grey(side_px, side_px, [&](int x, int y) { return 128 + 100 * noise.at<float>(y, x); });
}

// An edge at `at`, as wide as a Gaussian of `sigma_px` makes it: -1 to 1.
double Edge(double x, double at, double sigma_px) {
  return std::erf((x - at) / (std::sqrt(2.0) * sigma_px));
}

cv::Mat GreyOf(const Image& image) {
  cv::Mat grey(image.height_px, image.width_px, CV_8U);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) grey.at<uint8_t>(y, x) = image.Pixel(x, y)[1];
  }
  return grey;
}

double MeanOf(const Image& image) {
  double sum = 0;
  for (const uint8_t code : image.data) sum += code;
  return sum / static_cast<double>(image.data.size());
}

// Mean amplitude at `low` to `high` waves per pixel.
double Amplitude(const Image& image, double low, double high) {
  cv::Mat values, waves;
  GreyOf(image).convertTo(values, CV_64F);
  cv::dft(values - cv::mean(values), waves, cv::DFT_COMPLEX_OUTPUT);
  double sum = 0;
  int count = 0;
  for (int v = 0; v < waves.rows; ++v) {
    for (int u = 0; u < waves.cols; ++u) {
      const double across = std::min(u, waves.cols - u) / static_cast<double>(waves.cols);
      const double down = std::min(v, waves.rows - v) / static_cast<double>(waves.rows);
      const double frequency = std::hypot(across, down);
      if (!(frequency >= low && frequency < high)) continue;
      sum += cv::norm(waves.at<cv::Vec2d>(v, u));
      ++count;
    }
  }
  return sum / count;
}

TEST(Sharpened, ZeroLeavesThePictureAsItIs) {
  const Image noise = Noise(31, 17);
  EXPECT_EQ(Sharpened(noise, 0, 2).data, noise.data);
  EXPECT_NE(Sharpened(noise, 1, 2).data, noise.data);
}

TEST(Sharpened, FlatAreasStayFlat) {
  Image plain{20, 9, 3, {}};
  for (int i = 0; i < 20 * 9; ++i) plain.data.insert(plain.data.end(), {201, 40, 117});
  EXPECT_EQ(Sharpened(plain, 3, 1).data, plain.data);
  // Nor does a slope change, but at its ends.
  const Image slope = Grey(40, 12, [](int x, int /*y*/) { return 50 + 4 * x; });
  const Image sharpened = Sharpened(slope, 3, 1);
  for (int x = 3; x < 37; ++x) EXPECT_EQ(sharpened.Pixel(x, 5)[0], slope.Pixel(x, 5)[0]) << x;
}

TEST(Sharpened, EdgesGetSteeperWithinTheirLimits) {
  const Image edge = Grey(41, 9, [](int x, int /*y*/) { return 120 + 50 * Edge(x, 20, 1); });
  double steepest = 0;
  for (const double strength : {0.0, 0.5, 1.0, 3.0}) {
    const Image sharpened = Sharpened(edge, strength, 1);
    const int step = sharpened.Pixel(21, 4)[0] - sharpened.Pixel(19, 4)[0];
    EXPECT_GT(step, steepest + 3) << strength;
    steepest = step;
    const auto [least, most] = std::minmax_element(sharpened.data.begin(), sharpened.data.end());
    // 70 to 170, and a tenth of it beyond.
    EXPECT_GE(*least, 60) << strength;
    EXPECT_LE(*most, 180) << strength;
    EXPECT_EQ(*most > 172, strength >= 1) << strength;
  }
}

TEST(Sharpened, ColoursStay) {
  Image edge = Grey(30, 6, [](int x, int /*y*/) { return 110 + 30 * Edge(x, 15.3, 0.8); });
  for (size_t i = 0; i < edge.data.size(); i += 3) {
    edge.data[i] += 40;
    edge.data[i + 2] -= 25;
  }
  const Image sharpened = Sharpened(edge, 2, 1);
  ASSERT_NE(sharpened.data, edge.data);
  for (size_t i = 0; i < edge.data.size(); i += 3) {
    EXPECT_EQ(sharpened.data[i] - sharpened.data[i + 1], 40);
    EXPECT_EQ(sharpened.data[i + 1] - sharpened.data[i + 2], 25);
  }
}

TEST(Sharpened, BrightnessStays) {
  const Image soft = SoftNoise(128);
  const Image sharpened = Sharpened(soft, 1, 1);
  ASSERT_NE(sharpened.data, soft.data);
  EXPECT_NEAR(MeanOf(sharpened), MeanOf(soft), 0.1);
}

TEST(Sharpened, CornersStayWhereTheyAre) {
  for (const double at : {30.0, 30.25, 30.5, 30.8}) {
    const Image board = Grey(
        61, 61, [&](int x, int y) { return 125 + 70 * Edge(x, at, 0.7) * Edge(y, at - 0.4, 0.7); });
    const auto corner_of = [&](const Image& image) {
      std::vector<cv::Point2f> corner = {cv::Point2f(30, 30)};
      cv::cornerSubPix(GreyOf(image), corner, {5, 5}, {-1, -1},
                       {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4});
      return corner[0];
    };
    const cv::Point2f before = corner_of(board);
    EXPECT_NEAR(before.x, at, 0.05);
    EXPECT_LT(cv::norm(corner_of(Sharpened(board, 1, 1)) - before), 0.02) << at;
  }
}

TEST(Sharpened, TheSpectrumGetsFlatter) {
  const Image soft = SoftNoise(128);
  const Image sharpened = Sharpened(soft, 1, 1);
  const auto gain = [&](double low, double high) {
    return Amplitude(sharpened, low, high) / Amplitude(soft, low, high);
  };
  EXPECT_NEAR(gain(0.01, 0.04), 1, 0.05);
  // The mask's 1.36 at 0.15 waves a pixel and 1.83 at 0.3, less what the limit of halos takes.
  EXPECT_GT(gain(0.12, 0.18), 1.2);
  EXPECT_LT(gain(0.12, 0.18), 1.4);
  EXPECT_GT(gain(0.25, 0.35), 1.4);
  EXPECT_LT(gain(0.25, 0.35), 1.9);
}

TEST(Sharpened, SameBytesAtAnyNumberOfThreads) {
  const Image noise = Noise(133, 71);
  EXPECT_EQ(Sharpened(noise, 1, 1).data, Sharpened(noise, 1, 4).data);
}

TEST(Sharpened, PicturesSmallerThanTheMaskAreNoTrouble) {
  EXPECT_EQ(Sharpened(Image{}, 1, 1).data.size(), 0u);
  EXPECT_EQ(Sharpened(Noise(1, 1), 1, 1).data, Noise(1, 1).data);
  EXPECT_EQ(Sharpened(Noise(2, 1), 1, 2).data.size(), 6u);
}

}  // namespace
}  // namespace stucco::simulate
