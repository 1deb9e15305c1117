// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/match_again.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "calib/features/descriptors.h"
#include "calib/features/same_place.h"
#include "calib/matching/which_bay.h"
#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// How often another bay may be the right one.
constexpr double kWrongBay = 1e-3;
constexpr size_t kLeastMatches = 8;
constexpr double kAgreeingShift_m = 0.5;
// Matches are looked for so near to where it was told that they are.
constexpr double kTold_m = 0.4;

// Standard deviation of where the poses put a match of theirs on the wall, along it or up.
Eigen::Vector2d ShiftSigma(const AgainInput& input, int first, int second, double distance_m) {
  const Eigen::Vector2d variances = PlaceVariances(*input.poses[first], distance_m) +
                                    PlaceVariances(*input.poses[second], distance_m);
  return (variances.array() + kOffWall_m * kOffWall_m).sqrt();
}

// Takes off what does not share the shift of most, and all where the poses rule this shift out, as
// smaller things than bays repeat themselves too, or do not tell which bay is the right one: shifts
// that differ by a period have the odds of their squares under the poses' standard deviations.
void KeepSure(const Shown& first, const Shown& second, double period_m,
              const Eigen::Vector2d& sigma_m, std::vector<Match>& matches) {
  std::vector<double> along;
  std::vector<double> up;
  const auto shift_of = [&](const Match& match) {
    const OnWall& from = first.on_wall.places[match.first];
    const OnWall& to = second.on_wall.places[match.second];
    return Eigen::Vector2d(to.along_m - from.along_m, to.z_m - from.z_m);
  };
  for (const Match& match : matches) {
    const Eigen::Vector2d shift = shift_of(match);
    along.push_back(shift.x());
    up.push_back(shift.y());
  }
  const Eigen::Vector2d middle(Median(std::move(along)).value_or(0),
                               Median(std::move(up)).value_or(0));
  std::erase_if(matches, [&](const Match& match) {
    return (shift_of(match) - middle).norm() > kAgreeingShift_m;
  });
  const double log_odds = period_m * (period_m - 2 * middle.lpNorm<Eigen::Infinity>()) /
                          (2 * std::pow(sigma_m.maxCoeff(), 2));
  const bool is_sure =
      middle.cwiseQuotient(sigma_m).norm() < kReachSigmas && log_odds > -std::log(kWrongBay);
  if (matches.size() < kLeastMatches || !is_sure) matches.clear();
}

// A wall that both photos show.
struct SharedWall {
  int wall = 0;
  const Shown& first;
  const Shown& second;
  Eigen::Vector2d sigma_m = Eigen::Vector2d::Zero();  // of the shift between the two, along and up
};

// Where what differs between bays tells which of them is which.
std::vector<Match> MatchTold(const AgainInput& input, int second, const SharedWall& shared) {
  const auto second_shows = [&](const Eigen::Vector2d& place) {
    return ShowsPlace(input, second, shared.wall, place);
  };
  const auto told =
      TellBay({shared.first.on_wall, {&shared.second.on_wall}, shared.sigma_m, second_shows});
  if (!told) return {};
  WallKeypoints moved = shared.first.on_wall;
  for (OnWall& at : moved.places) {
    const Eigen::Vector2d place = told->from * Eigen::Vector3d(at.along_m, at.z_m, 1);
    at.along_m = static_cast<float>(place.x());
    at.z_m = static_cast<float>(place.y());
  }
  return MatchWithin(moved, shared.second.on_wall, kTold_m, input.options.match_ratio);
}

// Where the poses tell which bay is which.
std::vector<Match> MatchPosed(const AgainInput& input, const SharedWall& shared) {
  const double period_m = input.repeating.period_m.at(shared.wall);
  // No more than one of the bays lies within half a period.
  std::vector<Match> matches = MatchWithin(shared.first.on_wall, shared.second.on_wall,
                                           period_m / 2, input.options.match_ratio);
  KeepSure(shared.first, shared.second, period_m, shared.sigma_m, matches);
  return matches;
}

// In the numbers of the photos' keypoints.
std::vector<Match> MatchShown(const AgainInput& input, int first, int second,
                              const std::vector<ShownWalls>& shown) {
  std::vector<Match> matches;
  for (const auto& [wall, of_first] : shown[first]) {
    const auto of_second = shown[second].find(wall);
    if (of_second == shown[second].end()) continue;
    const double distance_m = std::max(of_first.distance_m, of_second->second.distance_m);
    const SharedWall shared{wall, of_first, of_second->second,
                            ShiftSigma(input, first, second, distance_m)};
    std::vector<Match> on_wall = MatchTold(input, second, shared);
    if (on_wall.empty()) on_wall = MatchPosed(input, shared);
    for (const Match& match : on_wall) {
      matches.push_back({of_first.of_photo[match.first], of_second->second.of_photo[match.second]});
    }
  }
  return matches;
}

std::vector<Eigen::Vector2d> PixelsOf(const DetectedFeatures& features, int photo) {
  std::vector<Eigen::Vector2d> pixels;
  for (const Keypoint& k : features.AllOf(photo).keypoints) pixels.emplace_back(k.x, k.y);
  return pixels;
}

// What the photos show, ready to be matched.
struct ReadyPhotos {
  std::vector<ShownWalls> walls;
  std::vector<std::vector<Eigen::Vector2d>> pixels;  // of photos that show such walls
  std::vector<std::vector<int32_t>> places;          // as PlacesOfAll gives them
};

ReadyPhotos ReadyAll(const AgainInput& input) {
  const size_t count = input.set.photos.size();
  ReadyPhotos ready{std::vector<ShownWalls>(count),
                    std::vector<std::vector<Eigen::Vector2d>>(count),
                    PlacesOfAll(input.options, input.set, input.features)};
  ParallelFor(count, input.context.threads, [&](size_t i) {
    ready.walls[i] = ShowWalls(input, static_cast<int>(i));
    if (!ready.walls[i].empty()) ready.pixels[i] = PixelsOf(input.features, static_cast<int>(i));
  });
  return ready;
}

// `matches` are those of the pair so far.
std::optional<VerifiedPair> VerifyAgain(const AgainInput& input, const ReadyPhotos& ready,
                                        std::vector<Match> matches, TriedPair& tried) {
  const auto& [first, second, num_matches, num_verified] = tried;
  const std::vector<Match> added = MatchShown(input, first, second, ready.walls);
  if (added.empty()) return std::nullopt;
  matches.insert(matches.end(), added.begin(), added.end());
  tried.num_matches += static_cast<int>(added.size());
  const PlacesOfPair places{ready.places[first], ready.places[second]};
  DropRepeated(places, matches);
  auto geometry = VerifyPair(ready.pixels[first], ready.pixels[second], matches,
                             VerifyOptionsOf(input.options, input.set, first, second));
  if (!geometry) return std::nullopt;
  JoinPlaces(places, geometry->inliers);
  tried.num_verified = static_cast<int>(geometry->inliers.size());
  VerifiedPair pair;
  pair.pair = {first, second, geometry->inliers};
  pair.geometry = std::move(*geometry);
  return pair;
}

}  // namespace

void DropOnRepeatingWalls(const OnRepeatingWalls& repeating, size_t least_matches,
                          std::vector<VerifiedPair>& pairs) {
  for (VerifiedPair& each : pairs) {
    PhotoPair& pair = each.pair;
    std::erase_if(pair.matches, [&](const Match& match) {
      return repeating.Shows(pair.first, match.first) || repeating.Shows(pair.second, match.second);
    });
  }
  std::erase_if(pairs,
                [&](const VerifiedPair& each) { return each.pair.matches.size() < least_matches; });
}

int MatchAgain(const AgainInput& input, MatchedPairs& matched) {
  const StageContext& context = input.context;
  const ReadyPhotos ready = ReadyAll(input);
  std::map<std::pair<int, int>, VerifiedPair*> verified;
  for (VerifiedPair& each : matched.verified) {
    verified[{each.pair.first, each.pair.second}] = &each;
  }
  const auto so_far = [&](const TriedPair& tried) {
    const auto found = verified.find({tried.first, tried.second});
    return found == verified.end() ? nullptr : found->second;
  };
  std::vector<std::optional<VerifiedPair>> again(matched.tried.size());
  context.progress->Begin("matching what repeats", matched.tried.size());
  ParallelFor(matched.tried.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    TriedPair& tried = matched.tried[i];
    const VerifiedPair* before = so_far(tried);
    again[i] = VerifyAgain(input, ready,
                           before != nullptr ? before->pair.matches : std::vector<Match>(), tried);
    context.progress->Advance();
  });
  std::vector<VerifiedPair> all;
  int num_pairs = 0;
  for (size_t i = 0; i < again.size(); ++i) {
    VerifiedPair* before = so_far(matched.tried[i]);
    num_pairs += again[i].has_value();
    if (again[i]) {
      all.push_back(std::move(*again[i]));
    } else if (before != nullptr) {
      all.push_back(std::move(*before));
    }
  }
  matched.verified = std::move(all);
  return num_pairs;
}

}  // namespace stucco
