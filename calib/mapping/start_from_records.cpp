// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/start_from_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "calib/adjust/adjust.h"
#include "calib/adjust/rotation_averaging.h"
#include "calib/scene/choose_tracks.h"
#include "calib/scene/hidden_points.h"
#include "calib/scene/points.h"
#include "calib/two_view/pair_rays.h"
#include "survey/attitude.h"
#include "survey/degree.h"
#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// Of the photos; the others are attached to these afterwards.
constexpr double kLeastRecorded = 0.5;
constexpr int kLeastRecordedPhotos = 6;
constexpr size_t kRotationPartners = 6;  // pairs of a photo whose relative rotation is estimated
constexpr size_t kMatchesOfPair = 300;
constexpr int kLeastRelative = 25;  // matches that a relative pose must explain
// Relative rotations of gimbals farther from those of the matches are not those of the same pair.
constexpr double kSameRotation = 12 * kDegree;
// Of the pairs; where fewer agree, the records contradict the photos.
constexpr double kLeastAgreeingShare = 0.3;
constexpr double kRelativeSigma = 0.5 * kDegree;  // with lenses that are not calibrated yet
constexpr double kLeastGimbalSigma = 0.2 * kDegree;
constexpr double kMostGimbalSigma = 5 * kDegree;
// A compass is corrected when the vote is this many of its standard deviations off.
constexpr double kSureYaw = 4;
constexpr int kEnoughVotes = 10;
// The tolerance of the first points, in medians of the epipolar errors; and its limits.
constexpr double kStartMedians = 5;
constexpr double kMostStart_sigmas = 120;
constexpr double kNarrowerTolerance = 3;  // by which the tolerance falls from round to round
constexpr int kObservations = 150;        // of a photo, while the tolerance is wide
constexpr double kLeastPlaced = 0.3;      // of the recorded photos

struct PairMotion {
  const VerifiedPair* pair = nullptr;
  RelativePose relative;
};

bool HasRecord(const PoseRecord& record) {
  return record.position && record.gimbal;
}

// Of each recorded photo the pairs with most matches, each once, in their order.
std::vector<const VerifiedPair*> StrongestPairs(const std::vector<VerifiedPair>& pairs,
                                                const std::vector<PoseRecord>& records) {
  std::vector<std::vector<std::pair<size_t, size_t>>> of_photo(records.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    const PhotoPair& pair = pairs[i].pair;
    if (pairs[i].rotation_only || pair.matches.size() < kLeastRelative) continue;
    if (!HasRecord(records[pair.first]) || !HasRecord(records[pair.second])) continue;
    for (const int photo : {pair.first, pair.second}) {
      of_photo[photo].emplace_back(pair.matches.size(), i);
    }
  }
  std::set<size_t> chosen;
  for (auto& candidates : of_photo) {
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    for (size_t i = 0; i < std::min(kRotationPartners, candidates.size()); ++i) {
      chosen.insert(candidates[i].second);
    }
  }
  std::vector<const VerifiedPair*> strongest;
  strongest.reserve(chosen.size());
  for (const size_t i : chosen) strongest.push_back(&pairs[i]);
  return strongest;
}

std::optional<RelativePose> MotionOf(const Scene& scene, double max_error_sigmas,
                                     const PhotoPair& pair) {
  const PairRays rays = RaysOf(scene, pair, max_error_sigmas, kMatchesOfPair);
  auto motion = EstimateRelativePose(rays.first, rays.second, rays.max_error);
  const double share =
      static_cast<double>(rays.first.size()) / static_cast<double>(pair.matches.size());
  if (motion && motion->num_inliers < share * kLeastRelative) motion.reset();
  return motion;
}

std::vector<PairMotion> MotionsOf(const MapperOptions& options,
                                  const std::vector<const VerifiedPair*>& pairs,
                                  const Scene& scene) {
  std::vector<std::optional<RelativePose>> found(pairs.size());
  ParallelFor(pairs.size(), options.threads, [&](size_t i) {
    found[i] = MotionOf(scene, options.max_error_sigmas, pairs[i]->pair);
  });
  std::vector<PairMotion> motions;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (found[i]) motions.push_back({pairs[i], *found[i]});
  }
  return motions;
}

// Angle between the relative rotations of the gimbals and of the matches.
double Disagreement(const PairMotion& motion, const std::vector<PoseRecord>& records) {
  const PhotoPair& pair = motion.pair->pair;
  const Eigen::Quaterniond by_gimbal =
      *records[pair.second].gimbal * records[pair.first].gimbal->conjugate();
  return by_gimbal.angularDistance(motion.relative.second_from_first.rotation);
}

// Of all angles the one about which most votes lie: the middle of the votes about the fullest of
// overlapping bins.
struct Vote {
  double angle_rad = 0;
  double weight = 0;
};

struct Winner {
  double angle_rad = 0;
  double sigma_rad = std::numbers::pi;
  int num_votes = 0;
};

Winner Count(const std::vector<Vote>& votes) {
  constexpr int kBins = 72;
  constexpr double kHalf = 20 * kDegree;
  const auto offset = [](double angle, double middle) {
    return std::remainder(angle - middle, 2 * std::numbers::pi);
  };
  double best = -1;
  double middle = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double angle = 2 * std::numbers::pi * bin / kBins;
    double weight = 0;
    for (const Vote& vote : votes) {
      if (std::abs(offset(vote.angle_rad, angle)) < kHalf) weight += vote.weight;
    }
    if (weight <= best) continue;
    best = weight;
    middle = angle;
  }
  Winner winner;
  std::vector<double> near;
  for (const Vote& vote : votes) {
    const double d = offset(vote.angle_rad, middle);
    if (std::abs(d) < kHalf) near.push_back(d);
  }
  winner.num_votes = static_cast<int>(near.size());
  if (near.empty()) return winner;
  const double median = *Median(near);
  for (double& d : near) d = std::abs(d - median);
  winner.angle_rad = std::remainder(middle + median, 2 * std::numbers::pi);
  winner.sigma_rad =
      1.25 * *Median(near) / kMedianOfNormal / std::sqrt(static_cast<double>(near.size()));
  return winner;
}

// The compass's error of each flight: the angle from the recorded direction of baselines to the one
// that the gimbal's attitude gives the matches', turned about up. Votes weigh by the length of the
// baseline, as noise of positions turns short ones more.
std::map<int, double> YawOfFlights(const std::vector<PairMotion>& motions,
                                   const std::vector<PoseRecord>& records) {
  std::map<int, std::vector<Vote>> votes;
  for (const PairMotion& motion : motions) {
    const PhotoPair& pair = motion.pair->pair;
    if (records[pair.first].flight != records[pair.second].flight) continue;
    const Eigen::Vector3d recorded =
        records[pair.second].position->position - records[pair.first].position->position;
    const Eigen::Vector3d by_gimbal =
        records[pair.first].gimbal->conjugate() * motion.relative.second_from_first.Center();
    const double level = recorded.head<2>().norm();
    const double weight = level * by_gimbal.head<2>().norm();
    if (level < recorded.norm() / 2 || by_gimbal.head<2>().norm() < 0.5) continue;
    const double angle =
        std::atan2(by_gimbal.y(), by_gimbal.x()) - std::atan2(recorded.y(), recorded.x());
    votes[records[pair.first].flight].push_back({angle, weight});
  }
  std::map<int, double> yaws;
  for (const auto& [flight, of_flight] : votes) {
    const Winner winner = Count(of_flight);
    if (winner.num_votes < kEnoughVotes) continue;
    if (std::abs(winner.angle_rad) > kSureYaw * winner.sigma_rad) yaws[flight] = winner.angle_rad;
  }
  return yaws;
}

std::vector<std::optional<Eigen::Quaterniond>> Rotations(const std::vector<PairMotion>& motions,
                                                         const std::vector<PoseRecord>& records) {
  const std::map<int, double> yaws = YawOfFlights(motions, records);
  std::vector<std::optional<Eigen::Quaterniond>> rotations(records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    if (!HasRecord(records[i])) continue;
    const auto yaw = yaws.find(records[i].flight);
    const double angle = yaw == yaws.end() ? 0 : yaw->second;
    rotations[i] = *records[i].gimbal * AboutUp(angle);
  }
  std::vector<RelativeRotation> relative;
  std::vector<double> off;
  for (const PairMotion& motion : motions) {
    relative.push_back({motion.pair->pair.first, motion.pair->pair.second,
                        motion.relative.second_from_first.rotation});
    off.push_back(Disagreement(motion, records));
  }
  const double sigma = Median(std::move(off)).value_or(0) / 1.5 / std::sqrt(2.0);
  AverageRotations(relative,
                   {kRelativeSigma, std::clamp(sigma, kLeastGimbalSigma, kMostGimbalSigma)},
                   rotations);
  return rotations;
}

// Median distance of matches from the epipolar lines of the poses, in standard deviations of the
// keypoints.
double EpipolarError(const std::vector<const VerifiedPair*>& pairs, const Scene& scene) {
  std::vector<double> errors;
  for (const VerifiedPair* each : pairs) {
    const PhotoPair& pair = each->pair;
    const ScenePhoto& first = scene.photos[pair.first];
    const ScenePhoto& second = scene.photos[pair.second];
    const Pose second_from_first = *second.pose * first.pose->Inverse();
    const Eigen::Vector3d t = second_from_first.translation;
    const size_t step = pair.matches.size() / 20 + 1;
    for (size_t i = 0; i < pair.matches.size(); i += step) {
      const auto a = scene.CameraOf(pair.first).Unproject(first.keypoints[pair.matches[i].first]);
      const auto b =
          scene.CameraOf(pair.second).Unproject(second.keypoints[pair.matches[i].second]);
      if (!a || !b) continue;
      const Eigen::Vector3d normal = t.cross(second_from_first.rotation * a->homogeneous());
      const double level = normal.head<2>().norm();
      if (level < 1e-12) continue;
      errors.push_back(std::abs(normal.dot(b->homogeneous())) / level *
                       scene.CameraOf(pair.second).FocalX() / second.keypoint_sigma_px);
    }
  }
  return Median(std::move(errors)).value_or(0);
}

// Falling to that of the keypoints, standard deviations of these.
std::vector<double> Tolerances(double start, double end) {
  std::vector<double> tolerances;
  for (double tolerance = start; tolerance > end; tolerance /= kNarrowerTolerance) {
    tolerances.push_back(tolerance);
  }
  tolerances.push_back(end);
  return tolerances;
}

// Points and poses by turns, with falling tolerances and with records as good as they turn out to
// be.
void Anneal(const MapperOptions& options, const std::vector<double>& tolerances,
            const std::vector<PoseRecord>& records, const StageContext& context, Scene& scene) {
  for (const double tolerance : tolerances) {
    context.ThrowIfCancelled();
    MapperOptions wide = options;
    wide.max_error_sigmas = tolerance;
    TriangulateAll({tolerance, options.min_angle_rad}, options.threads, scene);
    DropHiddenPoints(options.threads, scene);
    AdjustOptions adjust;
    adjust.use_priors = true;
    adjust.threads = options.adjust_threads;
    adjust.refine = options.refine_principal_point ? RefineIntrinsics::kPrincipalPoint
                                                   : RefineIntrinsics::kDistortion;
    WeighByTolerance(tolerance, adjust);
    adjust.max_iterations = 20;
    adjust.tolerance = 1e-3;
    adjust.tracks = ChooseTracks(scene, kObservations);
    Adjust(adjust, scene);
    TriangulateAll({tolerance, options.min_angle_rad}, options.threads, scene);
    DropHiddenPoints(options.threads, scene);
    FilterScene(wide, scene);
    ApplyRecords(records, MeasureRecordErrors(records, scene), scene);
    context.progress->Advance();
  }
}

RecordsStart NotUsable(std::string why) {
  return {false, std::move(why), 0};
}

// Nothing of it is placed, and its priors are the records as they are.
void TakeBack(const std::vector<PoseRecord>& records, const std::vector<SceneCamera>& cameras,
              Scene& scene) {
  for (size_t i = 0; i < records.size(); ++i) {
    scene.photos[i].pose.reset();
    scene.photos[i].attitude.reset();
    scene.photos[i].prior = records[i].position;
  }
  for (SceneTrack& track : scene.tracks) ClearPoint(track);
  scene.cameras = cameras;
}

}  // namespace

RecordsStart StartFromRecords(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                              const std::vector<PoseRecord>& records, const StageContext& context,
                              Scene& scene) {
  assert(records.size() == scene.photos.size());
  const auto recorded = std::count_if(records.begin(), records.end(), HasRecord);
  if (recorded < kLeastRecordedPhotos ||
      recorded < kLeastRecorded * static_cast<double>(records.size())) {
    return NotUsable("too few photos have a position and gimbal angles");
  }
  const std::vector<const VerifiedPair*> strongest = StrongestPairs(pairs, records);
  std::vector<PairMotion> motions = MotionsOf(options, strongest, scene);
  const size_t all = motions.size();
  std::erase_if(motions, [&](const PairMotion& motion) {
    return Disagreement(motion, records) > kSameRotation;
  });
  if (motions.empty() || motions.size() < kLeastAgreeingShare * static_cast<double>(all)) {
    return NotUsable(
        fmt::format("the gimbal's angles contradict the photos: only {} of {} pairs "
                    "turn as they say",
                    motions.size(), all));
  }
  const auto rotations = Rotations(motions, records);
  const std::vector<SceneCamera> cameras = scene.cameras;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!rotations[i]) continue;
    scene.photos[i].attitude = AttitudePrior{*rotations[i], kRelativeSigma};
    scene.photos[i].pose = Pose{*rotations[i], -(*rotations[i] * records[i].position->position)};
  }
  const double error = EpipolarError(strongest, scene);
  const std::vector<double> tolerances =
      Tolerances(std::min(kMostStart_sigmas, kStartMedians * error), options.max_error_sigmas);
  context.progress->Begin("correcting records", tolerances.size());
  Anneal(options, tolerances, records, context, scene);
  RecordsStart start{true, "", NumRegistered(scene)};
  context.progress->Note(
      fmt::format("{} of {} photos placed by their records ({} pairs turn as the gimbals say, "
                  "matches lay {:.1f} standard deviations of a keypoint off before, in the middle)",
                  start.num_registered, recorded, motions.size(), error));
  if (start.num_registered >= kLeastPlaced * static_cast<double>(recorded)) return start;
  TakeBack(records, cameras, scene);
  return NotUsable(fmt::format("only {} of {} photos stand where their records say",
                               start.num_registered, recorded));
}

}  // namespace stucco
