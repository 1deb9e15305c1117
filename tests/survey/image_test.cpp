// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/image.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using std::string_literals::operator""s;
using test::ErrorOf;
using test::ExpectBadInput;
using test::TemporaryFolder;

// Smooth in colour with some texture, so that JPEG is near to it and no part is empty.
Image MakePicture(int width_px, int height_px, int channels) {
  Image image{width_px, height_px, channels, {}};
  image.data.resize(static_cast<size_t>(width_px) * height_px * channels);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      for (int c = 0; c < channels; ++c) {
        image.Pixel(x, y)[c] = static_cast<uint8_t>(40 + c * 60 + 40 * x / width_px +
                                                    30 * y / height_px + (x / 4 + y / 8) % 3 * 8);
      }
    }
  }
  return image;
}

double MeanDifference(const Image& a, const Image& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  double sum = 0;
  for (size_t i = 0; i < a.data.size(); ++i) sum += std::abs(a.data[i] - b.data[i]);
  return sum / static_cast<double>(a.data.size());
}

TEST(Image, PngReadsBackExactly) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    const Image written = MakePicture(37, 21, channels);
    WriteImage(written, folder / "a.PNG");
    const Image read = ReadImage(folder / "a.PNG");
    EXPECT_EQ(read.width_px, 37);
    EXPECT_EQ(read.height_px, 21);
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.data, written.data);
  }
}

TEST(Image, JpegReadsBackNearly) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    const Image written = MakePicture(120, 75, channels);
    WriteImage(written, folder / "a.jpg", 95);
    const Image read = ReadImage(folder / "a.jpg");
    EXPECT_EQ(read.channels, channels);
    EXPECT_LT(MeanDifference(read, written), 3);
    EXPECT_EQ(ReadJpeg(folder / "a.jpg").channels, 3);
    EXPECT_EQ(ReadJpeg(folder / "a.jpg", 1).channels, 1);
    EXPECT_EQ(ReadJpegSize(folder / "a.jpg").width_px, 120);
    EXPECT_EQ(ReadJpegSize(folder / "a.jpg").height_px, 75);
  }
}

TEST(Image, ColoursAreInTheOrderRedGreenBlue) {
  const TemporaryFolder folder;
  Image red{16, 16, 3, std::vector<uint8_t>(16 * 16 * 3, 0)};
  for (size_t i = 0; i < red.data.size(); i += 3) red.data[i] = 250;
  WriteImage(red, folder / "red.jpg");
  const Image read = ReadJpeg(folder / "red.jpg");
  EXPECT_GT(read.Pixel(8, 8)[0], 240);
  EXPECT_LT(read.Pixel(8, 8)[1], 10);
  EXPECT_LT(read.Pixel(8, 8)[2], 10);
}

TEST(Image, ScaledSizeKeepsTheShape) {
  const auto expect = [](ImageSize full, int max_side_px, int width_px, int height_px) {
    const ImageSize size = ScaledSize(full, max_side_px);
    EXPECT_EQ(size.width_px, width_px);
    EXPECT_EQ(size.height_px, height_px);
  };
  expect({5280, 3956}, 0, 5280, 3956);
  expect({5280, 3956}, 6000, 5280, 3956);
  expect({5280, 3956}, 1600, 1600, 1199);
  expect({3956, 5280}, 1600, 1199, 1600);
  expect({10000, 3}, 100, 100, 1);
  expect({65500, 65500}, 40000, 40000, 40000);
}

TEST(Image, JpegShrinksByAreaAverage) {
  const TemporaryFolder folder;
  const Image picture = MakePicture(480, 320, 3);
  WriteImage(picture, folder / "a.jpg", 98);
  const Image full = ReadJpeg(folder / "a.jpg");
  for (const int side : {480, 479, 300, 240, 120, 96, 60, 48, 7, 1}) {
    const Image small = ReadJpeg(folder / "a.jpg", 3, side);
    const ImageSize size = ScaledSize({480, 320}, side);
    ASSERT_EQ(small.width_px, size.width_px);
    ASSERT_EQ(small.height_px, size.height_px);
    ASSERT_EQ(small.data.size(), static_cast<size_t>(size.width_px) * size.height_px * 3);
    if (480 % side != 0 || size.height_px * (480 / side) != 320) continue;
    // Whole blocks: compare with their plain means.
    const int block = 480 / side;
    double difference = 0;
    for (int y = 0; y < size.height_px; ++y) {
      for (int x = 0; x < size.width_px; ++x) {
        double sum = 0;
        for (int i = 0; i < block * block; ++i) {
          sum += full.Pixel(x * block + i % block, y * block + i / block)[1];
        }
        difference += std::abs(sum / (block * block) - small.Pixel(x, y)[1]);
      }
    }
    EXPECT_LT(difference / (size.width_px * size.height_px), 1.5) << side;
  }
}

TEST(Image, BytesDoNotDependOnThreads) {
  const TemporaryFolder folder;
  WriteImage(MakePicture(700, 500, 3), folder / "a.jpg");
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const Image one = ReadJpeg(folder / "a.jpg", 3, 333);
  WriteImage(one, folder / "one.png");
  cv::setNumThreads(2);
  const Image two = ReadJpeg(folder / "a.jpg", 3, 333);
  WriteImage(two, folder / "two.png");
  cv::setNumThreads(before);
  EXPECT_EQ(one.data, two.data);
  EXPECT_EQ(ReadFile(folder / "one.png"), ReadFile(folder / "two.png"));
}

std::string JpegBytes(bool progressive) {
  const Image picture = MakePicture(200, 150, 3);
  const cv::Mat pixels(150, 200, CV_8UC3, const_cast<uint8_t*>(picture.data.data()));
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", pixels, bytes, {cv::IMWRITE_JPEG_PROGRESSIVE, progressive ? 1 : 0});
  return {bytes.begin(), bytes.end()};
}

TEST(Image, RefusesAJpegCutAnywhere) {
  const TemporaryFolder folder;
  for (const bool progressive : {false, true}) {
    const std::string bytes = JpegBytes(progressive);
    WriteFile(folder / "a.jpg", bytes);
    EXPECT_NO_THROW(ReadJpeg(folder / "a.jpg"));
    for (size_t size = 0; size < bytes.size(); size += size < 700 ? 7 : 97) {
      WriteFile(folder / "a.jpg", bytes.substr(0, size));
      EXPECT_FALSE(test::Accepts([&] { ReadJpeg(folder / "a.jpg"); })) << size;
      EXPECT_FALSE(test::Accepts([&] { ReadJpeg(folder / "a.jpg", 1, 25); })) << size;
    }
    WriteFile(folder / "a.jpg", bytes.substr(0, bytes.size() - 1));
    ExpectBadInput([&] { ReadJpeg(folder / "a.jpg"); }, "damaged JPEG: Premature end");
  }
}

TEST(Image, RefusesAJpegWhoseEndIsZeros) {
  const TemporaryFolder folder;
  std::string bytes = JpegBytes(false);
  std::fill(bytes.begin() + static_cast<ptrdiff_t>(bytes.size() / 2), bytes.end(), '\0');
  WriteFile(folder / "a.jpg", bytes);
  ExpectBadInput([&] { ReadJpeg(folder / "a.jpg"); }, "a.jpg: damaged JPEG");
}

TEST(Image, SurvivesAnyByteBeingWrong) {
  const TemporaryFolder folder;
  const std::string bytes = JpegBytes(false);
  for (size_t at = 0; at < bytes.size(); at += at < 700 ? 3 : 97) {
    std::string wrong = bytes;
    wrong[at] = static_cast<char>(~wrong[at]);
    WriteFile(folder / "a.jpg", wrong);
    test::Accepts([&] { ReadJpeg(folder / "a.jpg"); });
    test::Accepts([&] { ReadJpegSize(folder / "a.jpg"); });
  }
}

TEST(Image, TakesWhatCamerasAddBehindThePicture) {
  const TemporaryFolder folder;
  const std::string bytes = JpegBytes(false);
  WriteFile(folder / "a.jpg", bytes + std::string(1000, '\0') + bytes);  // padding and a preview
  EXPECT_EQ(ReadJpeg(folder / "a.jpg").width_px, 200);
}

TEST(Image, TakesPaddingBetweenThePictureAndItsEnd) {
  const TemporaryFolder folder;
  const std::string bytes = JpegBytes(false);
  WriteFile(folder / "a.jpg", bytes);
  const Image picture = ReadJpeg(folder / "a.jpg");
  const std::string end = bytes.substr(bytes.size() - 2);
  ASSERT_EQ(end, "\xff\xd9");
  for (const std::string& padding : {std::string(1, '\0'), std::string(5000, '\0'), "junk"s}) {
    WriteFile(folder / "a.jpg", bytes.substr(0, bytes.size() - 2) + padding + end);
    EXPECT_EQ(ReadJpeg(folder / "a.jpg").data, picture.data);
    EXPECT_EQ(ReadJpeg(folder / "a.jpg", 1, 25).width_px, 25);
  }
  // Too many bytes are no excuse for too few rows.
  const std::string half = bytes.substr(0, bytes.size() / 2);
  WriteFile(folder / "a.jpg", half + end);
  ExpectBadInput([&] { ReadJpeg(folder / "a.jpg"); }, "damaged JPEG");
}

TEST(Image, RefusesASizeThatTheBytesCannotHold) {
  const TemporaryFolder folder;
  std::string bytes = JpegBytes(false);
  const size_t frame = bytes.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  bytes.replace(frame + 5, 4, "\xff\x00\xff\x00", 4);  // 65280 x 65280
  WriteFile(folder / "a.jpg", bytes);
  ExpectBadInput([&] { ReadJpeg(folder / "a.jpg"); }, "cannot hold 65280 x 65280 pixels");
}

TEST(Image, SaysWhatAFileIsInstead) {
  const TemporaryFolder folder;
  WriteImage(MakePicture(8, 8, 3), folder / "picture.png");
  const std::vector<std::pair<std::string, std::string>> files = {
      {"", "empty"},
      {ReadFile(folder / "picture.png"), "a PNG picture"},
      {std::string("II*\0\x08", 5), "a TIFF or raw (DNG) picture"},
      {std::string("MM\0*\x08", 5), "a TIFF or raw (DNG) picture"},
      {std::string("\0\0\0\x18"
                   "ftypheic\0\0",
                   14),
       "an HEIC picture"},
      {std::string("\0\0\0\x18"
                   "ftypavif\0\0",
                   14),
       "an AVIF picture"},
      {std::string("\0\0\0\x18"
                   "ftypmp42\0\0",
                   14),
       "a video"},
      {"RIFF1234WEBPVP8 ", "a WebP picture"},
      {"GIF89a", "a GIF picture"},
      {"BM123456", "a BMP picture"},
      {"%PDF-1.7", "a PDF document"},
      {"PK\x03\x04", "a ZIP archive"},
      {"Ceci n'est pas une photo.\n", "text"},
      {std::string(4096, '\0'), "zeros"},
      {"\x01\x02\x03", "data of an unknown kind"},
      {"\xff\xfe\xff", "data of an unknown kind"},
  };
  for (const auto& [bytes, what] : files) {
    WriteFile(folder / "a.jpg", bytes);
    ExpectBadInput([&] { ReadJpeg(folder / "a.jpg"); }, "a.jpg: not a JPEG but " + what);
    ExpectBadInput([&] { ReadJpegSize(folder / "a.jpg"); }, "a.jpg: not a JPEG but " + what);
  }
  ExpectBadInput([&] { ReadJpeg(folder / "none.jpg"); }, "none.jpg: cannot be read: No such file");
  ExpectBadInput([&] { ReadJpegSize(folder / "none.jpg"); }, "none.jpg: cannot be read: No such");
  ExpectBadInput([&] { ReadJpegSize(folder.path()); }, "cannot be read: Is a directory");
}

TEST(Image, RefusesADamagedPng) {
  const TemporaryFolder folder;
  WriteImage(MakePicture(64, 48, 3), folder / "a.png");
  const std::string bytes = ReadFile(folder / "a.png");
  for (const size_t size : {size_t{8}, size_t{20}, bytes.size() / 2, bytes.size() - 20}) {
    WriteFile(folder / "cut.png", bytes.substr(0, size));
    ExpectBadInput([&] { ReadImage(folder / "cut.png"); }, "cut.png: damaged PNG");
  }
  WriteFile(folder / "text.png", "text");
  ExpectBadInput([&] { ReadImage(folder / "text.png"); }, "neither PNG nor JPEG but text");
}

TEST(Image, RefusesToWriteNonsense) {
  const TemporaryFolder folder;
  const Image good = MakePicture(8, 8, 3);
  EXPECT_EQ(ErrorOf([&] { WriteImage(good, folder / "a.bmp"); }).kind(), ErrorKind::kUsage);
  ExpectBadInput([&] { WriteImage(good, folder / "no/a.png"); }, "cannot be written");
  Image bad = good;
  bad.data.pop_back();
  EXPECT_EQ(ErrorOf([&] { WriteImage(bad, folder / "a.png"); }).kind(), ErrorKind::kStageFailed);
  bad = Image{0, 0, 3, {}};
  EXPECT_EQ(ErrorOf([&] { WriteImage(bad, folder / "a.png"); }).kind(), ErrorKind::kStageFailed);
  const Image wide{70000, 1, 1, std::vector<uint8_t>(70000)};
  EXPECT_EQ(ErrorOf([&] { WriteImage(wide, folder / "a.jpg"); }).kind(), ErrorKind::kStageFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace stucco
