// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/correspond.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <opencv2/core/utility.hpp>
#include <set>

#include "calib/descriptors.h"
#include "calib/pairs.h"
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
constexpr char kWallVersion[] = "wall-1";
// Up to this many photos every pair is matched even when a plan says which overlap.
constexpr int kExhaustiveWithPlan = 20;
constexpr int kAlikeWithPlan = 5;
// A rectified wall gets at most this part of the features of a photo.
constexpr int kWallShare = 4;
// Recorded positions of one flight, gimbal angles and the map are this good together.
constexpr double kReachOnWall_m = 4;

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
  for (const Features& f : features) signatures.push_back(Signature(f, words));
  return signatures;
}

std::vector<std::pair<int, int>> ChoosePairs(const CalibOptions& options, const PhotoSet& set,
                                             const std::vector<Features>& features) {
  const int count = static_cast<int>(set.photos.size());
  const bool guided = !set.guidance.pairs.empty() && count > kExhaustiveWithPlan;
  std::vector<std::vector<float>> signatures(count);
  if (guided || count > options.exhaustive_below) signatures = Signatures(features);
  auto likely = SelectPairs({options.exhaustive_below, options.neighbours},
                            RoughPositions(set.photos), signatures);
  if (!guided) return likely;
  // The plan knows better than nearness what overlaps; looks are there for where it is wrong.
  std::erase_if(likely, [&](const auto& pair) {
    return set.guidance.Expects(pair.first) && set.guidance.Expects(pair.second);
  });
  const auto alike = MostAlike(signatures, std::min(options.neighbours, kAlikeWithPlan));
  std::set<std::pair<int, int>> pairs(likely.begin(), likely.end());
  pairs.insert(alike.begin(), alike.end());
  pairs.insert(set.guidance.pairs.begin(), set.guidance.pairs.end());
  return {pairs.begin(), pairs.end()};
}

// A pair of photos to match, and the walls to match it on.
struct Candidate {
  int first = 0;
  int second = 0;
  bool plain = false;  // match what was found in the photos themselves
  std::vector<int> walls;
};

std::vector<Candidate> Candidates(const std::vector<std::pair<int, int>>& pairs,
                                  const std::vector<WallPair>& wall_pairs) {
  std::map<std::pair<int, int>, Candidate> by_pair;
  for (const auto& [a, b] : pairs) by_pair[{a, b}].plain = true;
  for (const WallPair& pair : wall_pairs) {
    by_pair[{pair.first, pair.second}].walls.push_back(pair.wall);
  }
  std::vector<Candidate> candidates;
  for (auto& [photos, candidate] : by_pair) {
    std::tie(candidate.first, candidate.second) = photos;
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

std::vector<Eigen::Vector2d> Pixels(const Features& features) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(features.size());
  for (const Keypoint& k : features.keypoints) pixels.emplace_back(k.x, k.y);
  return pixels;
}

// A photo that is decoded when something is to be found in it.
class LazyPhoto {
 public:
  LazyPhoto(const CalibOptions& options, const CapturedPhoto& photo, const StageContext& context)
      : options_(options), photo_(photo), context_(context) {}

  const Image& Pixels() {
    if (!image_) image_ = ReadJpeg(context_.photos / photo_.path, 3, options_.max_image_px);
    return *image_;
  }
  Features Detect() {
    return DetectFeatures(Pixels(), {photo_.width_px, photo_.height_px},
                          {options_.max_image_px, options_.max_features});
  }

 private:
  const CalibOptions& options_;
  const CapturedPhoto& photo_;
  const StageContext& context_;
  std::optional<Image> image_;
};

struct WallInput {
  const CalibOptions& options;
  const PhotoSet& set;
  const StageContext& context;
};

std::string WallKey(const CalibOptions& options, const PhotoSet& set, int photo, int wall) {
  return HashParts(std::array<std::string, 3>{kWallVersion,
                                              FeaturesKey(options, *set.photos[photo]),
                                              set.guidance.walls.at({photo, wall}).key});
}

// Fills the photo's runs in `detected`, which must be there already.
void DetectOnWalls(const WallInput& input, int photo, LazyPhoto& pixels,
                   DetectedFeatures& detected) {
  const Camera& camera = input.set.captures.cameras[input.set.photos[photo]->camera].intrinsics;
  size_t begin = detected.plain[photo].size();
  for (auto run = detected.walls.lower_bound({photo, 0});
       run != detected.walls.end() && run->first.first == photo; ++run) {
    const WallView& view = input.set.guidance.walls.at(run->first).view;
    const std::string key = WallKey(input.options, input.set, photo, run->first.second);
    Features features = DeserializeFeatures(ComputeUnit(input.context, "features", key, [&] {
      return Serialize(
          DetectOnWall(pixels.Pixels(), camera, view, input.options.max_features / kWallShare));
    }));
    std::vector<OnWall> places = PlacesOnWall(features, camera, view);
    run->second = {begin, std::move(features), std::move(places)};
    begin += run->second.places.size();
  }
}

std::string PairKey(const CalibOptions& options, const PhotoSet& set, const Candidate& pair,
                    const VerifyOptions& verify) {
  std::vector<std::string> parts = {kPairVersion, FeaturesKey(options, *set.photos[pair.first]),
                                    FeaturesKey(options, *set.photos[pair.second]),
                                    fmt::format("{}", options.match_ratio),
                                    fmt::format("{}", verify.max_error_px)};
  if (!pair.walls.empty()) parts.push_back(pair.plain ? "and walls" : "walls");
  for (const int wall : pair.walls) {
    parts.push_back(WallKey(options, set, pair.first, wall));
    parts.push_back(WallKey(options, set, pair.second, wall));
  }
  return HashParts(parts);
}

std::vector<Match> MatchCandidate(const CalibOptions& options, const DetectedFeatures& features,
                                  const Candidate& pair) {
  std::vector<Match> matches;
  if (pair.plain) {
    matches = MatchDescriptors(UnitDescriptors(features.plain[pair.first]),
                               UnitDescriptors(features.plain[pair.second]), options.match_ratio);
  }
  for (const int wall : pair.walls) {
    const WallRun& first = features.walls.at({pair.first, wall});
    const WallRun& second = features.walls.at({pair.second, wall});
    const auto on_wall = MatchOnWall({UnitDescriptors(first.features), first.places},
                                     {UnitDescriptors(second.features), second.places},
                                     kReachOnWall_m, options.match_ratio);
    for (const Match& match : on_wall) {
      matches.push_back({static_cast<int32_t>(first.begin) + match.first,
                         static_cast<int32_t>(second.begin) + match.second});
    }
  }
  return matches;
}

}  // namespace

double DetectionScale(const CalibOptions& options, const CapturedPhoto& photo) {
  const ImageSize scaled = ScaledSize({photo.width_px, photo.height_px}, options.max_image_px);
  return static_cast<double>(photo.width_px) / scaled.width_px;
}

Features DetectedFeatures::AllOf(int photo) const {
  Features all{plain[photo].keypoints, plain[photo].colors, {}};
  for (auto run = walls.lower_bound({photo, 0}); run != walls.end() && run->first.first == photo;
       ++run) {
    const Features& more = run->second.features;
    all.keypoints.insert(all.keypoints.end(), more.keypoints.begin(), more.keypoints.end());
    all.colors.insert(all.colors.end(), more.colors.begin(), more.colors.end());
  }
  return all;
}

DetectedFeatures DetectAll(const CalibOptions& options, const PhotoSet& set,
                           const StageContext& context) {
  cv::setNumThreads(1);  // photos run side by side instead
  const size_t count = set.photos.size();
  DetectedFeatures detected;
  detected.plain.resize(count);
  for (const auto& [photo_and_wall, expected] : set.guidance.walls) detected.walls[photo_and_wall];
  context.progress->Begin("detecting features", count);
  ParallelFor(count, ThreadsWithinMemory(options, set.photos, context), [&](size_t i) {
    context.ThrowIfCancelled();
    LazyPhoto photo(options, *set.photos[i], context);
    detected.plain[i] =
        DeserializeFeatures(ComputeUnit(context, "features", FeaturesKey(options, *set.photos[i]),
                                        [&] { return Serialize(photo.Detect()); }));
    DetectOnWalls({options, set, context}, static_cast<int>(i), photo, detected);
    context.progress->Advance();
  });
  return detected;
}

std::vector<VerifiedPair> MatchAll(const CalibOptions& options, const PhotoSet& set,
                                   const DetectedFeatures& features, const StageContext& context) {
  const std::vector<Candidate> candidates =
      Candidates(ChoosePairs(options, set, features.plain), set.guidance.wall_pairs);
  std::vector<std::vector<Eigen::Vector2d>> pixels;
  for (size_t i = 0; i < set.photos.size(); ++i) {
    pixels.push_back(Pixels(features.AllOf(static_cast<int>(i))));
  }
  std::vector<std::optional<PairGeometry>> geometries(candidates.size());
  context.progress->Begin("matching pairs", candidates.size());
  ParallelFor(candidates.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    const Candidate& pair = candidates[i];
    VerifyOptions verify;
    verify.max_error_px = 4 * std::max(DetectionScale(options, *set.photos[pair.first]),
                                       DetectionScale(options, *set.photos[pair.second]));
    const std::string key = PairKey(options, set, pair, verify);
    geometries[i] = DeserializePair(ComputeUnit(context, "pairs", key, [&] {
      return Serialize(VerifyPair(pixels[pair.first], pixels[pair.second],
                                  MatchCandidate(options, features, pair), verify));
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
