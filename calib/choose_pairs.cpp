// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/choose_pairs.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <set>

#include "calib/descriptors.h"
#include "calib/pairs.h"
#include "survey/georef.h"

namespace stucco {
namespace {

constexpr int kVocabularyWords = 64;
constexpr int kSamplesPerPhoto = 200;
// Up to this many photos every pair is matched even when a plan says which overlap.
constexpr int kExhaustiveWithPlan = 20;
constexpr int kAlikeWithPlan = 5;
// With fewer pairs the plan says too little of a photo.
constexpr int kEnoughByPlan = 10;

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

std::vector<std::vector<float>> Signatures(const std::vector<Features>& features) {
  std::vector<int16_t> samples;
  for (const Features& f : features) {
    const std::vector<int16_t> rows = UnitDescriptors(f);
    for (int s = 0; s < kSamplesPerPhoto && f.size() > 0; ++s) {
      const size_t row = f.size() * s / kSamplesPerPhoto * kDescriptorSize;
      samples.insert(samples.end(), rows.begin() + row, rows.begin() + row + kDescriptorSize);
    }
  }
  const std::vector<float> words = TrainVocabulary(samples, kVocabularyWords);
  std::vector<std::vector<float>> signatures;
  signatures.reserve(features.size());
  for (const Features& f : features) signatures.push_back(Signature(f, words));
  return signatures;
}

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

PairChoice ChoosePairs(const CalibOptions& options, const PhotoSet& set,
                       const std::vector<Features>& features) {
  assert(features.size() == set.photos.size());
  const PhotoPairs& guided = set.guidance.pairs;
  const int count = static_cast<int>(set.photos.size());
  const bool by_plan = !guided.empty() && count > kExhaustiveWithPlan;
  std::vector<std::vector<float>> signatures(count);
  if (by_plan || count > options.exhaustive_below) signatures = Signatures(features);
  PhotoPairs likely = SelectPairs({options.exhaustive_below, options.neighbours},
                                  RoughPositions(set.photos), signatures);
  if (!by_plan) return {std::move(likely), false, {}};
  // The plan knows better than nearness what overlaps; looks are there for where it is wrong.
  const PhotoPairs alike = MostAlike(signatures, std::min(options.neighbours, kAlikeWithPlan));
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
