// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "calib/adjust/adjust.h"
#include "calib/adjust/datum.h"
#include "calib/adjust/internal/linearise.h"
#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// What the covariance of a photo's centre, of its turn (rotation vector in the camera's frame) and,
// where it has more rows, of its camera's intrinsics says.
PoseSigma SigmaOf(const Scene& scene, int photo, const Eigen::MatrixXd& covariance) {
  constexpr size_t kPoints = 25;
  const Pose& pose = *scene.photos[photo].pose;
  const double focal = scene.CameraOf(photo).FocalX();
  const Eigen::Index num_intrinsics = covariance.rows() - 6;
  const std::vector<int> tracks = TracksSeenBy(scene, photo);
  std::vector<double> squares;
  for (size_t i = 0; i < tracks.size(); i += tracks.size() / kPoints + 1) {
    const SceneTrack& track = scene.tracks[tracks[i]];
    const auto element = std::ranges::find(track.elements, photo, &SceneElement::photo);
    const Eigen::Vector3d point = pose * *track.position;
    Linearised linear;
    if (!(point.z() > 0) || !Linearise(scene, *element, *track.position, linear)) continue;
    Eigen::Matrix3d cross;
    cross << 0, -point.z(), point.y(), point.z(), 0, -point.x(), -point.y(), point.x(), 0;
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1, 0, -point.x() / point.z(), 0, 1, -point.y() / point.z();
    by_point *= focal / point.z();
    Eigen::Matrix2Xd of_pixel(2, covariance.rows());
    of_pixel.leftCols<3>() = -by_point * pose.rotation.toRotationMatrix();
    of_pixel.middleCols<3>(3) = -by_point * cross;
    of_pixel.rightCols(num_intrinsics) =
        scene.photos[photo].keypoint_sigma_px * linear.intrinsics.leftCols(num_intrinsics);
    squares.push_back((of_pixel * covariance * of_pixel.transpose()).trace());
  }
  PoseSigma sigma;
  sigma.position = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  sigma.rotation_rad = std::sqrt(covariance.block<3, 3>(3, 3).trace());
  if (!squares.empty()) sigma.picture_px = std::sqrt(*Median(std::move(squares)));
  return sigma;
}

// How robust residuals scatter: the variance of independent ones that would leave poses as
// uncertain as these do, with Cauchy loss at `scale` standard deviations. Neighbours in a picture
// err alike, by what the lens model lacks and by textures; and where only chosen tracks were
// adjusted all residuals of a photo do. They count as what their sums over cells show, of the size
// that shows most (Liang and Zeger, "Longitudinal data analysis using generalized linear models",
// 1986).
class RobustVariance {
 public:
  RobustVariance(const Scene& scene, double scale)
      : scene_(scene),
        scale_(scale),
        sums_(scene.photos.size() * kCells * kCells, Eigen::Vector2d::Zero()) {}

  void Add(const SceneElement& element, const Eigen::Vector2d& residual) {
    const double weight = 1 / (1 + residual.squaredNorm() / (scale_ * scale_));
    sums_[CellOf(element)] += weight * residual;
    slope_ += weight * weight;
    ++count_;
  }
  int num_residuals() const { return 2 * count_; }
  // With the degrees of freedom that are left.
  double Get(double num_unknowns) const {
    const double n = count_;
    const double influence = std::max({Influence(1), Influence(kCells / 2), Influence(kCells)});
    const double redundancy = std::max(1.0, 2 * n - num_unknowns) / (2 * n);
    return influence / n / std::pow(slope_ / n, 2) / redundancy;
  }

 private:
  static constexpr int kCells = 8;  // of a picture in each direction

  // Of sums over so many cells in each direction.
  double Influence(int cells) const {
    double influence = 0;
    const int blocks = kCells / cells;
    for (size_t photo = 0; photo < scene_.photos.size(); ++photo) {
      for (int block = 0; block < blocks * blocks; ++block) {
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        for (int i = 0; i < cells * cells; ++i) {
          const int row = block / blocks * cells + i / cells;
          const int column = block % blocks * cells + i % cells;
          sum += sums_[(photo * kCells + row) * kCells + column];
        }
        influence += sum.squaredNorm() / 2;
      }
    }
    return influence;
  }

  size_t CellOf(const SceneElement& element) const {
    const Camera& camera = scene_.CameraOf(element.photo);
    const Eigen::Vector2d& pixel = scene_.photos[element.photo].keypoints[element.keypoint];
    const auto cell = [](double place, int size) {
      return static_cast<size_t>(
          std::clamp(static_cast<int>(place / size * kCells), 0, kCells - 1));
    };
    return (element.photo * kCells + cell(pixel.y(), camera.height_px)) * kCells +
           cell(pixel.x(), camera.width_px);
  }

  const Scene& scene_;
  double scale_;
  std::vector<Eigen::Vector2d> sums_;  // by photo and cell
  double slope_ = 0;
  int count_ = 0;
};

// Robust residuals lose weight beyond this many deviations of their noise (AdjustOptions).
constexpr double kLossScale = 2;

// Of all observations; `num_points` gets the number of points that they determine.
RobustVariance ScatterOf(const Scene& scene, int& num_points) {
  RobustVariance scatter(scene, kLossScale * MeasureNoise(scene));
  num_points = 0;
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    ++num_points;
    for (const SceneElement& element : track.elements) {
      Linearised l;
      if (element.used && Linearise(scene, element, *track.position, l)) {
        scatter.Add(element, l.residual);
      }
    }
  }
  return scatter;
}

// The normal equations of poses and intrinsics, points eliminated.
class ReducedSystem {
 public:
  explicit ReducedSystem(const Scene& scene) : scene_(scene) {
    for (const SceneCamera& camera : scene.cameras) {
      camera_offset_.push_back(size_);
      if (camera.focal_sigma_ratio > 0) size_ += static_cast<int>(camera.intrinsics.params.size());
    }
    pose_offset_.assign(scene.photos.size(), -1);
    for (size_t i = 0; i < scene.photos.size(); ++i) {
      if (!scene.photos[i].pose) continue;
      pose_offset_[i] = size_;
      size_ += 6;
    }
    normal_ = Eigen::MatrixXd::Zero(size_, size_);
  }

  void AddTrack(const SceneTrack& track) {
    if (!track.position) return;
    sights_.clear();
    Eigen::Matrix3d point_block = Eigen::Matrix3d::Zero();
    for (const SceneElement& element : track.elements) {
      Sight sight{&element, {}};
      if (!element.used || !Linearise(scene_, element, *track.position, sight.linear)) continue;
      point_block += sight.linear.point.transpose() * sight.linear.point;
      sights_.push_back(sight);
    }
    // A point that hardly anything determines, as one just before a lens, says nothing of poses.
    const Eigen::LLT<Eigen::Matrix3d> factors(point_block);
    if (factors.info() != Eigen::Success || factors.rcond() < kLeastCondition) return;
    cross_.clear();
    for (const auto& [element, l] : sights_) {
      const int camera = scene_.photos[element->photo].camera;
      const int pose = pose_offset_[element->photo];
      AddBlock(pose, pose, l.pose.transpose() * l.pose);
      AddCross(pose, l.pose.transpose() * l.point);
      if (scene_.cameras[camera].focal_sigma_ratio == 0) continue;
      const int intrinsics = camera_offset_[camera];
      AddBlock(intrinsics, intrinsics, l.intrinsics.transpose() * l.intrinsics);
      AddBlock(pose, intrinsics, l.pose.transpose() * l.intrinsics);
      AddCross(intrinsics, l.intrinsics.transpose() * l.point);
    }
    for (const Cross& row : cross_) {
      const Eigen::Matrix3Xd solved = factors.solve(row.block.transpose());
      for (const Cross& col : cross_) {
        if (col.offset <= row.offset) {
          AddBlock(row.offset, col.offset, -(col.block * solved).transpose());
        }
      }
    }
  }

  SceneSigmas Solve(const SigmaOptions& options) {
    SceneSigmas sigmas;
    sigmas.poses.resize(scene_.photos.size());
    int num_points = 0;
    const RobustVariance scatter = ScatterOf(scene_, num_points);
    if (scatter.num_residuals() == 0) return sigmas;
    const double variance = scatter.Get(3.0 * num_points + size_);
    for (size_t c = 0; c < scene_.cameras.size(); ++c) {
      if (scene_.cameras[c].focal_sigma_ratio > 0) AddLens(c, variance);
    }
    if (!options.use_priors || !AddPriors(variance)) HoldFrame();
    const auto halves = HalfInverse(options.threads);
    if (!halves) return sigmas;
    SetIntrinsics(*halves, variance, sigmas);
    SetPoses(*halves, variance, sigmas);
    return sigmas;
  }

 private:
  static constexpr double kRounding = 1e-10;  // of what holds an unknown while all others are held
  static constexpr double kLeastCondition = 1e-10;
  static constexpr int kDatumRounds = 6;  // what is unsure loses the square of its share in each

  struct Sight {
    const SceneElement* element = nullptr;
    Linearised linear;
  };
  struct Cross {
    int offset = 0;
    Eigen::MatrixX3d block;
  };

  // Of the lower triangle; what lies above it is not looked at.
  template <typename Block>
  void AddBlock(int row, int col, const Block& block) {
    normal_.block(row, col, block.rows(), block.cols()) += block;
  }

  void AddCross(int offset, const Eigen::MatrixX3d& block) {
    const auto same = std::ranges::find(cross_, offset, &Cross::offset);
    if (same == cross_.end()) {
      cross_.push_back({offset, block});
    } else {
      same->block += block;
    }
  }

  // What the adjustment assumes about the lens. The whole system is scaled by `variance` in the
  // end, which must not make these assumptions any firmer.
  void AddLens(size_t index, double variance) {
    const SceneCamera& camera = scene_.cameras[index];
    const int offset = camera_offset_[index];
    for (int i = 0; i < static_cast<int>(camera.intrinsics.params.size()); ++i) {
      const double sigma = PriorSigma(camera, i);
      normal_(offset + i, offset + i) += variance / (sigma * sigma);
    }
    const double fx = camera.intrinsics.params[0];
    const double fy = camera.intrinsics.params[1];
    const Eigen::RowVector2d by_focal =
        Eigen::RowVector2d(-fy / (fx * fx), 1 / fx) / kFocalRatioSigma;
    AddBlock(offset, offset, variance * by_focal.transpose() * by_focal);
  }

  // Returns whether they hold the frame.
  bool AddPriors(double variance) {
    int positions = 0;
    for (size_t i = 0; i < scene_.photos.size(); ++i) {
      const ScenePhoto& photo = scene_.photos[i];
      if (!photo.pose) continue;
      const int offset = pose_offset_[i];
      if (photo.attitude) {
        // The unknowns are half angles.
        normal_.diagonal().segment<3>(offset).array() +=
            4 * variance / std::pow(photo.attitude->sigma_rad, 2);
      }
      if (!photo.prior) continue;
      const Eigen::Vector3d sigma(photo.prior->sigma_horizontal_m, photo.prior->sigma_horizontal_m,
                                  photo.prior->sigma_vertical_m);
      const Eigen::Matrix<double, 3, 6> by_pose =
          sigma.cwiseInverse().asDiagonal() * CenterByPose(*photo.pose);
      AddBlock(offset, offset, variance * by_pose.transpose() * by_pose);
      ++positions;
    }
    return positions >= 3;
  }

  // First pose, and the scale by that coordinate of the farthest pose that changes most with it.
  void HoldFrame() {
    const auto first = std::ranges::find_if(pose_offset_, [](int offset) { return offset >= 0; });
    const double strong = normal_.diagonal().maxCoeff();
    normal_.diagonal().segment<6>(*first).array() += strong;
    const Eigen::Vector3d origin = scene_.photos[first - pose_offset_.begin()].pose->Center();
    double farthest = -1;
    int index = 0;
    for (size_t i = 0; i < pose_offset_.size(); ++i) {
      if (pose_offset_[i] < 0) continue;
      const Eigen::Vector3d to_origin = *scene_.photos[i].pose * origin;
      if (to_origin.norm() <= farthest) continue;
      farthest = to_origin.norm();
      int axis = 0;
      to_origin.cwiseAbs().maxCoeff(&axis);
      index = pose_offset_[i] + 3 + axis;
    }
    normal_(index, index) += strong;
  }

  // A matrix whose product with its own transpose from the left is the inverse: M' M. Lower
  // triangular; nothing where the system is singular. Takes the system.
  std::optional<Eigen::MatrixXd> HalfInverse(int threads) {
    const Eigen::VectorXd scale = normal_.diagonal().cwiseSqrt().cwiseInverse();
    if (!scale.allFinite()) return std::nullopt;
    normal_ = scale.asDiagonal() * normal_ * scale.asDiagonal();
    // Two photos that nothing but poor records tie to the rest are held to no more than rounding.
    normal_.diagonal().array() += kRounding;
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(normal_);
    if (factors.info() != Eigen::Success) return std::nullopt;
    constexpr int kColumns = 96;
    Eigen::MatrixXd half = Eigen::MatrixXd::Zero(size_, size_);
    ParallelFor((size_ + kColumns - 1) / kColumns, threads, [&](size_t block) {
      const int begin = static_cast<int>(block) * kColumns;
      const int count = std::min(kColumns, size_ - begin);
      const int below = size_ - begin;
      auto columns = half.block(begin, begin, below, count);
      columns.topRows(count).setIdentity();
      normal_.bottomRightCorner(below, below).triangularView<Eigen::Lower>().solveInPlace(columns);
    });
    half = half * scale.asDiagonal();
    if (!half.allFinite()) return std::nullopt;
    return half;
  }

  void SetIntrinsics(const Eigen::MatrixXd& half, double variance, SceneSigmas& sigmas) const {
    for (size_t c = 0; c < scene_.cameras.size(); ++c) {
      const SceneCamera& camera = scene_.cameras[c];
      const int count = static_cast<int>(camera.intrinsics.params.size());
      Eigen::VectorXd& sigma = sigmas.intrinsics.emplace_back(Eigen::VectorXd::Zero(count));
      if (camera.focal_sigma_ratio == 0) continue;
      sigma = std::sqrt(variance) *
              half.middleCols(camera_offset_[c], count).colwise().norm().transpose();
    }
  }

  // The unknowns' covariance as half * half' says it, with what a similarity of all takes away left
  // out: one that goes by the surest half of the photos, and by others the less the less sure they
  // are. One that nothing holds would else take all with it.
  void SetPoses(const Eigen::MatrixXd& half, double variance, SceneSigmas& sigmas) const {
    Eigen::VectorXd weights(pose_offset_.size());
    for (size_t i = 0; i < pose_offset_.size(); ++i) weights[i] = pose_offset_[i] >= 0 ? 1 : 0;
    std::optional<Datum> datum;
    Eigen::MatrixXd of_similarity;
    for (int round = 0; round < kDatumRounds; ++round) {
      datum.emplace(scene_, weights);
      of_similarity = half * SimilarityByUnknowns(*datum).transpose();
      weights = WeightsIn(*datum, half, of_similarity);
    }
    for (size_t i = 0; i < pose_offset_.size(); ++i) {
      if (pose_offset_[i] < 0) continue;
      const int camera = scene_.photos[i].camera;
      const bool is_variable = scene_.cameras[camera].focal_sigma_ratio > 0;
      const Eigen::Index num_intrinsics =
          is_variable ? static_cast<Eigen::Index>(scene_.cameras[camera].intrinsics.params.size())
                      : 0;
      Eigen::MatrixXd motion(size_, 6 + num_intrinsics);
      motion.leftCols<3>() = MotionOfCenter(i, *datum, half, of_similarity);
      motion.middleCols<3>(3) =
          2 * half.middleCols<3>(pose_offset_[i]) -
          of_similarity * Datum::RotationBySimilarity(*scene_.photos[i].pose).transpose();
      motion.rightCols(num_intrinsics) = half.middleCols(camera_offset_[camera], num_intrinsics);
      sigmas.poses[i] =
          SigmaOf(scene_, static_cast<int>(i), variance * motion.transpose() * motion);
    }
  }

  // What the unknowns do to the similarity of all.
  Eigen::MatrixXd SimilarityByUnknowns(const Datum& datum) const {
    Eigen::MatrixXd similarity = Eigen::MatrixXd::Zero(7, size_);
    for (size_t i = 0; i < pose_offset_.size(); ++i) {
      if (pose_offset_[i] < 0) continue;
      similarity.middleCols<6>(pose_offset_[i]) =
          datum.ByCenter(i) * CenterByPose(*scene_.photos[i].pose);
    }
    return similarity;
  }

  Eigen::MatrixX3d MotionOfCenter(size_t photo, const Datum& datum, const Eigen::MatrixXd& half,
                                  const Eigen::MatrixXd& of_similarity) const {
    return half.middleCols<6>(pose_offset_[photo]) *
               CenterByPose(*scene_.photos[photo].pose).transpose() -
           of_similarity * datum.CenterBySimilarity(photo).transpose();
  }

  Eigen::VectorXd WeightsIn(const Datum& datum, const Eigen::MatrixXd& half,
                            const Eigen::MatrixXd& of_similarity) const {
    Eigen::VectorXd variances = Eigen::VectorXd::Zero(pose_offset_.size());
    std::vector<double> all;
    for (size_t i = 0; i < pose_offset_.size(); ++i) {
      if (pose_offset_[i] < 0) continue;
      variances[i] = MotionOfCenter(i, datum, half, of_similarity).squaredNorm();
      all.push_back(variances[i]);
    }
    const double usual = *Median(std::move(all));
    for (double& variance : variances) {
      if (variance > 0) variance = usual / std::max(usual, variance);
    }
    return variances;
  }

  const Scene& scene_;
  int size_ = 0;
  std::vector<int> camera_offset_;
  std::vector<int> pose_offset_;  // by photo; -1 without a pose
  Eigen::MatrixXd normal_;        // lower triangle
  std::vector<Sight> sights_;     // of one track
  std::vector<Cross> cross_;      // likewise
};

// Each pose with the points held, which were unknowns of the adjustment or given.
std::vector<PoseSigma> OwnSigmas(const Scene& scene, bool points_are_given) {
  std::vector<Matrix6> normals(scene.photos.size(), Matrix6::Zero());
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    for (const SceneElement& element : track.elements) {
      Linearised l;
      if (!element.used || !Linearise(scene, element, *track.position, l)) continue;
      normals[element.photo] += l.pose.transpose() * l.pose;
    }
  }
  int num_points = 0;
  const RobustVariance scatter = ScatterOf(scene, num_points);
  const double variance = scatter.Get(points_are_given ? 6.0 * NumRegistered(scene)  //
                                                       : 3.0 * num_points);
  std::vector<PoseSigma> sigmas(scene.photos.size());
  for (size_t i = 0; i < sigmas.size(); ++i) {
    if (!scene.photos[i].pose) continue;
    const Matrix6 covariance = variance * normals[i].inverse();
    if (!covariance.allFinite()) continue;
    Matrix6 motion_by_pose = Matrix6::Zero();
    motion_by_pose.topRows<3>() = CenterByPose(*scene.photos[i].pose);
    motion_by_pose.bottomLeftCorner<3, 3>() = 2 * Eigen::Matrix3d::Identity();
    sigmas[i] = SigmaOf(scene, static_cast<int>(i),
                        motion_by_pose * covariance * motion_by_pose.transpose());
  }
  return sigmas;
}

}  // namespace

SceneSigmas EstimateSigmas(const SigmaOptions& options, const Scene& scene) {
  assert(IsConsistent(scene));
  const int registered = NumRegistered(scene);
  if (options.points_are_given) return {{}, OwnSigmas(scene, true)};
  if (registered < 2) return {{}, std::vector<PoseSigma>(scene.photos.size())};
  if (registered > options.max_photos) return {{}, OwnSigmas(scene, false)};
  ReducedSystem system(scene);
  if (options.tracks.empty()) {
    for (const SceneTrack& track : scene.tracks) system.AddTrack(track);
  }
  for (const int track : options.tracks) system.AddTrack(scene.tracks[track]);
  return system.Solve(options);
}

}  // namespace stucco
