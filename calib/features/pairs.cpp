// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/pairs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <tuple>

#include "calib/features/descriptors.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr int kLloydRounds = 10;
constexpr size_t kSignatureDescriptors = 1000;

// Index of the word most similar to each row.
std::vector<int> NearestWords(const std::vector<int16_t>& rows, const std::vector<float>& words,
                              int threads) {
  constexpr size_t kRowsAtOnce = 1000;
  const std::vector<int16_t> unit_words = UnitRows(words);
  const int num_words = static_cast<int>(words.size() / kDescriptorSize);
  std::vector<int> nearest(rows.size() / kDescriptorSize);
  ParallelFor((nearest.size() + kRowsAtOnce - 1) / kRowsAtOnce, threads, [&](size_t block) {
    std::vector<int32_t> products(num_words);
    const size_t end = std::min(nearest.size(), (block + 1) * kRowsAtOnce);
    for (size_t r = block * kRowsAtOnce; r < end; ++r) {
      DotProducts(rows.data() + r * kDescriptorSize, unit_words.data(), num_words, products.data());
      nearest[r] =
          static_cast<int>(std::max_element(products.begin(), products.end()) - products.begin());
    }
  });
  return nearest;
}

void Normalize(float* values, int count) {
  double squares = 0;
  for (int i = 0; i < count; ++i) squares += static_cast<double>(values[i]) * values[i];
  if (squares <= 0) return;
  const float scale = static_cast<float>(1 / std::sqrt(squares));
  for (int i = 0; i < count; ++i) values[i] *= scale;
}

using Pairs = std::vector<std::pair<int, int>>;

// The `count` others with the smallest value of `distance`; of equal ones (a GPS that stood still)
// those nearest in the order of photos.
template <typename Distance>
void AddNearest(int photo, int num_photos, int count, const Distance& distance, Pairs& pairs) {
  std::vector<std::tuple<double, int, int>> order;
  for (int other = 0; other < num_photos; ++other) {
    if (other == photo) continue;
    const double d = distance(other);
    if (std::isfinite(d)) order.emplace_back(d, std::abs(other - photo), other);
  }
  const auto end = order.begin() + std::min<std::ptrdiff_t>(std::ssize(order), count);
  if (end != order.end()) std::nth_element(order.begin(), end, order.end());
  for (auto near = order.begin(); near != end; ++near) {
    const int other = std::get<2>(*near);
    pairs.emplace_back(std::min(photo, other), std::max(photo, other));
  }
}

__attribute__((target_clones("avx2", "default"))) int32_t Product(const int16_t* a,
                                                                  const int16_t* b, size_t count) {
  int32_t sum = 0;
  for (size_t i = 0; i < count; ++i) sum += int32_t{a[i]} * b[i];
  return sum;
}

// Signatures in whole numbers, so that products of all of them are fast and exact.
class Appearances {
 public:
  explicit Appearances(const std::vector<std::vector<float>>& signatures) {
    rounded_.reserve(signatures.size());
    for (const std::vector<float>& signature : signatures) {
      std::vector<int16_t>& rounded = rounded_.emplace_back();
      rounded.reserve(signature.size());
      for (const float value : signature) {
        rounded.push_back(static_cast<int16_t>(std::lround(value * kUnit)));
      }
    }
  }

  // Of photos first to end - 1. A few photos are held against a few others at a time, as many as
  // stay near the processor: the signatures of a large survey do not.
  void AddMostAlike(size_t first, size_t end, int count, Pairs& pairs) const {
    const size_t all = rounded_.size();
    std::vector<double> distances((end - first) * all, INFINITY);
    for (size_t begin = 0; begin < all; begin += kAtOnce) {
      for (size_t photo = first; photo < end; ++photo) {
        for (size_t other = begin; other < std::min(all, begin + kAtOnce); ++other) {
          if (rounded_[photo].empty() || rounded_[other].empty()) continue;
          distances[(photo - first) * all + other] =
              -Product(rounded_[photo].data(), rounded_[other].data(), rounded_[photo].size());
        }
      }
    }
    for (size_t photo = first; photo < end; ++photo) {
      const double* distance = distances.data() + (photo - first) * all;
      AddNearest(
          static_cast<int>(photo), static_cast<int>(all), count,
          [distance](int other) { return distance[other]; }, pairs);
    }
  }

  static constexpr size_t kAtOnce = 16;

 private:
  // Products of vectors of this length, and parts of them, fit into 32 bits.
  static constexpr float kUnit = 32000;

  std::vector<std::vector<int16_t>> rounded_;
};

// What fn(part, pairs) adds for each of so many parts of the photos; ascending, each pair once.
template <typename Fn>
Pairs OfAllParts(size_t num_parts, int threads, const Fn& fn) {
  std::vector<Pairs> of_part(num_parts);
  ParallelFor(num_parts, threads, [&](size_t part) { fn(part, of_part[part]); });
  Pairs all;
  for (const Pairs& pairs : of_part) all.insert(all.end(), pairs.begin(), pairs.end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::vector<std::pair<int, int>> SelectPairs(
    const PairOptions& options, const std::vector<std::optional<Eigen::Vector3d>>& positions,
    const std::vector<std::vector<float>>& signatures) {
  assert(signatures.size() == positions.size());
  const int count = static_cast<int>(positions.size());
  const bool all = count <= options.exhaustive_below;
  Pairs near = OfAllParts(positions.size(), options.threads, [&](size_t photo, Pairs& pairs) {
    const int a = static_cast<int>(photo);
    const int end = all ? count : std::min(count, a + 1 + options.followers);
    for (int b = a + 1; b < end; ++b) pairs.emplace_back(a, b);
    if (all) return;
    AddNearest(
        a, count, options.neighbours,
        [&](int b) {
          return positions[a] && positions[b] ? (*positions[a] - *positions[b]).norm() : INFINITY;
        },
        pairs);
  });
  if (all) return near;
  const Pairs alike = MostAlike(signatures, options.neighbours, options.threads);
  Pairs pairs;
  std::ranges::set_union(near, alike, std::back_inserter(pairs));
  return pairs;
}

std::vector<std::pair<int, int>> MostAlike(const std::vector<std::vector<float>>& signatures,
                                           int count, int threads) {
  const Appearances appearances(signatures);
  constexpr size_t kPart = Appearances::kAtOnce;
  const size_t parts = (signatures.size() + kPart - 1) / kPart;
  return OfAllParts(parts, threads, [&](size_t part, Pairs& pairs) {
    const size_t end = std::min(signatures.size(), (part + 1) * kPart);
    appearances.AddMostAlike(part * kPart, end, count, pairs);
  });
}

std::vector<float> TrainVocabulary(const std::vector<int16_t>& samples, int count, int threads) {
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
    const std::vector<int> nearest = NearestWords(samples, words, threads);
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

std::vector<int16_t> SampleDescriptors(const Features& features, size_t count) {
  if (features.size() <= count) return UnitDescriptors(features);
  Features some;
  for (size_t i = 0; i < count; ++i) {
    some.descriptors.push_back(features.descriptors[features.size() * i / count]);
  }
  return UnitDescriptors(some);
}

std::vector<float> Signature(const Features& features, const std::vector<float>& words) {
  assert(words.size() % kDescriptorSize == 0);
  if (features.size() == 0 || words.empty()) return {};
  const std::vector<int16_t> rows = SampleDescriptors(features, kSignatureDescriptors);
  const std::vector<int> nearest = NearestWords(rows, words, 1);
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
