// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/wrong_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

#include "calib/adjust/adjust.h"
#include "calib/mapping/contradicting_groups.h"
#include "calib/scene/points.h"
#include "calib/scene/triangulate.h"

namespace stucco {
namespace {

// What single records may be off by that are usually better, and the adjustment itself.
constexpr double kPoseSigma_m = 0.1;
constexpr double kPoseSigma_rad = 0.3 * std::numbers::pi / 180;
constexpr int kPlaneRounds = 100;
constexpr double kOnPlane = 0.02;        // of the distance
constexpr double kLeastOffPlane = 0.15;  // of the points
constexpr int kLeastPoints = 30;
constexpr int kEnoughPartners = 4;
constexpr double kMostBaysOff_m = 15;
// Matches are taken out that are this many deviations of the record from where it puts their
// points.
constexpr double kGateSigmas = 3.5;
constexpr double kNarrower = 3;
constexpr int kMostRounds = 8;
// When more of the poses contradict their records, it is the records that are wrong.
constexpr double kMostWrong = 0.5;

double AttitudeSquare(const ScenePhoto& photo) {
  if (!photo.attitude) return 0;
  const double angle = photo.pose->rotation.angularDistance(photo.attitude->cam_from_world);
  const double variance = std::pow(photo.attitude->sigma_rad, 2) + std::pow(kPoseSigma_rad, 2);
  return angle * angle / variance;
}

// How far a place is from where a photo was recorded.
double PlaceSquare(const Eigen::Vector3d& place, const PositionPrior& prior) {
  const Eigen::Vector3d error = place - prior.position;
  const double own = std::pow(kPoseSigma_m, 2);
  return error.head<2>().squaredNorm() / (std::pow(prior.sigma_horizontal_m, 2) + own) +
         error.z() * error.z() / (std::pow(prior.sigma_vertical_m, 2) + own);
}

double PositionSquare(const ScenePhoto& photo) {
  return photo.prior ? PlaceSquare(photo.pose->Center(), *photo.prior) : 0;
}

bool AgreesWithItsRecord(const ScenePhoto& photo) {
  return AttitudeSquare(photo) <= kUnlikelySquare && PositionSquare(photo) <= kUnlikelySquare;
}

// Whether photos of the same hover say that a photo's record is right and its pose wrong: one that
// agrees with its own record stands where this photo was recorded, and none stands beside its pose.
bool HoverIsElsewhere(const Scene& scene, const ScenePhoto& photo) {
  if (photo.hover < 0 || scene.hover_sigma_m <= 0) return false;
  const double variance =
      2 * (std::pow(scene.hover_sigma_m, 2) + std::pow(kPoseSigma_m, 2));  // of a difference
  bool elsewhere = false;
  for (const ScenePhoto& mate : scene.photos) {
    if (&mate == &photo || mate.hover != photo.hover || !mate.pose) continue;
    if (!mate.prior || !AgreesWithItsRecord(mate)) continue;
    const Eigen::Vector3d place = mate.pose->Center();
    if ((place - photo.pose->Center()).squaredNorm() <= kUnlikelySquare * variance) return false;
    elsewhere |= PlaceSquare(place, *photo.prior) <= kUnlikelySquare;
  }
  return elsewhere;
}

// Not what lies much farther off: that is a wild position, which matches may contradict.
bool MayBeBaysOff(const ScenePhoto& photo) {
  return photo.may_be_bays_off &&
         (photo.pose->Center() - photo.prior->position).head<2>().norm() < kMostBaysOff_m;
}

std::vector<Eigen::Vector3d> PointsOf(const Scene& scene, int photo) {
  std::vector<Eigen::Vector3d> points;
  for (const int track : TracksSeenBy(scene, photo)) {
    points.push_back(*scene.tracks[track].position);
  }
  return points;
}

// Photos that agree with their own records and share points with this one.
int NumTrustedPartners(const Scene& scene, int photo) {
  const std::vector<int> shared = PointsShared(scene, photo);
  int count = 0;
  for (size_t i = 0; i < shared.size(); ++i) {
    if (shared[i] < kLeastPoints) continue;
    count += AgreesWithItsRecord(scene.photos[i]);
  }
  return count;
}

// Standard deviation of where the record puts a point in the picture, pixels.
double PredictedSigma(const Scene& scene, int photo, const Eigen::Vector3d& point) {
  const ScenePhoto& p = scene.photos[photo];
  const double distance = (point - p.pose->Center()).norm();
  const double place = std::max(p.prior->sigma_horizontal_m, p.prior->sigma_vertical_m) / distance;
  return scene.CameraOf(photo).FocalX() * std::hypot(place, p.attitude->sigma_rad) +
         p.keypoint_sigma_px;
}

class Mending {
 public:
  Mending(const MapperOptions& options, const std::vector<int>& photos, Scene& scene)
      : options_(options), photos_(photos), scene_(scene), tracks_(TracksOf(scene, photos)) {}

  void Run(const StageContext& context) {
    for (const int photo : photos_) scene_.photos[photo].pose.reset();
    Triangulate(options_.max_error_sigmas);
    for (const int photo : photos_) scene_.photos[photo].pose = RecordedPose(scene_.photos[photo]);
    double tolerance = TakeImpossible();
    for (int round = 0; round < kMostRounds; ++round) {
      context.ThrowIfCancelled();
      tolerance = std::max(tolerance, options_.max_error_sigmas);
      Triangulate(tolerance);
      Adjust(tolerance);
      if (tolerance <= options_.max_error_sigmas) break;
      tolerance /= kNarrower;
    }
    Triangulate(options_.max_error_sigmas);
  }

 private:
  void Triangulate(double tolerance) {
    for (const int track : tracks_) {
      TriangulateTrack(scene_, {tolerance, options_.min_angle_rad}, scene_.tracks[track]);
    }
  }

  // Takes matches out whose points are not where the records say. Returns the tolerance that the
  // others ask for.
  double TakeImpossible() {
    double widest = 0;
    for (const int photo : photos_) {
      if (!scene_.photos[photo].pose) continue;
      std::vector<int>& tracks = scene_.tracks_of_photo[photo];
      for (int& index : tracks) {
        if (index < 0 || !scene_.tracks[index].position) continue;
        SceneTrack& track = scene_.tracks[index];
        const auto mine = std::find_if(track.elements.begin(), track.elements.end(),
                                       [&](const SceneElement& e) { return e.photo == photo; });
        const double gate = kGateSigmas * PredictedSigma(scene_, photo, *track.position);
        if (ReprojectionError(scene_, *mine, *track.position) < gate) {
          widest = std::max(widest, gate / scene_.photos[photo].keypoint_sigma_px);
          continue;
        }
        track.elements.erase(mine);
        index = -1;
      }
    }
    return widest;
  }

  void Adjust(double tolerance) {
    AdjustOptions adjust;
    adjust.variable_photos = photos_;
    std::erase_if(adjust.variable_photos, [&](int photo) { return !scene_.photos[photo].pose; });
    if (adjust.variable_photos.empty()) return;
    adjust.refine = RefineIntrinsics::kNone;
    adjust.use_priors = true;
    adjust.threads = options_.adjust_threads;
    WeighByTolerance(tolerance, adjust);
    adjust.max_iterations = 20;
    stucco::Adjust(adjust, scene_);
  }

  const MapperOptions& options_;
  const std::vector<int>& photos_;
  Scene& scene_;
  std::vector<int> tracks_;
};

}  // namespace

bool SeesSeveralPlanes(const Scene& scene, int photo) {
  const std::vector<Eigen::Vector3d> points = PointsOf(scene, photo);
  const int count = static_cast<int>(points.size());
  if (count < kLeastPoints) return false;
  const Eigen::Vector3d center = scene.photos[photo].pose->Center();
  std::mt19937 random(photo);
  int most = 0;
  for (int round = 0; round < kPlaneRounds; ++round) {
    const Eigen::Vector3d& a = points[random() % count];
    const Eigen::Vector3d& b = points[random() % count];
    const Eigen::Vector3d& c = points[random() % count];
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    if (normal.squaredNorm() < 0.5) continue;  // on one line: no plane
    most = std::max(most, static_cast<int>(std::ranges::count_if(points, [&](const auto& p) {
                      return std::abs(normal.dot(p - a)) < kOnPlane * (p - center).norm();
                    })));
  }
  return count - most >= kLeastOffPlane * count;
}

RecordVerdict JudgePose(const Scene& scene, int photo) {
  assert(scene.photos[photo].pose);
  const double attitude = AttitudeSquare(scene.photos[photo]);
  const double position = PositionSquare(scene.photos[photo]);
  if (attitude > kUnlikelySquare) return RecordVerdict::kContradicts;
  if (position <= kUnlikelySquare) {
    return attitude + position > kUnlikelySixSquare ? RecordVerdict::kContradicts
                                                    : RecordVerdict::kAgrees;
  }
  if (MayBeBaysOff(scene.photos[photo]) || HoverIsElsewhere(scene, scene.photos[photo])) {
    return RecordVerdict::kContradicts;
  }
  const bool holds =
      NumTrustedPartners(scene, photo) >= kEnoughPartners || SeesSeveralPlanes(scene, photo);
  return holds && attitude <= kDoubtfulSquare ? RecordVerdict::kPositionOff
                                              : RecordVerdict::kContradicts;
}

std::vector<int> ContradictingPoses(const Scene& scene) {
  std::vector<int> photos;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose && JudgePose(scene, i) == RecordVerdict::kContradicts) {
      photos.push_back(i);
    }
  }
  if (static_cast<double>(photos.size()) > kMostWrong * NumRegistered(scene)) photos.clear();
  return photos;
}

std::vector<int> OffTogether(const Scene& scene) {
  std::vector<bool> agrees(scene.photos.size());
  for (int i = 0; i < static_cast<int>(agrees.size()); ++i) {
    agrees[i] = scene.photos[i].pose && JudgePose(scene, i) == RecordVerdict::kAgrees;
  }
  return ContradictingGroups(scene, agrees);
}

WrongPoses MendWrongPoses(const MapperOptions& options, const StageContext& context, Scene& scene) {
  std::vector<int> wrong = ContradictingPoses(scene);
  const size_t single = wrong.size();
  std::ranges::copy(OffTogether(scene), std::back_inserter(wrong));
  std::inplace_merge(wrong.begin(), wrong.begin() + static_cast<std::ptrdiff_t>(single),
                     wrong.end());
  WrongPoses result;
  if (wrong.empty()) return result;
  Mending(options, wrong, scene).Run(context);
  FilterScene(options, scene);
  for (const int photo : wrong) {
    std::optional<Pose>& pose = scene.photos[photo].pose;
    if (pose && JudgePose(scene, photo) != RecordVerdict::kContradicts) {
      result.corrected.push_back(photo);
    } else {
      pose.reset();
      result.taken.push_back(photo);
    }
  }
  FilterPoints({options.max_error_sigmas, options.min_angle_rad}, options.threads, scene);
  return result;
}

}  // namespace stucco
