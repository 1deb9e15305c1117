// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/pairs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <tuple>

#include "calib/descriptors.h"

namespace stucco {
namespace {

constexpr int kLloydRounds = 10;
constexpr size_t kSignatureDescriptors = 1000;

// Index of the word most similar to each row.
std::vector<int> NearestWords(const std::vector<int16_t>& rows, const std::vector<float>& words) {
  const std::vector<int16_t> unit_words = UnitRows(words);
  const int num_words = static_cast<int>(words.size() / kDescriptorSize);
  std::vector<int32_t> products(num_words);
  std::vector<int> nearest(rows.size() / kDescriptorSize);
  for (size_t r = 0; r < nearest.size(); ++r) {
    DotProducts(rows.data() + r * kDescriptorSize, unit_words.data(), num_words, products.data());
    nearest[r] =
        static_cast<int>(std::max_element(products.begin(), products.end()) - products.begin());
  }
  return nearest;
}

void Normalize(float* values, int count) {
  double squares = 0;
  for (int i = 0; i < count; ++i) squares += static_cast<double>(values[i]) * values[i];
  if (squares <= 0) return;
  const float scale = static_cast<float>(1 / std::sqrt(squares));
  for (int i = 0; i < count; ++i) values[i] *= scale;
}

// The `count` others with the smallest value of `distance`; of equal ones (a GPS that stood still)
// those nearest in the order of photos.
template <typename Distance>
void AddNearest(int photo, int num_photos, int count, const Distance& distance,
                std::set<std::pair<int, int>>& pairs) {
  std::vector<std::tuple<double, int, int>> order;
  for (int other = 0; other < num_photos; ++other) {
    if (other == photo) continue;
    const double d = distance(other);
    if (std::isfinite(d)) order.emplace_back(d, std::abs(other - photo), other);
  }
  std::sort(order.begin(), order.end());
  for (size_t i = 0; i < order.size() && static_cast<int>(i) < count; ++i) {
    const int other = std::get<2>(order[i]);
    pairs.emplace(std::min(photo, other), std::max(photo, other));
  }
}

void AddMostAlike(int photo, const std::vector<std::vector<float>>& signatures, int count,
                  std::set<std::pair<int, int>>& pairs) {
  const auto distance = [&](int other) -> double {
    if (signatures[photo].empty() || signatures[other].empty()) return INFINITY;
    double product = 0;
    for (size_t i = 0; i < signatures[photo].size(); ++i) {
      product += signatures[photo][i] * signatures[other][i];
    }
    return -product;
  };
  AddNearest(photo, static_cast<int>(signatures.size()), count, distance, pairs);
}

}  // namespace

std::vector<std::pair<int, int>> SelectPairs(
    const PairOptions& options, const std::vector<std::optional<Eigen::Vector3d>>& positions,
    const std::vector<std::vector<float>>& signatures) {
  assert(signatures.size() == positions.size());
  const int count = static_cast<int>(positions.size());
  std::set<std::pair<int, int>> pairs;
  for (int a = 0; a < count; ++a) {
    if (count <= options.exhaustive_below) {
      for (int b = a + 1; b < count; ++b) pairs.emplace(a, b);
      continue;
    }
    for (int b = a + 1; b < std::min(count, a + 1 + options.followers); ++b) pairs.emplace(a, b);
    AddNearest(
        a, count, options.neighbours,
        [&](int b) {
          return positions[a] && positions[b] ? (*positions[a] - *positions[b]).norm() : INFINITY;
        },
        pairs);
    AddMostAlike(a, signatures, options.neighbours, pairs);
  }
  return {pairs.begin(), pairs.end()};
}

std::vector<std::pair<int, int>> MostAlike(const std::vector<std::vector<float>>& signatures,
                                           int count) {
  std::set<std::pair<int, int>> pairs;
  for (size_t a = 0; a < signatures.size(); ++a) {
    AddMostAlike(static_cast<int>(a), signatures, count, pairs);
  }
  return {pairs.begin(), pairs.end()};
}

std::vector<float> TrainVocabulary(const std::vector<int16_t>& samples, int count) {
  assert(samples.size() % kDescriptorSize == 0);
  const size_t num_samples = samples.size() / kDescriptorSize;
  if (num_samples == 0) return {};
  std::vector<float> words;
  for (int w = 0; w < count; ++w) {
    const size_t row = num_samples * w / count;
    for (int d = 0; d < kDescriptorSize; ++d) {
      words.push_back(static_cast<float>(samples[row * kDescriptorSize + d] / kDescriptorUnit));
    }
  }
  for (int round = 0; round < kLloydRounds; ++round) {
    const std::vector<int> nearest = NearestWords(samples, words);
    std::vector<float> sums(words.size(), 0);
    std::vector<int> members(count, 0);
    for (size_t r = 0; r < num_samples; ++r) {
      ++members[nearest[r]];
      for (int d = 0; d < kDescriptorSize; ++d) {
        sums[static_cast<size_t>(nearest[r]) * kDescriptorSize + d] +=
            static_cast<float>(samples[r * kDescriptorSize + d] / kDescriptorUnit);
      }
    }
    for (int w = 0; w < count; ++w) {
      if (members[w] == 0) continue;
      std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(w) * kDescriptorSize, kDescriptorSize,
                  words.begin() + static_cast<std::ptrdiff_t>(w) * kDescriptorSize);
      Normalize(words.data() + static_cast<size_t>(w) * kDescriptorSize, kDescriptorSize);
    }
  }
  return words;
}

std::vector<float> Signature(const Features& features, const std::vector<float>& words) {
  assert(words.size() % kDescriptorSize == 0);
  std::vector<int16_t> rows = UnitDescriptors(features);
  const size_t count = features.size();
  if (count == 0 || words.empty()) return {};
  if (count > kSignatureDescriptors) {
    std::vector<int16_t> thinned;
    for (size_t i = 0; i < kSignatureDescriptors; ++i) {
      const size_t row = count * i / kSignatureDescriptors;
      thinned.insert(thinned.end(), rows.begin() + row * kDescriptorSize,
                     rows.begin() + (row + 1) * kDescriptorSize);
    }
    rows = std::move(thinned);
  }
  const std::vector<int> nearest = NearestWords(rows, words);
  std::vector<float> signature(words.size(), 0);
  for (size_t r = 0; r < nearest.size(); ++r) {
    const size_t word = static_cast<size_t>(nearest[r]) * kDescriptorSize;
    for (int d = 0; d < kDescriptorSize; ++d)
      signature[word + d] +=
          static_cast<float>(rows[r * kDescriptorSize + d] / kDescriptorUnit) - words[word + d];
  }
  for (size_t word = 0; word < words.size(); word += kDescriptorSize) {
    Normalize(signature.data() + word, kDescriptorSize);
  }
  Normalize(signature.data(), static_cast<int>(signature.size()));
  return signature;
}

}  // namespace stucco
