// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/georeference.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "survey/attitude.h"
#include "survey/median.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

constexpr int kRounds = 500;
// Heights of some drones are wrong by tens of metres together (datum), which the common origin
// absorbs, but single positions this many standard deviations off are wrong.
constexpr double kOutlierSigmas = 4;
// Positions of one flight differ from each other by at least this share of their stated accuracy.
constexpr double kLeastOfStated = 0.1;
// Largest standard deviations of the frame: relative, and radians about the line of the cameras.
constexpr double kWorstScale = 0.2;
constexpr double kWorstRoll = 0.05;

std::vector<int> PhotosWithBoth(const Scene& scene) {
  std::vector<int> photos;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose && scene.photos[i].prior) photos.push_back(i);
  }
  return photos;
}

Similarity Align(const Scene& scene, const std::vector<int>& photos) {
  Eigen::Matrix3Xd source(3, photos.size());
  Eigen::Matrix3Xd target(3, photos.size());
  for (size_t i = 0; i < photos.size(); ++i) {
    source.col(i) = scene.photos[photos[i]].pose->Center();
    target.col(i) = scene.photos[photos[i]].prior->position;
  }
  return AlignPoints(source, target);
}

// Residual in standard deviations; systematic errors of scale and attitude are allowed half a
// metre.
double Sigmas(const Scene& scene, int photo, const Similarity& enu_from_scene) {
  const PositionPrior& prior = *scene.photos[photo].prior;
  const Eigen::Vector3d error =
      enu_from_scene * scene.photos[photo].pose->Center() - prior.position;
  const double horizontal = error.head<2>().norm() / std::max(0.5, prior.sigma_horizontal_m);
  const double vertical = std::abs(error.z()) / std::max(0.5, prior.sigma_vertical_m);
  return std::max(horizontal, vertical);
}

// Square roots of the two largest variances of camera centres in the scene's frame: along the line
// that fits them best, and across it.
Eigen::Vector2d Spreads(const Scene& scene, const std::vector<int>& photos) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : photos) mean += scene.photos[i].pose->Center() / photos.size();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int i : photos) {
    const Eigen::Vector3d d = scene.photos[i].pose->Center() - mean;
    covariance += d * d.transpose() / photos.size();
  }
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return {std::sqrt(std::max(0.0, values[2])), std::sqrt(std::max(0.0, values[1]))};
}

// Standard deviation per axis of the positions among themselves, as the fit shows it. What was
// stated is often that of the absolute position, which the common shift absorbs; a fit to few
// positions shows too little.
double MeasuredSigma(const Scene& scene, const std::vector<int>& photos, const Similarity& fit) {
  double squares = 0;
  double stated = 0;
  for (const int i : photos) {
    const PositionPrior& prior = *scene.photos[i].prior;
    squares += (fit * scene.photos[i].pose->Center() - prior.position).squaredNorm();
    stated += prior.sigma_horizontal_m / static_cast<double>(photos.size());
  }
  const double freedoms = 3.0 * static_cast<double>(photos.size()) - 7;
  return std::clamp(std::sqrt(squares / freedoms), kLeastOfStated * stated, stated);
}

// Scale, turn about the vertical and shift; `up` is the scene's direction away from the ground.
Similarity AlignUpright(const Scene& scene, const std::vector<int>& photos,
                        const Eigen::Vector3d& up) {
  const Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
  Eigen::Vector3d mean_source = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_target = Eigen::Vector3d::Zero();
  const auto count = static_cast<double>(photos.size());
  for (const int i : photos) {
    mean_source += upright * scene.photos[i].pose->Center() / count;
    mean_target += scene.photos[i].prior->position / count;
  }
  // Horizontally a turn with scale is a complex factor; heights only take part in the scale.
  double dot = 0, cross = 0, vertical = 0, squares = 0;
  for (const int i : photos) {
    const Eigen::Vector3d s = upright * scene.photos[i].pose->Center() - mean_source;
    const Eigen::Vector3d t = scene.photos[i].prior->position - mean_target;
    dot += s.head<2>().dot(t.head<2>());
    cross += s.x() * t.y() - s.y() * t.x();
    vertical += s.z() * t.z();
    squares += s.squaredNorm();
  }
  Similarity result;
  result.scale = (std::hypot(dot, cross) + vertical) / squares;
  result.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(cross, dot), Eigen::Vector3d::UnitZ())) *
      upright;
  result.translation =
      mean_target - result.scale * (result.rotation * (upright.conjugate() * mean_source));
  return result;
}

// The photos whose positions agree on one similarity: RANSAC over triples.
std::vector<int> AgreeingPhotos(const Scene& scene, const std::vector<int>& photos) {
  std::mt19937 random(1);
  std::vector<int> best;
  for (int round = 0; round < kRounds; ++round) {
    std::set<int> sample;
    while (sample.size() < 3) sample.insert(photos[random() % photos.size()]);
    const Similarity candidate = Align(scene, {sample.begin(), sample.end()});
    if (!std::isfinite(candidate.scale) || candidate.scale <= 0) continue;
    std::vector<int> inliers;
    for (const int i : photos) {
      if (Sigmas(scene, i, candidate) < kOutlierSigmas) inliers.push_back(i);
    }
    if (inliers.size() > best.size()) best = std::move(inliers);
  }
  return best;
}

}  // namespace

std::optional<Georef> FrameFromPositions(const std::vector<const CapturedPhoto*>& captures,
                                         Scene& scene) {
  assert(captures.size() == scene.photos.size());
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Eigen::Vector3d::UnitZ();
  int count = 0;
  int fixed = 0;
  for (const CapturedPhoto* capture : captures) {
    if (!capture->position || !capture->position->has_height) continue;
    ++count;
    fixed += capture->position->rtk_fixed;
    georef.origin_latitude_deg += capture->position->latitude_deg;
    georef.origin_longitude_deg += capture->position->longitude_deg;
    georef.origin_height_m += capture->position->height_m;
  }
  if (count < 3) return std::nullopt;
  georef.origin_latitude_deg /= count;
  georef.origin_longitude_deg /= count;
  georef.origin_height_m /= count;
  georef.source = 2 * fixed > count ? "rtk" : "gps";
  for (size_t i = 0; i < captures.size(); ++i) {
    const auto& position = captures[i]->position;
    if (!position || !position->has_height) continue;
    scene.photos[i].prior =
        PositionPrior{EnuFromGeodetic(georef, position->latitude_deg, position->longitude_deg,
                                      position->height_m),
                      position->sigma_horizontal_m, position->sigma_vertical_m};
  }
  return georef;
}

std::optional<Georef> FrameFromPlan(const PlanOrigin& origin,
                                    const std::vector<std::optional<Pose>>& expected,
                                    Scene& scene) {
  assert(expected.size() == scene.photos.size());
  if (std::ranges::count_if(expected, &std::optional<Pose>::has_value) < 3) return std::nullopt;
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = origin.latitude_deg;
  georef.origin_longitude_deg = origin.longitude_deg;
  georef.origin_height_m = origin.height_m;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.metric = true;
  georef.source = "plan";
  for (size_t i = 0; i < expected.size(); ++i) {
    if (!expected[i]) continue;
    const Eigen::Vector3d center = expected[i]->Center();
    const Eigen::Vector2d place = EnuFromPlan(origin, georef, center.head<2>());
    scene.photos[i].prior = PositionPrior{{place.x(), place.y(), center.z()}};
  }
  return georef;
}

std::optional<PriorFit> FitToPriors(const Scene& scene, const std::optional<Eigen::Vector3d>& up) {
  const std::vector<int> photos = PhotosWithBoth(scene);
  if (photos.size() < 3) return std::nullopt;
  const std::vector<int> best = AgreeingPhotos(scene, photos);
  if (best.size() < 3 || 2 * best.size() < photos.size()) return std::nullopt;
  PriorFit fit;
  fit.enu_from_scene = Align(scene, best);
  const double sigma =
      MeasuredSigma(scene, best, fit.enu_from_scene) / std::sqrt(static_cast<double>(best.size()));
  const Eigen::Vector2d spreads = fit.enu_from_scene.scale * Spreads(scene, best);
  if (sigma > kWorstScale * spreads[0]) return std::nullopt;
  fit.spread_m = spreads[1];
  if (sigma > kWorstRoll * spreads[1]) {
    fit.holds = FitHolds::kScale;
    if (up) {
      fit.enu_from_scene = AlignUpright(scene, best, *up);
      fit.holds = FitHolds::kScaleAndHeading;
    }
  }
  for (const int i : photos) {
    if (Sigmas(scene, i, fit.enu_from_scene) >= kOutlierSigmas) fit.outliers.push_back(i);
  }
  return fit;
}

void Transform(const Similarity& new_from_old, Scene& scene) {
  for (ScenePhoto& photo : scene.photos) {
    if (photo.pose) photo.pose = Transformed(*photo.pose, new_from_old);
  }
  for (SceneTrack& track : scene.tracks) {
    if (track.position) track.position = new_from_old * *track.position;
  }
}

std::optional<Eigen::Vector3d> UpFromGimbal(const std::vector<const CapturedPhoto*>& captures,
                                            const Scene& scene) {
  assert(captures.size() == scene.photos.size());
  constexpr double kRadians = std::numbers::pi / 180;
  std::vector<Eigen::Vector3d> ups;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < captures.size(); ++i) {
    const auto& gimbal = captures[i]->gimbal;
    if (!gimbal || !scene.photos[i].pose) continue;
    // The yaw does not matter for it.
    const Eigen::Vector3d up_in_cam = CamFromEnu(*gimbal) * Eigen::Vector3d::UnitZ();
    ups.push_back(scene.photos[i].pose->rotation.conjugate() * up_in_cam);
    sum += ups.back();
  }
  if (ups.size() < 2 || sum.norm() < 1e-9) return std::nullopt;
  const Eigen::Vector3d up = sum.normalized();
  std::vector<double> angles;
  angles.reserve(ups.size());
  for (const Eigen::Vector3d& each : ups) {
    angles.push_back(std::atan2(each.cross(up).norm(), each.dot(up)));
  }
  if (*Median(std::move(angles)) > 15 * kRadians) return std::nullopt;
  return up;
}

PriorResiduals MeasurePriors(const Scene& scene, const std::vector<int>& outliers) {
  PriorResiduals residuals;
  residuals.distance_m.assign(scene.photos.size(), -1);
  double horizontal = 0;
  double vertical = 0;
  int count = 0;
  for (const int i : PhotosWithBoth(scene)) {
    const Eigen::Vector3d error = scene.photos[i].pose->Center() - scene.photos[i].prior->position;
    residuals.distance_m[i] = error.norm();
    if (std::find(outliers.begin(), outliers.end(), i) != outliers.end()) continue;
    horizontal += error.head<2>().squaredNorm();
    vertical += error.z() * error.z();
    ++count;
  }
  if (count > 0) {
    residuals.rms_horizontal_m = std::sqrt(horizontal / count);
    residuals.rms_vertical_m = std::sqrt(vertical / count);
  }
  return residuals;
}

}  // namespace stucco
