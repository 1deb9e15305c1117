// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/blend.h"

#include <algorithm>
#include <cassert>
#include <opencv2/imgproc.hpp>

#include "texture/painting/fill.h"

namespace stucco {
namespace {

// One float per texel: 1 where the layer with this index owns it.
cv::Mat MaskOf(const std::vector<int>& labels, int owner, int width, int height) {
  cv::Mat weight(height, width, CV_32F);
  std::transform(labels.begin(), labels.end(), weight.begin<float>(),
                 [&](int label) { return label == owner ? 1.0f : 0.0f; });
  return weight;
}

int LevelsFor(int width, int height) {
  int levels = 0;
  while (levels < kBlendLevels && (std::min(width, height) >> (levels + 1)) >= 2) ++levels;
  return levels;
}

// Adds weight * band of every level to `bands`.
void AddLayer(cv::Mat picture, cv::Mat weight, std::vector<cv::Mat>& bands) {
  for (size_t level = 0; level < bands.size(); ++level) {
    cv::Mat band;
    cv::Mat half_picture;
    cv::Mat half_weight;
    if (level + 1 < bands.size()) {
      cv::pyrDown(picture, half_picture);
      cv::pyrDown(weight, half_weight);
      cv::Mat smooth;
      cv::pyrUp(half_picture, smooth, picture.size());
      cv::subtract(picture, smooth, band);  // never into `picture`, which may be the caller's
    } else {
      band = picture;
    }
    cv::Mat weight3;
    cv::merge(std::vector<cv::Mat>(3, weight), weight3);
    const cv::Mat share = band.mul(weight3);
    if (bands[level].empty()) {
      bands[level] = share;
    } else {
      bands[level] += share;
    }
    picture = half_picture;
    weight = half_weight;
  }
}

}  // namespace

std::vector<float> JoinLayers(std::span<const Layer> layers, const std::vector<int>& labels,
                              int width, int height) {
  assert(labels.size() == static_cast<size_t>(width) * height);
  std::vector<float> mosaic(3 * labels.size(), 0);
  std::vector<uint8_t> known(labels.size(), 0);
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    assert(layers[labels[i]].valid[i]);
    std::copy_n(&layers[labels[i]].rgb[3 * i], 3, &mosaic[3 * i]);
    known[i] = 1;
  }
  FillSmoothly(mosaic, known, width, height);
  return mosaic;
}

std::vector<float> BlendLayers(std::span<const Layer> layers, const std::vector<int>& labels,
                               int width, int height) {
  std::vector<float> mosaic = JoinLayers(layers, labels, width, height);
  std::vector<size_t> texels(layers.size(), 0);
  for (int label : labels) {
    if (label >= 0) ++texels[label];
  }
  const auto owners = std::count_if(texels.begin(), texels.end(), [](size_t n) { return n > 0; });
  if (owners < 2) return mosaic;

  const cv::Mat mosaic_mat(height, width, CV_32FC3, mosaic.data());
  std::vector<cv::Mat> bands(LevelsFor(width, height) + 1);
  // Texels of nobody belong to the mosaic, so that weights add up to one everywhere.
  AddLayer(mosaic_mat, MaskOf(labels, -1, width, height), bands);
  for (size_t layer = 0; layer < layers.size(); ++layer) {
    if (texels[layer] == 0) continue;
    cv::Mat picture = mosaic_mat.clone();
    for (size_t i = 0; i < labels.size(); ++i) {
      if (!layers[layer].valid[i]) continue;
      std::copy_n(&layers[layer].rgb[3 * i], 3, picture.ptr<float>() + 3 * i);
    }
    AddLayer(picture, MaskOf(labels, static_cast<int>(layer), width, height), bands);
  }
  cv::Mat result = bands.back();
  for (size_t level = bands.size() - 1; level-- > 0;) {
    cv::Mat up;
    cv::pyrUp(result, up, bands[level].size());
    result = bands[level] + up;
  }
  return std::vector<float>(result.ptr<float>(), result.ptr<float>() + 3 * labels.size());
}

}  // namespace stucco
