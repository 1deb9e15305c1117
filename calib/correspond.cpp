// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/correspond.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/core/utility.hpp>

#include "calib/descriptors.h"
#include "calib/pairs.h"
#include "calib/planned_pairs.h"
#include "survey/files.h"
#include "survey/georef.h"
#include "survey/image.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// Raise when the code behind a checkpoint changes what it computes.
constexpr char kFeaturesVersion[] = "features-1";
constexpr char kPairVersion[] = "pair-2";
constexpr int kVocabularyWords = 64;
constexpr int kSamplesPerPhoto = 200;

std::string FeaturesKey(const CalibOptions& options, const CapturedPhoto& photo) {
  return HashParts(std::array<std::string, 4>{kFeaturesVersion, photo.hash,
                                              std::to_string(options.max_image_px),
                                              std::to_string(options.max_features)});
}

// SIFT keeps about 20 float images of the doubled size while it works.
int ThreadsWithinMemory(const CalibOptions& options,
                        const std::vector<const CapturedPhoto*>& photos,
                        const StageContext& context) {
  double largest = 1;
  for (const CapturedPhoto* photo : photos) {
    const ImageSize size = ScaledSize({photo->width_px, photo->height_px}, options.max_image_px);
    largest = std::max(largest, static_cast<double>(size.width_px) * size.height_px);
  }
  const double bytes_each = largest * 4 * 4 * 20;
  const double fitting = 0.8 * static_cast<double>(context.memory_limit_bytes) / bytes_each;
  return std::clamp(static_cast<int>(fitting), 1, context.threads);
}

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

std::vector<std::pair<int, int>> ChoosePairs(const CalibOptions& options,
                                             const std::vector<const CapturedPhoto*>& photos,
                                             const std::vector<Features>& features,
                                             const StageContext& context) {
  const PairOptions pair_options{options.exhaustive_below, options.neighbours};
  std::vector<std::vector<float>> signatures(photos.size());
  if (static_cast<int>(photos.size()) > options.exhaustive_below) {
    std::vector<int16_t> samples;
    for (const Features& f : features) {
      const std::vector<int16_t> rows = UnitDescriptors(f);
      for (int s = 0; s < kSamplesPerPhoto && f.size() > 0; ++s) {
        const size_t row = f.size() * s / kSamplesPerPhoto * kDescriptorSize;
        samples.insert(samples.end(), rows.begin() + row, rows.begin() + row + kDescriptorSize);
      }
    }
    const std::vector<float> words = TrainVocabulary(samples, kVocabularyWords);
    for (size_t i = 0; i < photos.size(); ++i) signatures[i] = Signature(features[i], words);
  }
  const auto likely = SelectPairs(pair_options, RoughPositions(photos), signatures);
  const auto planned = PlannedPairs(context, photos);
  std::vector<std::pair<int, int>> pairs;
  std::set_union(likely.begin(), likely.end(), planned.begin(), planned.end(),
                 std::back_inserter(pairs));
  return pairs;
}

std::vector<Eigen::Vector2d> Pixels(const Features& features) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(features.size());
  for (const Keypoint& k : features.keypoints) pixels.emplace_back(k.x, k.y);
  return pixels;
}

}  // namespace

double DetectionScale(const CalibOptions& options, const CapturedPhoto& photo) {
  const ImageSize scaled = ScaledSize({photo.width_px, photo.height_px}, options.max_image_px);
  return static_cast<double>(photo.width_px) / scaled.width_px;
}

std::vector<Features> DetectAll(const CalibOptions& options,
                                const std::vector<const CapturedPhoto*>& photos,
                                const StageContext& context) {
  cv::setNumThreads(1);  // photos run side by side instead
  std::vector<Features> features(photos.size());
  context.progress->Begin("detecting features", photos.size());
  ParallelFor(photos.size(), ThreadsWithinMemory(options, photos, context), [&](size_t i) {
    context.ThrowIfCancelled();
    const CapturedPhoto& photo = *photos[i];
    features[i] =
        DeserializeFeatures(ComputeUnit(context, "features", FeaturesKey(options, photo), [&] {
          const Image image = ReadJpeg(context.photos / photo.path, 3, options.max_image_px);
          return Serialize(DetectFeatures(image, {photo.width_px, photo.height_px},
                                          {options.max_image_px, options.max_features}));
        }));
    context.progress->Advance();
  });
  return features;
}

std::vector<VerifiedPair> MatchAll(const CalibOptions& options,
                                   const std::vector<const CapturedPhoto*>& photos,
                                   const std::vector<Features>& features,
                                   const StageContext& context) {
  const auto candidates = ChoosePairs(options, photos, features, context);
  std::vector<std::optional<PairGeometry>> geometries(candidates.size());
  context.progress->Begin("matching pairs", candidates.size());
  ParallelFor(candidates.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    const auto [a, b] = candidates[i];
    VerifyOptions verify;
    verify.max_error_px =
        4 * std::max(DetectionScale(options, *photos[a]), DetectionScale(options, *photos[b]));
    const std::string key = HashParts(std::array<std::string, 5>{
        kPairVersion, FeaturesKey(options, *photos[a]), FeaturesKey(options, *photos[b]),
        fmt::format("{}", options.match_ratio), fmt::format("{}", verify.max_error_px)});
    geometries[i] = DeserializePair(ComputeUnit(context, "pairs", key, [&] {
      const auto matches = MatchDescriptors(UnitDescriptors(features[a]),
                                            UnitDescriptors(features[b]), options.match_ratio);
      return Serialize(VerifyPair(Pixels(features[a]), Pixels(features[b]), matches, verify));
    }));
    context.progress->Advance();
  });
  std::vector<VerifiedPair> verified;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (!geometries[i]) continue;
    VerifiedPair pair;
    pair.pair = {candidates[i].first, candidates[i].second, geometries[i]->inliers};
    pair.geometry = std::move(*geometries[i]);
    verified.push_back(std::move(pair));
  }
  return verified;
}

}  // namespace stucco
