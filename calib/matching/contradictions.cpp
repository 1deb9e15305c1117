// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/contradictions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "calib/matching/corrections.h"
#include "survey/attitude.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

constexpr size_t kSampled = 200;  // matches of a pair
constexpr int kLeastTold = 8;     // matches that the plan says something of
// Gimbal angles and positions of one flight, and the map, are at least this good.
constexpr double kAngle = 5 * std::numbers::pi / 180;
constexpr double kPosition_m = 3;
// What the plan does not know (trees, cars, eaves) stands in front of what it knows, and its
// heights are bounds: a match is looked for at these shares of the distance too.
constexpr std::array kDepths = {0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 1.0, 1.15, 1.3, 1.5};
// A photo that stands in or at something, as far as the plan knows.
constexpr double kTooNear_m = 2;
// A focal length of which no more is known gives no directions.
constexpr double kUnknownFocal = 0.3;  // standard deviation, share
constexpr size_t kTyingMatches = 30;   // of a pair that ties two photos together
// Pairs that must say the same of a record before it is corrected: what repeats itself is matched
// now with one place, now with another.
constexpr int kLeastAgreeingPairs = 3;

struct Ray {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // frame of the plan
  Eigen::Vector3d way = Eigen::Vector3d::UnitX();  // unit
};

// Where the photos are as far as is known, and what they were seen to match.
struct Records {
  const Occluders& site;
  const Scene& scene;
  std::vector<std::optional<Pose>> poses;  // cam_from_plan; corrected in the course
};

std::optional<Ray> RayInPlan(const Records& records, int photo, int keypoint) {
  const Scene& scene = records.scene;
  const auto ray = scene.CameraOf(photo).Unproject(scene.photos[photo].keypoints[keypoint]);
  if (!ray) return std::nullopt;
  const Pose& pose = *records.poses[photo];
  return Ray{pose.Center(), pose.rotation.conjugate() * ray->homogeneous().normalized()};
}

enum class Verdict { kFits, kContradicts, kUnknown };

// Looks for what the first ray shows along the second.
Verdict LookUp(const Occluders& site, const Ray& first, const Ray& second) {
  const auto distance = site.FirstHit(first.from, first.way);
  if (!distance || *distance < kTooNear_m) return Verdict::kUnknown;
  for (const double depth : kDepths) {
    const Eigen::Vector3d way = first.from + depth * *distance * first.way - second.from;
    if (AngleBetween(way, second.way) < kAngle + std::atan(kPosition_m / way.norm())) {
      return Verdict::kFits;
    }
  }
  return Verdict::kContradicts;
}

// A match contradicts the plan only from both sides.
Verdict JudgeMatch(const Records& records, const PhotoPair& pair, const Match& match) {
  const auto a = RayInPlan(records, pair.first, match.first);
  const auto b = RayInPlan(records, pair.second, match.second);
  if (!a || !b) return Verdict::kUnknown;
  const Verdict forth = LookUp(records.site, *a, *b);
  if (forth == Verdict::kFits) return forth;
  const Verdict back = LookUp(records.site, *b, *a);
  return forth == Verdict::kUnknown || back == Verdict::kFits ? back : forth;
}

Verdict JudgePair(const Records& records, const PhotoPair& pair) {
  for (const int photo : {pair.first, pair.second}) {
    if (!records.poses[photo]) return Verdict::kUnknown;
    const int camera = records.scene.photos[photo].camera;
    if (records.scene.cameras[camera].focal_sigma_ratio > kUnknownFocal) return Verdict::kUnknown;
  }
  int fit = 0;
  int told = 0;
  const size_t step = pair.matches.size() / kSampled + 1;
  for (size_t i = 0; i < pair.matches.size(); i += step) {
    const Verdict verdict = JudgeMatch(records, pair, pair.matches[i]);
    told += verdict != Verdict::kUnknown;
    fit += verdict == Verdict::kFits;
  }
  if (told < kLeastTold) return Verdict::kUnknown;
  return 2 * fit >= told ? Verdict::kFits : Verdict::kContradicts;
}

// What the pairs say of the photos.
struct Opinion {
  std::vector<Verdict> verdicts;  // by pair
  std::vector<int> fits;          // by photo: pairs
  std::vector<int> against;

  // A record fits at least as many pairs of its photo as it contradicts.
  bool Believes(int photo) const { return fits[photo] >= std::max(1, against[photo]); }
};

Opinion Judge(const Records& records, const std::vector<VerifiedPair>& pairs) {
  const size_t num_photos = records.scene.photos.size();
  Opinion opinion{{}, std::vector<int>(num_photos, 0), std::vector<int>(num_photos, 0)};
  for (const VerifiedPair& each : pairs) {
    const Verdict verdict = JudgePair(records, each.pair);
    opinion.verdicts.push_back(verdict);
    for (const int photo : {each.pair.first, each.pair.second}) {
      opinion.fits[photo] += verdict == Verdict::kFits;
      opinion.against[photo] += verdict == Verdict::kContradicts;
    }
  }
  return opinion;
}

// Photos whose records are right or wrong together: those believed that sure pairs tie together.
// Any other is alone.
DisjointSets Parts(const std::vector<VerifiedPair>& pairs, const Opinion& opinion) {
  DisjointSets parts(opinion.fits.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    const PhotoPair& pair = pairs[i].pair;
    if (opinion.verdicts[i] == Verdict::kContradicts || pair.matches.size() < kTyingMatches)
      continue;
    if (!opinion.Believes(pair.first) || !opinion.Believes(pair.second)) continue;
    parts.Join(pair.first, pair.second);
  }
  return parts;
}

// What `photo` shows, if the pair is right and the record of its other photo too.
std::vector<RecordSighting> SightingsOf(const Records& records, const PhotoPair& pair, int photo) {
  std::vector<RecordSighting> sightings;
  const size_t step = pair.matches.size() / kSampled + 1;
  for (size_t i = 0; i < pair.matches.size(); i += step) {
    const Match& match = pair.matches[i];
    const bool is_first = pair.first == photo;
    const auto ray = RayInPlan(records, is_first ? pair.second : pair.first,
                               is_first ? match.second : match.first);
    if (!ray) continue;
    const auto distance = records.site.FirstHit(ray->from, ray->way);
    if (!distance || *distance < kTooNear_m) continue;
    sightings.push_back({is_first ? match.first : match.second, ray->from + *distance * ray->way});
  }
  return sightings;
}

// A part whose record is to be looked into, and the pairs that tie it to another.
struct Tied {
  int to = 0;
  int part = 0;
  std::vector<size_t> pairs;
};

// Parts that only contradicting pairs tie to a larger one whose record is believed; those to the
// largest first.
std::vector<Tied> FindTied(const std::vector<VerifiedPair>& pairs, const Opinion& opinion) {
  DisjointSets parts = Parts(pairs, opinion);
  std::vector<int> size(opinion.fits.size(), 0);
  for (size_t i = 0; i < size.size(); ++i) ++size[parts.Find(static_cast<int>(i))];
  std::map<std::pair<int, int>, std::vector<size_t>> ties;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (opinion.verdicts[i] != Verdict::kContradicts) continue;
    int large = parts.Find(pairs[i].pair.first);
    int small = parts.Find(pairs[i].pair.second);
    const auto rank = [&](int part) {
      return std::tuple(opinion.Believes(part), size[part], -part);
    };
    if (rank(large) < rank(small)) std::swap(large, small);
    if (large != small && opinion.Believes(large)) ties[{large, small}].push_back(i);
  }
  std::vector<Tied> tied;
  tied.reserve(ties.size());
  for (auto& [ends, of_pairs] : ties)
    tied.push_back({ends.first, ends.second, std::move(of_pairs)});
  std::stable_sort(tied.begin(), tied.end(),
                   [&](const Tied& a, const Tied& b) { return size[a.to] > size[b.to]; });
  return tied;
}

// What most of the pairs say of the record of the part.
std::optional<Pose> AgreedMotion(const std::vector<VerifiedPair>& pairs, const Opinion& opinion,
                                 const Records& records, const Tied& tied,
                                 const std::vector<int>& members) {
  std::vector<Correction> corrections;
  for (const size_t i : tied.pairs) {
    const PhotoPair& pair = pairs[i].pair;
    const bool has_first = std::ranges::binary_search(members, pair.first);
    const int photo = has_first ? pair.first : pair.second;
    if (auto correction = ProposeCorrection(records.scene, photo, *records.poses[photo],
                                            SightingsOf(records, pair, photo))) {
      corrections.push_back(*correction);
    }
  }
  const Agreement agreement = LargestAgreement(corrections);
  // What speaks for the record as it is: the pairs of one photo with others, but not those within a
  // part.
  const int for_record = members.size() == 1 ? opinion.fits[members[0]] : 0;
  const int all = static_cast<int>(tied.pairs.size()) + for_record;
  if (agreement.count < kLeastAgreeingPairs || 2 * agreement.count <= all) return std::nullopt;
  return corrections[agreement.center].moved_from_recorded;
}

// Corrects records by what photos with believed records show, each once. Returns whether any was.
bool CorrectRecords(const std::vector<VerifiedPair>& pairs, const Opinion& opinion,
                    std::vector<bool>& corrected, Records& records) {
  DisjointSets parts = Parts(pairs, opinion);
  std::vector<std::vector<int>> members(corrected.size());
  for (int i = 0; i < static_cast<int>(corrected.size()); ++i) members[parts.Find(i)].push_back(i);
  const std::vector<Tied> all_tied = FindTied(pairs, opinion);
  std::vector<bool> touched(corrected.size(), false);  // parts
  for (const Tied& tied : all_tied) {
    const std::vector<int>& photos = members[tied.part];
    if (touched[tied.part] || touched[tied.to] || corrected[photos[0]]) continue;
    const auto motion = AgreedMotion(pairs, opinion, records, tied, photos);
    if (!motion) continue;
    touched[tied.part] = true;
    for (const int photo : photos) {
      if (records.poses[photo]) records.poses[photo] = *records.poses[photo] * motion->Inverse();
      corrected[photo] = true;
    }
  }
  return std::ranges::count(touched, true) > 0;
}

}  // namespace

int DropContradictions(const ExpectedViews& views, const Scene& scene,
                       std::vector<VerifiedPair>& pairs) {
  assert(views.poses.size() == scene.photos.size());
  Records records{views.site, scene, views.poses};
  Opinion opinion = Judge(records, pairs);
  std::vector<bool> corrected(scene.photos.size(), false);
  while (CorrectRecords(pairs, opinion, corrected, records)) opinion = Judge(records, pairs);
  size_t kept = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const PhotoPair& pair = pairs[i].pair;
    // Where neither record is believed there is nothing to judge a pair by.
    const bool known = opinion.Believes(pair.first) || opinion.Believes(pair.second);
    if (known && opinion.verdicts[i] == Verdict::kContradicts) continue;
    if (kept != i) pairs[kept] = std::move(pairs[i]);
    ++kept;
  }
  const size_t dropped = pairs.size() - kept;
  pairs.resize(kept);
  return static_cast<int>(dropped);
}

}  // namespace stucco
