// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "survey/error.h"

namespace stucco {
namespace {

constexpr double kContrastThreshold = 0.02;  // OpenCV divides it by the 3 layers of an octave
constexpr double kEdgeThreshold = 10;
constexpr double kFirstSigma = 1.6;
// OpenCV doubles the image for its first octave by a resize that puts sample X at (X - 0.5) / 2 and
// then reports X / 2, a quarter of a pixel too much; its pixel centres are at integers, ours at +
// 0.5.
constexpr float kPixelFromOpenCvSift = 0.5f - 0.25f;

std::array<uint8_t, 128> RootSift(const float* descriptor) {
  float sum = 0;
  for (int i = 0; i < 128; ++i) sum += descriptor[i];
  std::array<uint8_t, 128> root{};
  if (sum <= 0) return root;
  for (int i = 0; i < 128; ++i) {
    const float value = 512.0f * std::sqrt(descriptor[i] / sum);
    root[i] = static_cast<uint8_t>(std::min(255.0f, std::round(value)));
  }
  return root;
}

template <typename T>
void Append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <typename T>
void Take(std::string_view& bytes, std::vector<T>& values, size_t count) {
  values.resize(count);
  std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
}

}  // namespace

std::vector<int> SelectSpread(const std::vector<Keypoint>& keypoints,
                              const std::vector<float>& strengths, ImageSize size, int count) {
  std::vector<int> order(keypoints.size());
  std::iota(order.begin(), order.end(), 0);
  if (static_cast<int>(order.size()) <= count) return order;
  // About 16 keypoints a cell.
  const double area = static_cast<double>(size.width_px) * size.height_px;
  const double cell_px = std::max(1.0, std::sqrt(area * 16 / count));
  const int columns = static_cast<int>(size.width_px / cell_px) + 1;
  const auto cell_of = [&](int i) {
    return static_cast<int>(keypoints[i].y / cell_px) * columns +
           static_cast<int>(keypoints[i].x / cell_px);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return strengths[a] != strengths[b] ? strengths[a] > strengths[b] : a < b;
  });
  std::vector<int> taken_from_cell(
      static_cast<size_t>(columns) * (static_cast<size_t>(size.height_px / cell_px) + 2), 0);
  std::vector<std::pair<int, int>> turns;  // (turn of its cell, rank by strength)
  turns.reserve(order.size());
  for (int rank = 0; rank < static_cast<int>(order.size()); ++rank) {
    turns.emplace_back(taken_from_cell[cell_of(order[rank])]++, rank);
  }
  std::sort(turns.begin(), turns.end());
  std::vector<int> selected;
  selected.reserve(count);
  for (int i = 0; i < count; ++i) selected.push_back(order[turns[i].second]);
  std::sort(selected.begin(), selected.end());
  return selected;
}

Features DetectFeatures(const Image& image, ImageSize full, const FeatureOptions& options) {
  assert(image.channels == 3);
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3,
                    const_cast<uint8_t*>(image.data.data()));
  cv::Mat gray;
  cv::cvtColor(rgb, gray, cv::COLOR_RGB2GRAY);
  std::vector<cv::KeyPoint> detected;
  const auto sift = cv::SIFT::create(0, 3, kContrastThreshold, kEdgeThreshold, kFirstSigma);
  sift->detect(gray, detected);
  // OpenCV finds them on several threads; a total order makes the list independent of that.
  std::sort(detected.begin(), detected.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return std::tie(a.pt.y, a.pt.x, a.size, a.angle, a.response, a.octave) <
           std::tie(b.pt.y, b.pt.x, b.size, b.angle, b.response, b.octave);
  });

  std::vector<Keypoint> in_image(detected.size());
  std::vector<float> strengths(detected.size());
  for (size_t i = 0; i < detected.size(); ++i) {
    in_image[i] = {
        std::clamp(detected[i].pt.x + kPixelFromOpenCvSift, 0.0f, image.width_px - 0.01f),
        std::clamp(detected[i].pt.y + kPixelFromOpenCvSift, 0.0f, image.height_px - 0.01f),
        detected[i].size / 2};
    strengths[i] = detected[i].response;
  }
  const ImageSize size{image.width_px, image.height_px};
  std::vector<cv::KeyPoint> kept;
  Features features;
  const float scale_x = static_cast<float>(full.width_px) / image.width_px;
  const float scale_y = static_cast<float>(full.height_px) / image.height_px;
  for (const int i : SelectSpread(in_image, strengths, size, options.max_features)) {
    kept.push_back(detected[i]);
    const Keypoint& k = in_image[i];
    features.keypoints.push_back({k.x * scale_x, k.y * scale_y, k.scale * scale_x});
    const uint8_t* color = image.Pixel(static_cast<int>(k.x), static_cast<int>(k.y));
    features.colors.push_back({color[0], color[1], color[2]});
  }
  if (kept.empty()) return features;
  cv::Mat descriptors;
  sift->compute(gray, kept, descriptors);
  if (kept.size() != features.size()) {
    throw Error(ErrorKind::kStageFailed, "OpenCV dropped keypoints while describing them");
  }
  for (int i = 0; i < descriptors.rows; ++i) {
    features.descriptors.push_back(RootSift(descriptors.ptr<float>(i)));
  }
  return features;
}

std::string Serialize(const Features& features) {
  const uint64_t count = features.size();
  std::string bytes(reinterpret_cast<const char*>(&count), sizeof(count));
  Append(bytes, features.keypoints);
  Append(bytes, features.colors);
  Append(bytes, features.descriptors);
  return bytes;
}

Features DeserializeFeatures(std::string_view bytes) {
  constexpr size_t kBytesEach = sizeof(Keypoint) + 3 + 128;
  uint64_t count = 0;
  if (bytes.size() >= sizeof(count)) std::memcpy(&count, bytes.data(), sizeof(count));
  if (bytes.size() < sizeof(count) || (bytes.size() - sizeof(count)) / kBytesEach != count ||
      (bytes.size() - sizeof(count)) % kBytesEach != 0) {
    throw Error(ErrorKind::kBadInput, "features: the checkpoint is damaged");
  }
  bytes.remove_prefix(sizeof(count));
  Features features;
  Take(bytes, features.keypoints, count);
  Take(bytes, features.colors, count);
  Take(bytes, features.descriptors, count);
  return features;
}

}  // namespace stucco
