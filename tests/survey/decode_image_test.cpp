// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/decode_image.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "survey/files.h"
#include "survey/image.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ExpectBadInput;
using test::TemporaryFolder;

std::string Encoded(const cv::Mat& pixels, const char* extension) {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, pixels, bytes));
  return {bytes.begin(), bytes.end()};
}

TEST(DecodeImage, KeepsGreyColourAndAlpha) {
  const cv::Mat grey = (cv::Mat_<uint8_t>(2, 3) << 0, 1, 2, 253, 254, 255);
  const Image of_grey = DecodeImage(Encoded(grey, ".png"), "a");
  EXPECT_EQ(of_grey.width_px, 3);
  EXPECT_EQ(of_grey.height_px, 2);
  EXPECT_EQ(of_grey.channels, 1);
  EXPECT_EQ(of_grey.data, (std::vector<uint8_t>{0, 1, 2, 253, 254, 255}));
  const cv::Mat bgr(1, 1, CV_8UC3, cv::Scalar(30, 20, 10));
  for (const char* extension : {".png", ".tif", ".bmp"}) {
    const Image colour = DecodeImage(Encoded(bgr, extension), "a");
    EXPECT_EQ(colour.channels, 3);
    EXPECT_EQ(colour.data, (std::vector<uint8_t>{10, 20, 30})) << extension;
  }
  const cv::Mat bgra(1, 1, CV_8UC4, cv::Scalar(30, 20, 10, 128));
  EXPECT_EQ(DecodeImage(Encoded(bgra, ".png"), "a").data, (std::vector<uint8_t>{10, 20, 30, 128}));
}

TEST(DecodeImage, BringsSixteenBitsToEight) {
  const cv::Mat deep = (cv::Mat_<uint16_t>(1, 3) << 0, 257 * 100, 65535);
  EXPECT_EQ(DecodeImage(Encoded(deep, ".png"), "a").data, (std::vector<uint8_t>{0, 100, 255}));
}

TEST(DecodeImage, TakesJpegAsReadJpegDoes) {
  const TemporaryFolder folder;
  cv::Mat bgr(40, 50, CV_8UC3, cv::Scalar(200, 40, 90));
  bgr(cv::Rect(10, 10, 20, 20)).setTo(cv::Scalar(10, 220, 30));
  const std::string bytes = Encoded(bgr, ".jpg");
  WriteFile(folder / "a.jpg", bytes);
  EXPECT_EQ(DecodeImage(bytes, "a").data, ReadJpeg(folder / "a.jpg").data);
}

TEST(DecodeImage, RefusesWhatIsNoPicture) {
  const std::string png = Encoded(cv::Mat(64, 64, CV_8UC3, cv::Scalar(1, 2, 3)), ".png");
  for (const std::string& bytes :
       {std::string(), std::string("a text"), png.substr(0, 20),
        Encoded(cv::Mat(64, 64, CV_8UC3, cv::Scalar(1, 2, 3)), ".jpg").substr(0, 200)}) {
    ExpectBadInput([&] { DecodeImage(bytes, "walls.glb: image 3"); }, "walls.glb: image 3");
  }
}

}  // namespace
}  // namespace stucco
