// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/contradictions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

constexpr size_t kSampled = 200;  // matches of a pair
constexpr int kLeastTold = 8;     // matches that the plan says something of
// Gimbal angles and positions of one flight, and the map, are at least this good.
constexpr double kAngle = 5 * M_PI / 180;
constexpr double kPosition_m = 3;
// What the plan does not know (trees, cars, eaves) stands in front of what it knows, and its
// heights are bounds: a match is looked for at these shares of the distance too.
constexpr std::array kDepths = {0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 1.0, 1.15, 1.3, 1.5};
// A photo that stands in or at something, as far as the plan knows.
constexpr double kTooNear_m = 2;
// A focal length of which no more is known gives no directions.
constexpr double kGuessedFocal = 0.3;  // standard deviation, share
constexpr size_t kSureMatches = 30;    // of a pair that ties two photos together
constexpr int kLeastGroup = 5;         // photos that are believed against their records together

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct Ray {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // frame of the plan
  Eigen::Vector3d way = Eigen::Vector3d::UnitX();  // unit
};

std::optional<Ray> RayInPlan(const ExpectedViews& views, const Scene& scene, int photo,
                             int keypoint) {
  const auto ray = scene.CameraOf(photo).Unproject(scene.photos[photo].keypoints[keypoint]);
  if (!ray) return std::nullopt;
  const Pose& pose = *views.poses[photo];
  return Ray{pose.Center(), pose.rotation.conjugate() * ray->homogeneous().normalized()};
}

enum class Verdict { kFits, kContradicts, kUnknown };

// Looks for what the first ray shows along the second.
Verdict LookUp(const Occluders& site, const Ray& first, const Ray& second) {
  const auto distance = site.FirstHit(first.from, first.way);
  if (!distance || *distance < kTooNear_m) return Verdict::kUnknown;
  for (const double depth : kDepths) {
    const Eigen::Vector3d way = first.from + depth * *distance * first.way - second.from;
    if (Angle(way, second.way) < kAngle + std::atan(kPosition_m / way.norm())) {
      return Verdict::kFits;
    }
  }
  return Verdict::kContradicts;
}

// A match contradicts the plan only from both sides.
Verdict JudgeMatch(const ExpectedViews& views, const Scene& scene, const PhotoPair& pair,
                   const Match& match) {
  const auto a = RayInPlan(views, scene, pair.first, match.first);
  const auto b = RayInPlan(views, scene, pair.second, match.second);
  if (!a || !b) return Verdict::kUnknown;
  const Verdict forth = LookUp(views.site, *a, *b);
  if (forth == Verdict::kFits) return forth;
  const Verdict back = LookUp(views.site, *b, *a);
  return forth == Verdict::kUnknown || back == Verdict::kFits ? back : forth;
}

Verdict JudgePair(const ExpectedViews& views, const Scene& scene, const PhotoPair& pair) {
  for (const int photo : {pair.first, pair.second}) {
    if (!views.poses[photo]) return Verdict::kUnknown;
    const double sigma = scene.cameras[scene.photos[photo].camera].focal_sigma_ratio;
    if (sigma > kGuessedFocal) return Verdict::kUnknown;
  }
  int fit = 0;
  int told = 0;
  const size_t step = pair.matches.size() / kSampled + 1;
  for (size_t i = 0; i < pair.matches.size(); i += step) {
    const Verdict verdict = JudgeMatch(views, scene, pair, pair.matches[i]);
    told += verdict != Verdict::kUnknown;
    fit += verdict == Verdict::kFits;
  }
  if (told < kLeastTold) return Verdict::kUnknown;
  return 2 * fit >= told ? Verdict::kFits : Verdict::kContradicts;
}

// Photos whose records fit at least as many of their pairs as they contradict.
std::vector<bool> Believed(const std::vector<VerifiedPair>& pairs,
                           const std::vector<Verdict>& verdicts, size_t num_photos) {
  std::vector<int> fits(num_photos, 0);
  std::vector<int> against(num_photos, 0);
  for (size_t i = 0; i < pairs.size(); ++i) {
    for (const int photo : {pairs[i].pair.first, pairs[i].pair.second}) {
      fits[photo] += verdicts[i] == Verdict::kFits;
      against[photo] += verdicts[i] == Verdict::kContradicts;
    }
  }
  std::vector<bool> believed(num_photos);
  for (size_t i = 0; i < num_photos; ++i) believed[i] = fits[i] >= std::max(1, against[i]);
  return believed;
}

// Keeps of the pairs to drop those between groups of photos that nothing else ties together: two
// flights whose records do not fit each other are still one survey.
void KeepTies(const std::vector<VerifiedPair>& pairs, size_t num_photos, std::vector<bool>& drop) {
  DisjointSets groups(num_photos);
  std::vector<size_t> dropped;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].pair.matches.size() < kSureMatches) continue;
    if (drop[i]) {
      dropped.push_back(i);
    } else {
      groups.Join(pairs[i].pair.first, pairs[i].pair.second);
    }
  }
  std::vector<int> size(num_photos, 0);
  for (size_t i = 0; i < num_photos; ++i) ++size[groups.Find(static_cast<int>(i))];
  for (const size_t i : dropped) {
    const int a = groups.Find(pairs[i].pair.first);
    const int b = groups.Find(pairs[i].pair.second);
    drop[i] = a == b || std::min(size[a], size[b]) < kLeastGroup;
  }
}

}  // namespace

int DropContradictions(const ExpectedViews& views, const Scene& scene,
                       std::vector<VerifiedPair>& pairs) {
  assert(views.poses.size() == scene.photos.size());
  std::vector<Verdict> verdicts;
  verdicts.reserve(pairs.size());
  for (const VerifiedPair& pair : pairs) verdicts.push_back(JudgePair(views, scene, pair.pair));
  const std::vector<bool> believed = Believed(pairs, verdicts, scene.photos.size());
  std::vector<bool> drop(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    drop[i] = verdicts[i] == Verdict::kContradicts && believed[pairs[i].pair.first] &&
              believed[pairs[i].pair.second];
  }
  KeepTies(pairs, scene.photos.size(), drop);
  size_t kept = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (drop[i]) continue;
    if (kept != i) pairs[kept] = std::move(pairs[i]);
    ++kept;
  }
  const size_t dropped = pairs.size() - kept;
  pairs.resize(kept);
  return static_cast<int>(dropped);
}

}  // namespace stucco
