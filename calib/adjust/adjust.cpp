// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/adjust.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/product_manifold.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <span>
#include <stdexcept>

#include "calib/adjust/internal/control_costs.h"
#include "calib/adjust/internal/costs.h"
#include "calib/scene/hovers.h"
#include "survey/error.h"
#include "survey/median.h"

namespace stucco {
namespace {

// Weak knowledge about lenses, in standard deviations.
constexpr double kPrincipalPointSigma = 0.02;  // of the longer side
constexpr double kRadialSigma = 0.5;
constexpr double kTangentialSigma = 0.01;
constexpr double kRationalSigma = 0.2;

// Records beyond this many standard deviations lose weight. Not sooner: photos on one line turn
// about it freely but for their records and few ties, of which wrong ones must not outweigh all
// records together.
constexpr double kPriorLossScale = 10;

// Marks beyond this many standard deviations lose weight.
constexpr double kMarkLossScale = 3;

// Positions that can hold what a lens model bends, centimetres.
constexpr double kHoldsBends_m = 0.1;

constexpr double kLeastNoise = 0.05;
// Median of the length of a two-dimensional normal vector with unit variances: sqrt(2 ln 2).
constexpr double kRayleighMedian = 1.17741;

// What so many photos of a camera can tell of it.
RefineIntrinsics LevelFor(int num_photos) {
  if (num_photos < 3) return RefineIntrinsics::kNone;
  if (num_photos < 4) return RefineIntrinsics::kFocal;
  return num_photos < 5 ? RefineIntrinsics::kDistortion : RefineIntrinsics::kPrincipalPoint;
}

// The level from which on a parameter may change. Tangential distortion and the principal point
// look much the same to few photos.
RefineIntrinsics LevelOf(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kFocalLength:
      return RefineIntrinsics::kFocal;
    case ParameterKind::kRadial:
    case ParameterKind::kRational:
      return RefineIntrinsics::kDistortion;
    case ParameterKind::kPrincipalPoint:
    case ParameterKind::kTangential:
      return RefineIntrinsics::kPrincipalPoint;
  }
  throw std::logic_error("unknown kind of parameter");
}

std::vector<int> HeldParameters(CameraModel model, RefineIntrinsics refine) {
  const std::span<const ParameterKind> kinds = ParameterKinds(model);
  std::vector<int> held;
  for (int i = 0; i < static_cast<int>(kinds.size()); ++i) {
    if (refine < LevelOf(kinds[i])) held.push_back(i);
  }
  return held;
}

// A pose as one block of Ceres: few large blocks cost less than many small ones.
struct PoseBlock {
  explicit PoseBlock(const Pose& pose) {
    Rotation() = pose.rotation;
    Translation() = pose.translation;
  }

  Eigen::Map<Eigen::Quaterniond> Rotation() { return Eigen::Map<Eigen::Quaterniond>(values); }
  Eigen::Map<Eigen::Vector3d> Translation() { return Eigen::Map<Eigen::Vector3d>(values + 4); }

  double values[kPoseSize];
};

using PoseManifold =
    ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;
// One coordinate of the translation is held.
using ScaleHoldingManifold =
    ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::SubsetManifold>;

class Adjustment {
 public:
  Adjustment(const AdjustOptions& options, Scene& scene)
      : options_(options),
        scene_(scene),
        variable_(scene.photos.size(), options.variable_photos.empty()),
        problem_(ProblemOptions()) {
    for (const int photo : options.variable_photos) {
      assert(photo >= 0 && static_cast<size_t>(photo) < scene.photos.size());
      variable_[photo] = true;
    }
  }

  AdjustReport Solve() {
    AdjustReport report;
    for (const int track : ConcernedTracks()) AddTrack(scene_.tracks[track], report);
    if (report.num_observations == 0) return report;
    AddControl();
    HoldWhatIsGiven();
    AddPriors();
    ceres::Solver::Summary summary;
    ceres::Solve(SolverOptions(), &problem_, &summary);
    report.usable = summary.IsSolutionUsable();
    const double scale = 2.0 / (2.0 * report.num_observations);
    report.rms_after = std::sqrt(summary.final_cost * scale);
    if (report.usable) WriteBack();
    return report;
  }

 private:
  static ceres::Problem::Options ProblemOptions() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  ceres::Solver::Options SolverOptions() const {
    ceres::Solver::Options options;
    options.max_num_iterations = options_.max_iterations;
    options.num_threads = options_.threads;
    options.function_tolerance = options_.tolerance;
    options.parameter_tolerance = 1e-9;
    options.logging_type = ceres::SILENT;
    const auto photos = std::count_if(poses_.begin(), poses_.end(),
                                      [&](const auto& pose) { return IsVariable(pose.first); });
    options.linear_solver_type = photos <= 60     ? ceres::DENSE_SCHUR
                                 : photos <= 3000 ? ceres::SPARSE_SCHUR
                                                  : ceres::ITERATIVE_SCHUR;
    options.preconditioner_type = ceres::SCHUR_JACOBI;
    return options;
  }

  bool IsVariable(int photo) const { return variable_[photo]; }

  // Tracks that a variable photo may see, in order.
  std::vector<int> ConcernedTracks() const {
    std::vector<int> tracks = options_.tracks;
    if (!tracks.empty()) return tracks;
    if (options_.variable_photos.empty()) {
      tracks.resize(scene_.tracks.size());
      std::iota(tracks.begin(), tracks.end(), 0);
      return tracks;
    }
    return TracksOf(scene_, options_.variable_photos);
  }

  void AddTrack(SceneTrack& track, AdjustReport& report) {
    if (!track.position) return;
    const bool concerned =
        std::any_of(track.elements.begin(), track.elements.end(),
                    [&](const SceneElement& e) { return e.used && IsVariable(e.photo); });
    if (!concerned) return;
    for (const SceneElement& element : track.elements) {
      if (!element.used) continue;
      AddObservation(element, *track.position);
      ++report.num_observations;
    }
  }

  void AddObservation(const SceneElement& element, Eigen::Vector3d& point) {
    const ScenePhoto& photo = scene_.photos[element.photo];
    AddSight({element.photo, photo.keypoints[element.keypoint]},
             photo.KeypointSigma(element.keypoint), loss_, point);
  }

  // A point where a photo shows it.
  void AddSight(const PhotoMark& mark, double sigma, ceres::LossFunction& loss,
                Eigen::Vector3d& point) {
    ScenePhoto& photo = scene_.photos[mark.photo];
    Camera& camera = scene_.cameras[photo.camera].intrinsics;
    const auto [it, is_new] = poses_.try_emplace(mark.photo, *photo.pose);
    double* pose = it->second.values;
    used_cameras_.insert(photo.camera);
    problem_.AddResidualBlock(CreateCost(camera, mark.pixel, sigma), &loss, camera.params.data(),
                              pose, point.data());
    if (options_.hold_points) problem_.SetParameterBlockConstant(point.data());
    if (!is_new) return;
    problem_.SetManifold(pose, &pose_manifold_);
    if (!IsVariable(mark.photo)) {
      problem_.SetParameterBlockConstant(pose);
    }
  }

  void AddControl() {
    if (!options_.use_priors) return;
    for (ControlPoint& point : scene_.control.points) {
      bool is_seen = false;
      for (const PhotoMark& mark : point.marks) {
        if (!scene_.photos[mark.photo].pose) continue;
        AddSight(mark, scene_.control.mark_sigma_px, mark_loss_, point.position);
        is_seen = true;
      }
      if (!is_seen) continue;
      problem_.AddResidualBlock(SurveyedPointCost::Create(point.surveyed, point.sigma_m),
                                &control_loss_, point.position.data(), Shift());
      has_control_ = true;
    }
  }

  double* Shift() { return scene_.control.positions_shift_m.data(); }

  static ceres::CostFunction* CreateCost(const Camera& camera, const Eigen::Vector2d& keypoint,
                                         double sigma) {
    switch (camera.model) {
      case CameraModel::kPinhole:
        return new ReprojectionCost<4>(keypoint, sigma);
      case CameraModel::kOpenCv:
        return new ReprojectionCost<8>(keypoint, sigma);
      case CameraModel::kFullOpenCv:
        return new ReprojectionCost<12>(keypoint, sigma);
      default:
        throw Error(ErrorKind::kStageFailed,
                    fmt::format("bundle adjustment does not work with camera model {}",
                                Name(camera.model)));
    }
  }

  int NumRegisteredOf(int camera) const {
    return static_cast<int>(std::count_if(poses_.begin(), poses_.end(), [&](const auto& pose) {
      return scene_.photos[pose.first].camera == camera;
    }));
  }

  void HoldWhatIsGiven() {
    for (const int index : used_cameras_) {
      SceneCamera& camera = scene_.cameras[index];
      std::vector<double>& params = camera.intrinsics.params;
      const RefineIntrinsics refine =
          options_.hold_points ? options_.refine
                               : std::min(options_.refine, LevelFor(NumRegisteredOf(index)));
      if (camera.focal_sigma_ratio == 0 || refine == RefineIntrinsics::kNone) {
        problem_.SetParameterBlockConstant(params.data());
        continue;
      }
      const std::vector<int> held = HeldParameters(camera.intrinsics.model, refine);
      if (!held.empty()) {
        subsets_.push_back(
            std::make_unique<ceres::SubsetManifold>(static_cast<int>(params.size()), held));
        problem_.SetManifold(params.data(), subsets_.back().get());
      }
      AddIntrinsicsPrior(camera);
    }
  }

  template <int kNumParams>
  void AddIntrinsicsPriorOfSize(SceneCamera& camera) {
    auto* cost = new IntrinsicsPriorCost<kNumParams>;
    for (int i = 0; i < kNumParams; ++i) {
      const double sigma = PriorSigma(camera, i);
      cost->expected[i] = camera.prior.params[i];
      cost->inverse_sigma[i] = sigma > 0 ? 1 / sigma : 0;
    }
    cost->aspect = camera.prior.FocalY() / camera.prior.FocalX();
    cost->inverse_aspect_sigma = 1 / kFocalRatioSigma;
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<IntrinsicsPriorCost<kNumParams>,
                                                              kNumParams + 1, kNumParams>(cost),
                              nullptr, camera.intrinsics.params.data());
  }

  void AddIntrinsicsPrior(SceneCamera& camera) {
    switch (camera.intrinsics.params.size()) {
      case 4:
        return AddIntrinsicsPriorOfSize<4>(camera);
      case 8:
        return AddIntrinsicsPriorOfSize<8>(camera);
      default:
        return AddIntrinsicsPriorOfSize<12>(camera);
    }
  }

  void AddPriors() {
    bool has_priors = false;
    for (auto& [index, pose] : poses_) {
      if (!options_.use_priors || !IsVariable(index)) continue;
      has_priors = AddPosition(scene_.photos[index].prior, pose) || has_priors;
      AddAttitude(scene_.photos[index].attitude, pose);
    }
    if (options_.use_priors) AddHovers();
    if (!has_priors && has_control_) problem_.SetParameterBlockConstant(Shift());
    if (!has_priors && !has_control_) HoldFrame();
  }

  // Photos of one hover stand in one place.
  void AddHovers() {
    for (const SamePlace& pair : SamePlaces(scene_)) {
      if (!IsVariable(pair.first) && !IsVariable(pair.second)) continue;
      const auto first = poses_.find(pair.first);
      const auto second = poses_.find(pair.second);
      if (first != poses_.end() && second != poses_.end()) {
        problem_.AddResidualBlock(SamePlaceCost::Create(pair.sigma_m), &prior_loss_,
                                  first->second.values, second->second.values);
        continue;
      }
      // One that sees none of these points stays where it is.
      const auto& seen = first != poses_.end() ? first : second;
      if (seen == poses_.end() || !IsVariable(seen->first)) continue;
      const int other = seen->first == pair.first ? pair.second : pair.first;
      problem_.AddResidualBlock(PositionCost::Create(scene_.photos[other].pose->Center(),
                                                     Eigen::Vector3d::Constant(pair.sigma_m)),
                                &prior_loss_, seen->second.values);
    }
  }

  bool AddPosition(const std::optional<PositionPrior>& prior, PoseBlock& pose) {
    if (!prior) return false;
    const Eigen::Vector3d sigma(prior->sigma_horizontal_m, prior->sigma_horizontal_m,
                                prior->sigma_vertical_m);
    ceres::LossFunction* loss =
        sigma.maxCoeff() < kHoldsBends_m ? &sure_position_loss_ : &prior_loss_;
    if (has_control_) {
      // Receivers err together by metres; control points say by how much.
      problem_.AddResidualBlock(ShiftedPositionCost::Create(prior->position, sigma), loss,
                                pose.values, Shift());
    } else {
      problem_.AddResidualBlock(PositionCost::Create(prior->position, sigma), loss, pose.values);
    }
    return true;
  }

  void AddAttitude(const std::optional<AttitudePrior>& prior, PoseBlock& pose) {
    if (!prior) return;
    problem_.AddResidualBlock(
        AttitudeCost::Create<kPoseSize>(prior->cam_from_world, prior->sigma_rad), &prior_loss_,
        pose.values);
  }

  // Two photos that do not move hold the frame. Without any, the first one is held; with one, the
  // scale is still free and one coordinate of the photo farthest from it holds that.
  void HoldFrame() {
    if (options_.hold_points) return;
    std::vector<PoseBlock*> fixed;
    for (auto& [index, pose] : poses_) {
      if (!IsVariable(index)) fixed.push_back(&pose);
    }
    if (fixed.size() >= 2) return;
    PoseBlock& first = fixed.empty() ? poses_.begin()->second : *fixed[0];
    problem_.SetParameterBlockConstant(first.values);
    const Eigen::Vector3d origin = -(first.Rotation().conjugate() * first.Translation());
    PoseBlock* farthest = nullptr;
    Eigen::Vector3d baseline = Eigen::Vector3d::Zero();
    for (auto& [index, pose] : poses_) {
      const Eigen::Vector3d to_origin = pose.Rotation() * origin + pose.Translation();
      if (to_origin.norm() <= baseline.norm()) continue;
      farthest = &pose;
      baseline = to_origin;
    }
    if (farthest == nullptr) return;
    int axis = 0;
    baseline.cwiseAbs().maxCoeff(&axis);
    scale_holding_ = std::make_unique<ScaleHoldingManifold>(
        ceres::EigenQuaternionManifold(), ceres::SubsetManifold(3, std::vector<int>{axis}));
    problem_.SetManifold(farthest->values, scale_holding_.get());
  }

  void WriteBack() {
    for (auto& [index, pose] : poses_) {
      if (IsVariable(index)) {
        scene_.photos[index].pose = Pose{pose.Rotation().normalized(), pose.Translation()};
      }
    }
  }

  const AdjustOptions& options_;
  Scene& scene_;
  std::vector<bool> variable_;
  std::map<int, PoseBlock> poses_;
  std::set<int> used_cameras_;
  PoseManifold pose_manifold_;
  std::unique_ptr<ScaleHoldingManifold> scale_holding_;
  std::vector<std::unique_ptr<ceres::SubsetManifold>> subsets_;
  ceres::CauchyLoss loss_{options_.loss_scale};
  ceres::CauchyLoss prior_outliers_{kPriorLossScale};
  double position_noise_ = std::max(options_.noise, options_.least_noise_against_positions);
  ceres::ScaledLoss sure_position_loss_{&prior_outliers_, position_noise_* position_noise_,
                                        ceres::DO_NOT_TAKE_OWNERSHIP};
  ceres::ScaledLoss prior_loss_{&prior_outliers_, options_.noise* options_.noise,
                                ceres::DO_NOT_TAKE_OWNERSHIP};
  ceres::CauchyLoss mark_outliers_{kMarkLossScale};
  ceres::ScaledLoss mark_loss_{&mark_outliers_, position_noise_* position_noise_,
                               ceres::DO_NOT_TAKE_OWNERSHIP};
  ceres::CauchyLoss control_outliers_{scene_.control.loss_scale};
  ceres::ScaledLoss control_loss_{&control_outliers_, position_noise_* position_noise_,
                                  ceres::DO_NOT_TAKE_OWNERSHIP};
  bool has_control_ = false;
  ceres::Problem problem_;  // last: refers to the members above
};

}  // namespace

double PriorSigma(const SceneCamera& camera, int i) {
  assert(i >= 0 && static_cast<size_t>(i) < camera.prior.params.size());
  switch (ParameterKinds(camera.prior.model)[i]) {
    case ParameterKind::kFocalLength:
      return camera.focal_sigma_ratio * camera.prior.params[i];
    case ParameterKind::kPrincipalPoint:
      return kPrincipalPointSigma * std::max(camera.prior.width_px, camera.prior.height_px);
    case ParameterKind::kRadial:
      return kRadialSigma;
    case ParameterKind::kTangential:
      return kTangentialSigma;
    case ParameterKind::kRational:
      return kRationalSigma;
  }
  throw std::logic_error("unknown kind of parameter");
}

AdjustReport Adjust(const AdjustOptions& options, Scene& scene) {
  assert(IsConsistent(scene));
  return Adjustment(options, scene).Solve();
}

void WeighByTolerance(double tolerance_sigmas, AdjustOptions& options) {
  options.loss_scale = tolerance_sigmas / 4;
  options.noise = tolerance_sigmas / 8;
}

double MeasureNoise(const Scene& scene) {
  std::vector<double> errors;
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    for (const SceneElement& element : track.elements) {
      if (!element.used) continue;
      errors.push_back(ReprojectionError(scene, element, *track.position) /
                       scene.photos[element.photo].KeypointSigma(element.keypoint));
    }
  }
  const auto median = Median(std::move(errors));
  return median ? std::max(kLeastNoise, *median / kRayleighMedian) : 1;
}

}  // namespace stucco
