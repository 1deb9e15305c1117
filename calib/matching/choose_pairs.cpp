// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/choose_pairs.h"

#include <algorithm>
#include <optional>
#include <set>

#include "calib/features/pairs.h"
#include "survey/georef.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr int kVocabularyWords = 64;
constexpr int kSamplesPerPhoto = 200;
constexpr int kMostSamples = 100000;  // of all photos, enough for so few words
// Up to this many photos every pair is matched even when a plan says which overlap.
constexpr int kExhaustiveWithPlan = 20;
constexpr int kAlikeWithPlan = 5;
// With fewer pairs the plan says too little of a photo.
constexpr int kEnoughByPlan = 10;

// How many of the pairs each photo is in.
std::vector<int> PairsPerPhoto(const PhotoPairs& pairs, size_t num_photos) {
  std::vector<int> count(num_photos, 0);
  for (const auto& [a, b] : pairs) {
    ++count[a];
    ++count[b];
  }
  return count;
}

}  // namespace

std::vector<std::optional<Eigen::Vector3d>> RoughPositions(
    const std::vector<const CapturedPhoto*>& photos) {
  std::vector<std::optional<Eigen::Vector3d>> positions(photos.size());
  std::optional<Georef> frame;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto& p = photos[i]->position;
    if (!p) continue;
    if (!frame) {
      frame = Georef{};
      frame->origin_latitude_deg = p->latitude_deg;
      frame->origin_longitude_deg = p->longitude_deg;
      frame->origin_height_m = p->height_m;
    }
    const double height_m = p->has_height ? p->height_m : frame->origin_height_m;
    positions[i] = EnuFromGeodetic(*frame, p->latitude_deg, p->longitude_deg, height_m);
  }
  return positions;
}

std::vector<std::vector<float>> Signatures(int count,
                                           const std::function<Features(int)>& features_of,
                                           int threads) {
  const int of_photo = std::clamp(kMostSamples / std::max(count, 1), 1, kSamplesPerPhoto);
  std::vector<std::vector<int16_t>> samples_of(count);
  ParallelFor(count, threads, [&](size_t i) {
    samples_of[i] = SampleDescriptors(features_of(static_cast<int>(i)), of_photo);
  });
  std::vector<int16_t> samples;
  for (const auto& rows : samples_of) samples.insert(samples.end(), rows.begin(), rows.end());
  const std::vector<float> words = TrainVocabulary(samples, kVocabularyWords, threads);
  std::vector<std::vector<float>> signatures(count);
  ParallelFor(count, threads, [&](size_t i) {
    signatures[i] = Signature(features_of(static_cast<int>(i)), words);
  });
  return signatures;
}

PairChoice ChoosePairs(const CalibOptions& options, const PhotoSet& set,
                       const std::function<Features(int)>& features_of, int threads) {
  const PhotoPairs& guided = set.guidance.pairs;
  const int count = static_cast<int>(set.photos.size());
  const bool by_plan = !guided.empty() && count > kExhaustiveWithPlan;
  std::vector<std::vector<float>> signatures(count);
  if (by_plan || count > options.exhaustive_below) {
    signatures = Signatures(count, features_of, threads);
  }
  PhotoPairs likely = SelectPairs({.exhaustive_below = options.exhaustive_below,
                                   .neighbours = options.neighbours,
                                   .threads = threads},
                                  RoughPositions(set.photos), signatures);
  if (!by_plan) return {std::move(likely), false, {}};
  // The plan knows better than nearness what overlaps; looks are there for where it is wrong.
  const PhotoPairs alike =
      MostAlike(signatures, std::min(options.neighbours, kAlikeWithPlan), threads);
  std::set<std::pair<int, int>> pairs(guided.begin(), guided.end());
  pairs.insert(alike.begin(), alike.end());
  const std::vector<int> by_photo = PairsPerPhoto(guided, set.photos.size());
  const int enough = std::min(kEnoughByPlan, options.neighbours);
  PairChoice choice{{}, true, {}};
  for (const auto& pair : likely) {
    if (by_photo[pair.first] < enough || by_photo[pair.second] < enough) {
      pairs.insert(pair);
    } else if (!pairs.contains(pair)) {
      choice.otherwise.push_back(pair);
    }
  }
  choice.pairs.assign(pairs.begin(), pairs.end());
  return choice;
}

}  // namespace stucco
