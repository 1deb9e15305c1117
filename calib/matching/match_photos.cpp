// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/match_photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <tuple>

#include "calib/features/descriptors.h"
#include "calib/features/matches.h"
#include "calib/features/same_place.h"
#include "calib/matching/choose_pairs.h"
#include "calib/scene/camera_key.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// Raise when the code behind a checkpoint changes what it computes.
constexpr char kPairVersion[] = "pair-9";
// Recorded positions of one flight, gimbal angles and the map are this good together.
constexpr double kReachOnWall_m = 4;
// When fewer of the pairs that should overlap do, the photos do not show what the plan says.
constexpr double kLeastRight = 0.3;
// Standard deviation, share: focal lengths better known than this question what F explains.
constexpr double kKnownFocal = 0.3;

// A pair of photos to match, and the walls to match it on.
struct Candidate {
  int first = 0;
  int second = 0;
  bool plain = false;  // match what was found in the photos themselves
  std::vector<int> walls;
};

// Walls that repeat themselves are not matched.
std::vector<Candidate> Candidates(const std::vector<std::pair<int, int>>& pairs,
                                  const std::vector<WallPair>& wall_pairs,
                                  const std::map<int, double>& repeating) {
  std::map<std::pair<int, int>, Candidate> by_pair;
  for (const auto& [a, b] : pairs) by_pair[{a, b}].plain = true;
  for (const WallPair& pair : wall_pairs) {
    if (repeating.contains(pair.wall)) continue;
    by_pair[{pair.first, pair.second}].walls.push_back(pair.wall);
  }
  std::vector<Candidate> candidates;
  for (auto& [photos, candidate] : by_pair) {
    std::tie(candidate.first, candidate.second) = photos;
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

struct MatchInput {
  const CalibOptions& options;
  const PhotoSet& set;
  const DetectedFeatures& features;
  const OnRepeatingWalls& repeating;
  std::vector<std::vector<int32_t>> places;  // by photo and keypoint
  const StageContext& context;
};

// Which of the photo's keypoints are left out.
std::string KeyOfLeftOut(const OnRepeatingWalls& repeating, int photo) {
  const std::vector<int>& walls = repeating.wall_of[photo];
  std::string bits;
  bits.reserve(walls.size());
  for (const int wall : walls) bits.push_back(wall < 0 ? '0' : '1');
  return bits;
}

std::string PairKey(const MatchInput& input, const Candidate& pair, const VerifyOptions& verify) {
  const CalibOptions& options = input.options;
  const PhotoSet& set = input.set;
  std::vector<std::string> parts = {kPairVersion, FeaturesKey(options, *set.photos[pair.first]),
                                    FeaturesKey(options, *set.photos[pair.second]),
                                    fmt::format("{}", options.match_ratio),
                                    fmt::format("{}", verify.max_error_px)};
  if (verify.cameras) {
    parts.push_back(KeyOf(verify.cameras->first) + " " + KeyOf(verify.cameras->second));
    parts.push_back(fmt::format("{}", verify.cameras->focal_sigma_ratio));
  }
  for (const int photo : {pair.first, pair.second}) {
    if (pair.plain && !input.repeating.wall_of[photo].empty()) {
      parts.push_back(KeyOfLeftOut(input.repeating, photo));
    }
  }
  if (!pair.walls.empty()) parts.push_back(pair.plain ? "and walls" : "walls");
  for (const int wall : pair.walls) {
    parts.push_back(WallKey(options, set, pair.first, wall));
    parts.push_back(WallKey(options, set, pair.second, wall));
  }
  return HashParts(parts);
}

// The keypoints that a candidate matches in one of its photos, numbered from 0: what a checkpoint
// stores must not depend on which other walls the photo has.
struct CandidateKeypoints {
  std::vector<Keypoint> keypoints;
  size_t num_plain = 0;
  std::vector<int32_t> of_photo;  // their numbers among all of the photo

  void Add(const Features& features, size_t begin) {
    for (size_t i = 0; i < features.size(); ++i) {
      keypoints.push_back(features.keypoints[i]);
      of_photo.push_back(static_cast<int32_t>(begin + i));
    }
  }
  std::vector<Eigen::Vector2d> Pixels() const {
    std::vector<Eigen::Vector2d> pixels;
    pixels.reserve(keypoints.size());
    for (const Keypoint& k : keypoints) pixels.emplace_back(k.x, k.y);
    return pixels;
  }
};

CandidateKeypoints KeypointsOf(const DetectedFeatures& features, const Candidate& pair, int photo) {
  CandidateKeypoints keypoints;
  if (pair.plain) {
    keypoints.Add(features.plain[photo], 0);
    keypoints.num_plain = keypoints.keypoints.size();
  }
  for (const int wall : pair.walls) {
    const WallRun& run = features.walls.at({photo, wall});
    keypoints.Add(run.features, run.begin);
  }
  return keypoints;
}

// In the candidate's own numbers.
std::vector<Match> MatchCandidate(const MatchInput& input, const Candidate& pair) {
  const DetectInput detect{input.options, input.set, input.context};
  const DetectedFeatures& features = input.features;
  const double ratio = input.options.match_ratio;
  std::vector<Match> matches;
  int32_t begin_first = 0;
  int32_t begin_second = 0;
  if (pair.plain) {
    matches =
        MatchDescriptors(UnitDescriptors(FeaturesOfPhoto(detect, features, pair.first)),
                         UnitDescriptors(FeaturesOfPhoto(detect, features, pair.second)), ratio);
    std::erase_if(matches, [&](const Match& match) {
      return input.repeating.Shows(pair.first, match.first) ||
             input.repeating.Shows(pair.second, match.second);
    });
    begin_first = static_cast<int32_t>(features.plain[pair.first].size());
    begin_second = static_cast<int32_t>(features.plain[pair.second].size());
  }
  for (const int wall : pair.walls) {
    const WallRun& first = features.walls.at({pair.first, wall});
    const WallRun& second = features.walls.at({pair.second, wall});
    const auto on_wall = MatchOnWall(
        {UnitDescriptors(FeaturesOnWall(detect, features, pair.first, wall)), first.places},
        {UnitDescriptors(FeaturesOnWall(detect, features, pair.second, wall)), second.places},
        kReachOnWall_m, ratio);
    for (const Match& match : on_wall) {
      matches.push_back({begin_first + match.first, begin_second + match.second});
    }
    begin_first += static_cast<int32_t>(first.features.size());
    begin_second += static_cast<int32_t>(second.features.size());
  }
  return matches;
}

// What matching a candidate gave, in its own numbers: this is kept.
struct Outcome {
  int32_t num_matches = 0;
  std::optional<PairGeometry> geometry;
};

std::string Serialize(const Outcome& outcome) {
  std::string bytes(sizeof(outcome.num_matches), '\0');
  std::memcpy(bytes.data(), &outcome.num_matches, sizeof(outcome.num_matches));
  return bytes + Serialize(outcome.geometry);
}

Outcome DeserializeOutcome(std::string_view bytes) {
  Outcome outcome;
  if (bytes.size() < sizeof(outcome.num_matches)) {
    throw Error(ErrorKind::kBadInput, "matches: the checkpoint is damaged");
  }
  std::memcpy(&outcome.num_matches, bytes.data(), sizeof(outcome.num_matches));
  bytes.remove_prefix(sizeof(outcome.num_matches));
  outcome.geometry = DeserializePair(bytes);
  return outcome;
}

Outcome MatchAndVerify(const MatchInput& input, const Candidate& pair,
                       const VerifyOptions& verify) {
  const CandidateKeypoints first = KeypointsOf(input.features, pair, pair.first);
  const CandidateKeypoints second = KeypointsOf(input.features, pair, pair.second);
  const auto places_of = [&](const CandidateKeypoints& of, int photo) {
    return FindPlaces(of.keypoints, of.num_plain,
                      SamePlace_px(input.options, *input.set.photos[photo]));
  };
  std::vector<Match> matches = MatchCandidate(input, pair);
  // What is found twice in both photos is one piece of evidence.
  DropRepeated({places_of(first, pair.first), places_of(second, pair.second)}, matches);
  return {static_cast<int32_t>(matches.size()),
          VerifyPair(first.Pixels(), second.Pixels(), matches, verify)};
}

// Nothing where a focal length is a guess.
std::optional<PairCameras> CamerasOf(const PhotoSet& set, int first_photo, int second_photo) {
  const CapturedCamera& first = set.captures.cameras[set.photos[first_photo]->camera];
  const CapturedCamera& second = set.captures.cameras[set.photos[second_photo]->camera];
  const double sigma = std::max(FocalSigmaRatio(first), FocalSigmaRatio(second));
  if (sigma > kKnownFocal) return std::nullopt;
  return PairCameras{first.intrinsics, second.intrinsics, sigma};
}

// In the numbers of the photos' keypoints.
Outcome VerifyCandidate(const MatchInput& input, const Candidate& pair) {
  const VerifyOptions verify = VerifyOptionsOf(input.options, input.set, pair.first, pair.second);
  Outcome outcome =
      DeserializeOutcome(ComputeUnit(input.context, "pairs", PairKey(input, pair, verify), [&] {
        return Serialize(MatchAndVerify(input, pair, verify));
      }));
  if (!outcome.geometry) return outcome;
  const CandidateKeypoints first = KeypointsOf(input.features, pair, pair.first);
  const CandidateKeypoints second = KeypointsOf(input.features, pair, pair.second);
  for (Match& match : outcome.geometry->inliers) {
    match = {first.of_photo.at(match.first), second.of_photo.at(match.second)};
  }
  JoinPlaces({input.places[pair.first], input.places[pair.second]}, outcome.geometry->inliers);
  return outcome;
}

// Those of the candidates whose matches agree on a geometry, in their order.
MatchedPairs Verify(const MatchInput& input, const std::vector<Candidate>& candidates) {
  std::vector<Outcome> outcomes(candidates.size());
  input.context.progress->Begin("matching pairs", candidates.size());
  ParallelFor(candidates.size(), input.context.threads, [&](size_t i) {
    input.context.ThrowIfCancelled();
    outcomes[i] = VerifyCandidate(input, candidates[i]);
    input.context.progress->Advance();
  });
  MatchedPairs matched;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto& [first, second, plain, walls] = candidates[i];
    matched.tried.push_back({first, second, outcomes[i].num_matches, 0});
    if (!outcomes[i].geometry) continue;
    matched.tried.back().num_verified = static_cast<int>(outcomes[i].geometry->inliers.size());
    VerifiedPair pair;
    pair.pair = {first, second, std::move(outcomes[i].geometry->inliers)};
    pair.geometry = std::move(*outcomes[i].geometry);
    matched.verified.push_back(std::move(pair));
  }
  return matched;
}

// How many of the pairs (ascending) are verified ones.
size_t NumVerified(const PhotoPairs& pairs, const std::vector<VerifiedPair>& verified) {
  return std::ranges::count_if(verified, [&](const VerifiedPair& pair) {
    return std::ranges::binary_search(pairs, std::pair(pair.pair.first, pair.pair.second));
  });
}

}  // namespace

VerifyOptions VerifyOptionsOf(const CalibOptions& options, const PhotoSet& set, int first,
                              int second) {
  const double scale = std::max(DetectionScale(options, *set.photos[first]),
                                DetectionScale(options, *set.photos[second]));
  VerifyOptions verify;
  verify.max_error_px = 4 * scale;
  verify.cameras = CamerasOf(set, first, second);
  return verify;
}

MatchedPairs MatchAll(const CalibOptions& options, const PhotoSet& set,
                      const DetectedFeatures& features, const OnRepeatingWalls& repeating,
                      const StageContext& context) {
  const MatchInput input{options, set, features, repeating, PlacesOfAll(options, set, features),
                         context};
  const PairChoice choice = ChoosePairs(
      options, set,
      [&](int photo) {
        return FeaturesOfPhoto({options, set, context}, features, photo);
      },
      context.threads);
  MatchedPairs matched =
      Verify(input, Candidates(choice.pairs, set.guidance.wall_pairs, repeating.period_m));
  if (!choice.by_plan) return matched;
  const size_t expected = set.guidance.pairs.size();
  const size_t found = NumVerified(set.guidance.pairs, matched.verified);
  context.progress->Note(
      fmt::format("{} of {} pairs of photos that should overlap by the plan do", found, expected));
  if (static_cast<double>(found) >= kLeastRight * static_cast<double>(expected)) return matched;
  context.progress->Warn(
      "the photos do not show what the plan says: too few of those that should overlap do; pairs "
      "are chosen by position and appearance too");
  PhotoPairs all;  // those done already come from their checkpoints
  std::ranges::set_union(choice.pairs, choice.otherwise, std::back_inserter(all));
  return Verify(input, Candidates(all, set.guidance.wall_pairs, repeating.period_m));
}

}  // namespace stucco
