// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/match_again.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "calib/descriptors.h"
#include "calib/same_place.h"
#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// How often another bay may be the right one.
constexpr double kWrongBay = 1e-3;
// What relief and the map add to shifts on the wall, metres.
constexpr double kOffWall_m = 0.2;
constexpr size_t kLeastKeypoints = 10;
constexpr size_t kLeastMatches = 8;
constexpr double kSameShift_m = 0.5;

// What a photo shows of one wall.
struct Shown {
  WallKeypoints on_wall;
  std::vector<int32_t> of_photo;  // their numbers among all of the photo's keypoints
  double distance_m = 0;          // of the middle one
};

using ShownWalls = std::map<int, Shown>;

struct AgainInput {
  const CalibOptions& options;
  const PhotoSet& set;
  const DetectedFeatures& features;
  const OnRepeatingWalls& repeating;
  const std::vector<std::optional<KnownPose>>& poses;
};

void Append(const std::vector<int16_t>& descriptors, size_t row, const OnWall& place,
            int32_t of_photo, Shown& shown) {
  const auto begin = descriptors.begin() + static_cast<std::ptrdiff_t>(row) * kDescriptorSize;
  shown.on_wall.descriptors.insert(shown.on_wall.descriptors.end(), begin, begin + kDescriptorSize);
  shown.on_wall.places.push_back(place);
  shown.of_photo.push_back(of_photo);
}

WallView ViewOf(const AgainInput& input, int photo, int wall) {
  return {input.set.guidance.facades[wall], {}, {}, input.poses[photo]->cam_from_plan};
}

// Of the walls that repeat themselves, by the photo's pose.
ShownWalls ShownBy(const AgainInput& input, int photo) {
  ShownWalls walls;
  const std::vector<int>& wall_of = input.repeating.wall_of[photo];
  if (!input.poses[photo] || wall_of.empty()) return walls;
  const Camera& camera = input.set.captures.cameras[input.set.photos[photo]->camera].intrinsics;
  const Features& plain = input.features.plain[photo];
  const std::vector<int16_t> descriptors = UnitDescriptors(plain);
  for (size_t k = 0; k < wall_of.size(); ++k) {
    if (wall_of[k] < 0) continue;
    const auto place = PlaceOnWall(plain.keypoints[k], camera, ViewOf(input, photo, wall_of[k]));
    if (place) Append(descriptors, k, *place, static_cast<int32_t>(k), walls[wall_of[k]]);
  }
  for (auto run = input.features.walls.lower_bound({photo, 0});
       run != input.features.walls.end() && run->first.first == photo; ++run) {
    const int wall = run->first.second;
    if (!input.repeating.period_m.contains(wall)) continue;
    const Features& features = run->second.features;
    const std::vector<int16_t> rows = UnitDescriptors(features);
    for (size_t k = 0; k < features.size(); ++k) {
      const auto place = PlaceOnWall(features.keypoints[k], camera, ViewOf(input, photo, wall));
      if (place) {
        Append(rows, k, *place, static_cast<int32_t>(run->second.begin + k), walls[wall]);
      }
    }
  }
  std::erase_if(walls,
                [](const auto& each) { return each.second.of_photo.size() < kLeastKeypoints; });
  for (auto& [wall, shown] : walls) {
    const PlannedFacade& facade = input.set.guidance.facades[wall];
    const Eigen::Vector2d middle = (facade.a_m + facade.b_m) / 2;
    shown.distance_m = (input.poses[photo]->cam_from_plan.Center().head<2>() - middle).norm();
  }
  return walls;
}

// Standard deviation of where the poses put a match of theirs on the wall, along it or up.
double ShiftSigma(const AgainInput& input, int first, int second, double distance_m) {
  const KnownPose& a = *input.poses[first];
  const KnownPose& b = *input.poses[second];
  const double places = std::hypot(a.sigma_m, b.sigma_m, kOffWall_m);
  return std::hypot(places, distance_m * a.sigma_rad, distance_m * b.sigma_rad);
}

// Takes off what does not share the shift of most, and all where the poses do not tell which bay
// is the right one: shifts that differ by a period have the odds of their squares under the
// poses' standard deviation.
void KeepSure(const Shown& first, const Shown& second, double period_m, double sigma_m,
              std::vector<Match>& matches) {
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
    return (shift_of(match) - middle).norm() > kSameShift_m;
  });
  const double log_odds =
      period_m * (period_m - 2 * middle.lpNorm<Eigen::Infinity>()) / (2 * sigma_m * sigma_m);
  if (matches.size() < kLeastMatches || log_odds < -std::log(kWrongBay)) matches.clear();
}

// In the numbers of the photos' keypoints.
std::vector<Match> MatchShown(const AgainInput& input, int first, int second,
                              const std::vector<ShownWalls>& shown) {
  std::vector<Match> matches;
  for (const auto& [wall, of_first] : shown[first]) {
    const auto of_second = shown[second].find(wall);
    if (of_second == shown[second].end()) continue;
    const double period_m = input.repeating.period_m.at(wall);
    // No more than one of the bays lies within half a period.
    std::vector<Match> on_wall = MatchWithin(of_first.on_wall, of_second->second.on_wall,
                                             period_m / 2, input.options.match_ratio);
    const double distance_m = std::max(of_first.distance_m, of_second->second.distance_m);
    KeepSure(of_first, of_second->second, period_m, ShiftSigma(input, first, second, distance_m),
             on_wall);
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

}  // namespace

int MatchAgain(const CalibOptions& options, const PhotoSet& set, const DetectedFeatures& features,
               const OnRepeatingWalls& repeating,
               const std::vector<std::optional<KnownPose>>& poses, const StageContext& context,
               MatchedPairs& matched) {
  const AgainInput input{options, set, features, repeating, poses};
  const size_t count = set.photos.size();
  std::vector<ShownWalls> shown(count);
  std::vector<std::vector<Eigen::Vector2d>> pixels(count);
  ParallelFor(count, context.threads, [&](size_t i) {
    shown[i] = ShownBy(input, static_cast<int>(i));
    if (!shown[i].empty()) pixels[i] = PixelsOf(features, static_cast<int>(i));
  });
  const std::vector<std::vector<int32_t>> places = PlacesOfAll(options, set, features);
  std::map<std::pair<int, int>, size_t> verified_of;
  for (size_t i = 0; i < matched.verified.size(); ++i) {
    verified_of[{matched.verified[i].pair.first, matched.verified[i].pair.second}] = i;
  }
  std::vector<std::optional<VerifiedPair>> found(matched.tried.size());
  std::vector<int> num_added(matched.tried.size(), 0);
  context.progress->Begin("matching what repeats", matched.tried.size());
  ParallelFor(matched.tried.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    const auto& [first, second, num_matches, num_verified] = matched.tried[i];
    const std::vector<Match> added = MatchShown(input, first, second, shown);
    if (!added.empty()) {
      std::vector<Match> matches;
      const auto before = verified_of.find({first, second});
      if (before != verified_of.end()) matches = matched.verified[before->second].pair.matches;
      num_added[i] = static_cast<int>(added.size());
      matches.insert(matches.end(), added.begin(), added.end());
      const PlacesOfPair of_pair{places[first], places[second]};
      DropRepeated(of_pair, matches);
      if (auto geometry = VerifyPair(pixels[first], pixels[second], matches,
                                     VerifyOptionsOf(options, set, first, second))) {
        JoinPlaces(of_pair, geometry->inliers);
        found[i].emplace();
        found[i]->pair = {first, second, geometry->inliers};
        found[i]->geometry = std::move(*geometry);
      }
    }
    context.progress->Advance();
  });
  std::vector<VerifiedPair> all;
  int num_pairs = 0;
  for (size_t i = 0; i < matched.tried.size(); ++i) {
    TriedPair& tried = matched.tried[i];
    tried.num_matches += num_added[i];
    const auto before = verified_of.find({tried.first, tried.second});
    if (found[i]) {
      ++num_pairs;
      tried.num_verified = static_cast<int>(found[i]->pair.matches.size());
      all.push_back(std::move(*found[i]));
    } else if (before != verified_of.end()) {
      all.push_back(std::move(matched.verified[before->second]));
    }
  }
  matched.verified = std::move(all);
  return num_pairs;
}

}  // namespace stucco
