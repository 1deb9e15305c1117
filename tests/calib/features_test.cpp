// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/calib/made_scene.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

struct Blob {
  double x, y, sigma;  // pixels, the centre of the top-left pixel at (0.5, 0.5)
};

Image Render(int width, int height, const std::vector<Blob>& blobs) {
  Image image{width, height, 3, std::vector<uint8_t>(size_t{3} * width * height)};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      double value = 40;
      for (const Blob& b : blobs) {
        const double squared = std::pow(column + 0.5 - b.x, 2) + std::pow(row + 0.5 - b.y, 2);
        value += 180 * std::exp(-squared / (2 * b.sigma * b.sigma));
      }
      const auto level = static_cast<uint8_t>(std::clamp(std::lround(value), 0l, 255l));
      std::fill_n(image.Pixel(column, row), 3, level);
    }
  }
  return image;
}

// Sum of random waves: features everywhere.
Image Waves(int width, int height, uint32_t seed) {
  Random random(seed);
  std::vector<std::array<double, 4>> waves;
  for (int i = 0; i < 25; ++i) {
    waves.push_back({random.Uniform(-0.8, 0.8), random.Uniform(-0.8, 0.8), random.Uniform(0, 6),
                     random.Uniform(5, 14)});
  }
  Image image{width, height, 3, std::vector<uint8_t>(size_t{3} * width * height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double value = 128;
      for (const auto& [u, v, phase, size] : waves) value += size * std::sin(u * x + v * y + phase);
      image.Pixel(x, y)[0] = static_cast<uint8_t>(std::clamp(value, 0.0, 255.0));
      image.Pixel(x, y)[1] = image.Pixel(x, y)[0];
      image.Pixel(x, y)[2] = static_cast<uint8_t>(x % 256);
    }
  }
  return image;
}

const Keypoint& Nearest(const Features& features, double x, double y) {
  return *std::min_element(features.keypoints.begin(), features.keypoints.end(),
                           [&](const Keypoint& a, const Keypoint& b) {
                             return std::hypot(a.x - x, a.y - y) < std::hypot(b.x - x, b.y - y);
                           });
}

TEST(DetectFeatures, FindsBlobsToAFewHundredthsOfAPixel) {
  const std::vector<Blob> blobs = {
      {60.3, 40.7, 2.5}, {150.85, 61.2, 3.5}, {80.5, 120.5, 5}, {170.0, 140.35, 7}};
  const Features features = DetectFeatures(Render(230, 190, blobs), {230, 190}, {});
  ASSERT_GE(features.size(), blobs.size());
  for (const Blob& blob : blobs) {
    const Keypoint& found = Nearest(features, blob.x, blob.y);
    EXPECT_NEAR(found.x, blob.x, 0.05) << "sigma " << blob.sigma;
    EXPECT_NEAR(found.y, blob.y, 0.05) << "sigma " << blob.sigma;
    EXPECT_NEAR(found.scale / blob.sigma, 1, 0.3);
  }
}

TEST(DetectFeatures, ReportsPixelsOfTheFullPhoto) {
  const Features features = DetectFeatures(Render(200, 150, {{80.25, 60.75, 3}}), {800, 600}, {});
  ASSERT_GE(features.size(), 1u);
  const Keypoint& found = Nearest(features, 321, 243);
  EXPECT_NEAR(found.x, 321, 0.2);
  EXPECT_NEAR(found.y, 243, 0.2);
  EXPECT_NEAR(found.scale, 12, 4);
}

TEST(DetectFeatures, KeepsTheAskedNumberOverAllOfThePicture) {
  const Image image = Waves(320, 240, 1);
  const Features all = DetectFeatures(image, {320, 240}, {});
  ASSERT_GT(all.size(), 300u);
  const Features some = DetectFeatures(image, {320, 240}, {.max_features = 150});
  EXPECT_EQ(some.size(), 150u);
  EXPECT_EQ(some.colors.size(), 150u);
  EXPECT_EQ(some.descriptors.size(), 150u);
  int quarters[4] = {0, 0, 0, 0};
  for (const Keypoint& k : some.keypoints) ++quarters[(k.x > 160) + 2 * (k.y > 120)];
  for (const int count : quarters) EXPECT_GT(count, 15);
}

TEST(DetectFeatures, TakesColoursFromThePlace) {
  const Features features = DetectFeatures(Waves(320, 240, 2), {320, 240}, {});
  for (size_t i = 0; i < features.size(); ++i) {
    EXPECT_EQ(features.colors[i][2], static_cast<int>(features.keypoints[i].x) % 256);
  }
}

TEST(DetectFeatures, DescriptorsAreRootSift) {
  const Features features = DetectFeatures(Waves(320, 240, 3), {320, 240}, {});
  for (const auto& descriptor : features.descriptors) {
    double squares = 0;
    for (const uint8_t v : descriptor) squares += static_cast<double>(v) * v;
    EXPECT_NEAR(std::sqrt(squares), 512, 25);  // unit length in units of 1 / 512
  }
}

TEST(DetectFeatures, IsRepeatable) {
  const Image image = Waves(320, 240, 4);
  EXPECT_EQ(Serialize(DetectFeatures(image, {320, 240}, {.max_features = 200})),
            Serialize(DetectFeatures(image, {320, 240}, {.max_features = 200})));
}

TEST(DetectFeatures, NothingInAFlatPicture) {
  const Features features = DetectFeatures(Render(100, 80, {}), {100, 80}, {});
  EXPECT_EQ(features.size(), 0u);
  EXPECT_EQ(DeserializeFeatures(Serialize(features)).size(), 0u);
}

TEST(SerializeFeatures, ReadsBack) {
  const Features features = DetectFeatures(Waves(160, 120, 5), {320, 240}, {});
  const Features back = DeserializeFeatures(Serialize(features));
  ASSERT_EQ(back.size(), features.size());
  EXPECT_EQ(back.colors, features.colors);
  EXPECT_EQ(back.descriptors, features.descriptors);
  for (size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back.keypoints[i].x, features.keypoints[i].x);
    EXPECT_EQ(back.keypoints[i].y, features.keypoints[i].y);
    EXPECT_EQ(back.keypoints[i].scale, features.keypoints[i].scale);
  }
}

TEST(SerializeFeatures, RefusesDamage) {
  const std::string bytes = Serialize(DetectFeatures(Waves(160, 120, 5), {160, 120}, {}));
  for (const size_t length :
       {size_t{0}, size_t{7}, size_t{8}, bytes.size() - 1, bytes.size() / 2}) {
    ExpectBadInput([&] { DeserializeFeatures(std::string_view(bytes).substr(0, length)); },
                   "damaged");
  }
  std::string huge = bytes;
  huge.replace(0, 8, 8, '\xff');  // a count beyond all memory
  ExpectBadInput([&] { DeserializeFeatures(huge); }, "damaged");
}

TEST(SelectSpread, KeepsAllWhenTheyAreFew) {
  const std::vector<Keypoint> keypoints = {{1, 1, 1}, {2, 2, 1}, {3, 3, 1}};
  EXPECT_EQ(SelectSpread(keypoints, {1, 2, 3}, {10, 10}, 3), (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(SelectSpread({}, {}, {10, 10}, 3).empty());
}

TEST(SelectSpread, LetsWeakPartsOfThePictureTakePart) {
  // 900 strong keypoints on the left, 100 weak ones on the right.
  Random random(4);
  std::vector<Keypoint> keypoints;
  std::vector<float> strengths;
  for (int i = 0; i < 1000; ++i) {
    const bool weak = i % 10 == 0;
    keypoints.push_back({static_cast<float>(random.Uniform(weak ? 500 : 0, weak ? 1000 : 500)),
                         static_cast<float>(random.Uniform(0, 600)), 1});
    strengths.push_back(static_cast<float>(random.Uniform(weak ? 0 : 10, weak ? 1 : 20)));
  }
  const std::vector<int> selected = SelectSpread(keypoints, strengths, {1000, 600}, 200);
  ASSERT_EQ(selected.size(), 200u);
  EXPECT_TRUE(std::is_sorted(selected.begin(), selected.end()));
  EXPECT_EQ(std::adjacent_find(selected.begin(), selected.end()), selected.end());
  const auto weak =
      std::count_if(selected.begin(), selected.end(), [](int i) { return i % 10 == 0; });
  EXPECT_GT(weak, 60);  // by strength alone there would be none
}

TEST(SelectSpread, TakesTheStrongestOfACell) {
  std::vector<Keypoint> keypoints(50, Keypoint{5, 5, 1});
  std::vector<float> strengths(50);
  for (int i = 0; i < 50; ++i) strengths[i] = static_cast<float>((i * 7) % 50);
  std::vector<int> best;
  for (int i = 0; i < 50; ++i) {
    if (strengths[i] >= 40) best.push_back(i);
  }
  EXPECT_EQ(SelectSpread(keypoints, strengths, {10, 10}, 10), best);
}

}  // namespace
}  // namespace stucco::test
