// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/contradictions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace stucco {
namespace {

constexpr size_t kSampled = 200;  // matches of a pair
constexpr int kLeastTold = 8;     // matches that the plan says something of
// Gimbal angles and positions of one flight, and the map, are at least this good.
constexpr double kAngle = 5 * M_PI / 180;
constexpr double kPosition_m = 3;
// What the plan does not know (trees, cars, eaves) stands in front of what it knows: a match is
// looked for at these shares of the distance too.
constexpr std::array kDepths = {0.6, 0.7, 0.8, 0.9, 1.0, 1.1};
constexpr size_t kSureMatches = 30;  // of a pair that fits, to believe a photo's record

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::optional<Eigen::Vector3d> RayInPlan(const Scene& scene, int photo, int keypoint,
                                         const Pose& pose) {
  const auto ray = scene.CameraOf(photo).Unproject(scene.photos[photo].keypoints[keypoint]);
  if (!ray) return std::nullopt;
  return pose.rotation.conjugate() * ray->homogeneous().normalized();
}

enum class Verdict { kFits, kContradicts, kUnknown };

Verdict JudgeMatch(const ExpectedViews& views, const Scene& scene, const PhotoPair& pair,
                   const Match& match) {
  const Pose& first = *views.poses[pair.first];
  const Pose& second = *views.poses[pair.second];
  const auto a = RayInPlan(scene, pair.first, match.first, first);
  const auto b = RayInPlan(scene, pair.second, match.second, second);
  const auto distance = a ? views.site.FirstHit(first.Center(), *a) : std::nullopt;
  if (!distance || !b) return Verdict::kUnknown;
  for (const double depth : kDepths) {
    const Eigen::Vector3d way = first.Center() + depth * *distance * *a - second.Center();
    if (Angle(way, *b) < kAngle + std::atan(kPosition_m / way.norm())) return Verdict::kFits;
  }
  return Verdict::kContradicts;
}

Verdict JudgePair(const ExpectedViews& views, const Scene& scene, const PhotoPair& pair) {
  if (!views.poses[pair.first] || !views.poses[pair.second]) return Verdict::kUnknown;
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

}  // namespace

int DropContradictions(const ExpectedViews& views, const Scene& scene,
                       std::vector<VerifiedPair>& pairs) {
  std::vector<Verdict> verdicts;
  std::vector<bool> believed(scene.photos.size(), false);
  for (const VerifiedPair& pair : pairs) {
    verdicts.push_back(JudgePair(views, scene, pair.pair));
    if (verdicts.back() != Verdict::kFits || pair.pair.matches.size() < kSureMatches) continue;
    believed[pair.pair.first] = true;
    believed[pair.pair.second] = true;
  }
  const size_t before = pairs.size();
  size_t kept = 0;
  for (size_t i = 0; i < before; ++i) {
    const PhotoPair& pair = pairs[i].pair;
    if (verdicts[i] == Verdict::kContradicts && believed[pair.first] && believed[pair.second]) {
      continue;
    }
    if (kept != i) pairs[kept] = std::move(pairs[i]);
    ++kept;
  }
  pairs.resize(kept);
  return static_cast<int>(before - kept);
}

}  // namespace stucco
