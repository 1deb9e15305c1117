// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "calib/adjust/adjust.h"
#include "calib/adjust/datum.h"
#include "calib/adjust/internal/draws.h"
#include "calib/adjust/internal/linearise.h"
#include "calib/adjust/internal/normal_matrix.h"
#include "calib/adjust/internal/scatter.h"
#include "calib/scene/hovers.h"
#include "survey/median.h"

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
    of_pixel.rightCols(num_intrinsics) = scene.photos[photo].KeypointSigma(element->keypoint) *
                                         linear.intrinsics.leftCols(num_intrinsics);
    squares.push_back((of_pixel * covariance * of_pixel.transpose()).trace());
  }
  PoseSigma sigma;
  sigma.position = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  sigma.rotation_rad = std::sqrt(covariance.block<3, 3>(3, 3).trace());
  if (!squares.empty()) sigma.picture_px = std::sqrt(*Median(std::move(squares)));
  return sigma;
}

// Where the unknowns of the normal equations stand: intrinsics, then poses.
struct Unknowns {
  explicit Unknowns(const Scene& scene) : of_pose(scene.photos.size(), -1) {
    for (const SceneCamera& camera : scene.cameras) {
      of_camera.push_back(size);
      if (camera.focal_sigma_ratio > 0) size += static_cast<int>(camera.intrinsics.params.size());
    }
    num_intrinsics = size;
    for (size_t i = 0; i < scene.photos.size(); ++i) {
      if (!scene.photos[i].pose) continue;
      of_pose[i] = size;
      size += 6;
    }
  }

  int size = 0;
  int num_intrinsics = 0;
  std::vector<int> of_camera;
  std::vector<int> of_pose;  // by photo; -1 without a pose
};

// The normal equations of poses and intrinsics, points eliminated, and draws of their right sides.
// Observations count as the adjustment's loss lets them.
class ReducedSystem {
 public:
  ReducedSystem(const Scene& scene, int threads)
      : scene_(scene),
        threads_(threads),
        unknowns_(scene),
        scatter_(ScatterOf(scene, num_points_)),
        normal_(unknowns_.size),
        as_alike_(unknowns_.size),
        as_they_are_(unknowns_.size) {
    if (scatter_.num_residuals() == 0) return;
    const double redundancy = scatter_.num_residuals() - 3.0 * num_points_;
    variance_ = scatter_.Get(3.0 * num_points_ + unknowns_.size) * scatter_.MeanSlope();
    shrunk_ = std::sqrt(scatter_.OfNeighbouringCells() * std::max(1.0, redundancy) /
                        std::max(1.0, redundancy - unknowns_.size));
  }

  void AddTrack(int index) {
    const SceneTrack& track = scene_.tracks[index];
    if (!track.position) return;
    sights_.clear();
    Eigen::Matrix3d point_block = Eigen::Matrix3d::Zero();
    for (const SceneElement& element : track.elements) {
      Sight sight{&element, {}};
      if (!element.used || !Linearise(scene_, element, *track.position, sight.linear)) continue;
      Linearised& l = sight.linear;
      const double weight = scatter_.Weight(l.residual);
      l.pose *= weight;
      l.point *= weight;
      l.intrinsics *= weight;
      point_block += l.point.transpose() * l.point;
      sights_.push_back(sight);
    }
    // A point that hardly anything determines, as one just before a lens, says nothing of poses.
    const Eigen::LLT<Eigen::Matrix3d> factors(point_block);
    if (factors.info() != Eigen::Success || factors.rcond() < kLeastCondition) return;
    cross_.clear();
    for (const auto& [element, l] : sights_) {
      const int camera = scene_.photos[element->photo].camera;
      const int pose = unknowns_.of_pose[element->photo];
      normal_.Add(pose, pose, l.pose.transpose() * l.pose);
      AddCross(pose, l.pose.transpose() * l.point);
      if (scene_.cameras[camera].focal_sigma_ratio == 0) continue;
      const int intrinsics = unknowns_.of_camera[camera];
      normal_.Add(intrinsics, intrinsics, l.intrinsics.transpose() * l.intrinsics);
      normal_.Add(pose, intrinsics, l.pose.transpose() * l.intrinsics);
      AddCross(intrinsics, l.intrinsics.transpose() * l.point);
    }
    for (const Cross& row : cross_) {
      const Eigen::Matrix3Xd solved = factors.solve(row.block.transpose());
      for (const Cross& col : cross_) {
        if (col.offset <= row.offset) {
          normal_.Add(row.offset, col.offset, -(col.block * solved).transpose());
        }
      }
    }
    Draw(factors);
  }

  SceneSigmas Solve(bool use_priors) {
    SceneSigmas sigmas;
    sigmas.poses.resize(scene_.photos.size());
    if (scatter_.num_residuals() == 0) return sigmas;
    for (size_t c = 0; c < scene_.cameras.size(); ++c) {
      if (scene_.cameras[c].focal_sigma_ratio > 0) AddLens(c);
    }
    if (!use_priors || !AddPriors()) HoldFrame();
    AddRounding();
    const std::optional<NormalFactor> factor = normal_.Factor();
    if (!factor || !SetIntrinsics(*factor, sigmas)) return sigmas;
    for (const Draws* draws : {&as_alike_, &as_they_are_}) {
      const auto solved = factor->Solve(draws->rows() / std::sqrt(Draws::kCount), threads_);
      if (solved) SetPoses(*solved, sigmas);
    }
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

  void AddCross(int offset, const Eigen::MatrixX3d& block) {
    const auto same = std::ranges::find(cross_, offset, &Cross::offset);
    if (same == cross_.end()) {
      cross_.push_back({offset, block});
    } else {
      same->block += block;
    }
  }

  // What errors of the track's observations do: of one size and each by itself, and as they are,
  // those of tracks in one cell of a picture together.
  void Draw(const Eigen::LLT<Eigen::Matrix3d>& of_point) {
    const Draws::Signs together = Draws::SignsOf(scatter_.CellOf(*sights_.front().element));
    Eigen::Matrix<double, Draws::kCount, 3> alike_by_point;
    alike_by_point.setZero();
    Eigen::Vector3d by_point = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < sights_.size(); ++i) {
      const auto& [element, l] = sights_[i];
      Eigen::Matrix<double, Draws::kCount, 2> signs;
      for (int axis = 0; axis < 2; ++axis) signs.col(axis) = NextSigns();
      signs *= std::sqrt(variance_);
      const Eigen::Vector2d residual = shrunk_ * l.residual;
      const auto add = [&](int offset, const auto& derivatives) {
        as_alike_.Add(offset, signs * derivatives);
        as_they_are_.Add(offset, together, derivatives.transpose() * residual);
      };
      add(unknowns_.of_pose[element->photo], l.pose);
      const int camera = scene_.photos[element->photo].camera;
      if (scene_.cameras[camera].focal_sigma_ratio > 0) {
        add(unknowns_.of_camera[camera], l.intrinsics);
      }
      alike_by_point += signs * l.point;
      by_point += l.point.transpose() * residual;
    }
    for (const Cross& cross : cross_) {
      const Eigen::Matrix3Xd solved = of_point.solve(cross.block.transpose());
      as_alike_.Add(cross.offset, -(alike_by_point * solved));
      as_they_are_.Add(cross.offset, together, -(solved.transpose() * by_point));
    }
  }

  Draws::Signs NextSigns() { return Draws::SignsOf(next_key_++); }

  // Something known beforehand of unknowns from `offset` on, in its standard deviations. The whole
  // is scaled by the variance of the observations, which must not make it any firmer.
  void AddKnown(int offset, const Eigen::Ref<const Eigen::RowVectorXd>& derivatives) {
    normal_.Add(offset, offset, variance_ * derivatives.transpose() * derivatives);
    const Draws::Signs signs = NextSigns();
    for (Draws* draws : {&as_alike_, &as_they_are_}) {
      draws->Add(offset, signs, variance_ * derivatives.transpose());
    }
  }

  // What the adjustment assumes about the lens.
  void AddLens(size_t index) {
    const SceneCamera& camera = scene_.cameras[index];
    const int offset = unknowns_.of_camera[index];
    const auto count = static_cast<Eigen::Index>(camera.intrinsics.params.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      const double sigma = PriorSigma(camera, static_cast<int>(i));
      AddKnown(offset, Eigen::RowVectorXd::Unit(count, i) / sigma);
    }
    const double fx = camera.intrinsics.params[0];
    const double fy = camera.intrinsics.params[1];
    Eigen::RowVectorXd by_focal = Eigen::RowVectorXd::Zero(count);
    by_focal.head<2>() = Eigen::RowVector2d(-fy / (fx * fx), 1 / fx) / kFocalRatioSigma;
    AddKnown(offset, by_focal);
  }

  // Something known of the difference of what two sets of unknowns give.
  void AddKnownBetween(int a, const Eigen::RowVectorXd& by_a, int b,
                       const Eigen::RowVectorXd& by_b) {
    const Draws::Signs signs = NextSigns();
    for (const auto& [offset, by] : {std::pair(a, &by_a), std::pair(b, &by_b)}) {
      normal_.Add(offset, offset, variance_ * by->transpose() * *by);
      for (Draws* draws : {&as_alike_, &as_they_are_}) {
        draws->Add(offset, signs, variance_ * by->transpose());
      }
    }
    if (a > b) {
      normal_.Add(a, b, variance_ * by_a.transpose() * by_b);
    } else {
      normal_.Add(b, a, variance_ * by_b.transpose() * by_a);
    }
  }

  void AddHovers() {
    for (const SamePlace& pair : SamePlaces(scene_)) {
      const auto by = [&](int photo) -> Eigen::Matrix<double, 3, 6> {
        return CenterByPose(*scene_.photos[photo].pose) / pair.sigma_m;
      };
      const Eigen::Matrix<double, 3, 6> first = by(pair.first);
      const Eigen::Matrix<double, 3, 6> second = -by(pair.second);
      for (int axis = 0; axis < 3; ++axis) {
        AddKnownBetween(unknowns_.of_pose[pair.first], first.row(axis),
                        unknowns_.of_pose[pair.second], second.row(axis));
      }
    }
  }

  // Returns whether they hold the frame.
  bool AddPriors() {
    AddHovers();
    int positions = 0;
    for (size_t i = 0; i < scene_.photos.size(); ++i) {
      const ScenePhoto& photo = scene_.photos[i];
      if (!photo.pose) continue;
      const int offset = unknowns_.of_pose[i];
      for (int axis = 0; photo.attitude && axis < 3; ++axis) {
        // The unknowns are half angles.
        AddKnown(offset, Eigen::RowVectorXd::Unit(6, axis) * 2 / photo.attitude->sigma_rad);
      }
      if (!photo.prior) continue;
      const Eigen::Vector3d sigma(photo.prior->sigma_horizontal_m, photo.prior->sigma_horizontal_m,
                                  photo.prior->sigma_vertical_m);
      const Eigen::Matrix<double, 3, 6> by_pose = CenterByPose(*photo.pose);
      for (int axis = 0; axis < 3; ++axis) {
        AddKnown(offset, by_pose.row(axis) / sigma[axis]);
      }
      ++positions;
    }
    return positions >= 3;
  }

  // First pose, and the scale by that coordinate of the farthest pose that changes most with it.
  void HoldFrame() {
    const auto& offsets = unknowns_.of_pose;
    const auto first = std::ranges::find_if(offsets, [](int offset) { return offset >= 0; });
    const double strong = normal_.Diagonal().maxCoeff();
    normal_.AddToDiagonal(*first, Eigen::VectorXd::Constant(6, strong));
    const Eigen::Vector3d origin = scene_.photos[first - offsets.begin()].pose->Center();
    double farthest = -1;
    int index = 0;
    for (size_t i = 0; i < offsets.size(); ++i) {
      if (offsets[i] < 0) continue;
      const Eigen::Vector3d to_origin = *scene_.photos[i].pose * origin;
      if (to_origin.norm() <= farthest) continue;
      farthest = to_origin.norm();
      int axis = 0;
      to_origin.cwiseAbs().maxCoeff(&axis);
      index = offsets[i] + 3 + axis;
    }
    normal_.AddToDiagonal(index, Eigen::VectorXd::Constant(1, strong));
  }

  // Two photos that nothing but poor records tie to the rest are held to no more than rounding.
  void AddRounding() {
    const Eigen::VectorXd held = kRounding * normal_.Diagonal();
    normal_.AddToDiagonal(0, held);
    for (Eigen::Index i = 0; i < held.size(); ++i) {
      const Draws::Signs signs = NextSigns();
      for (Draws* draws : {&as_alike_, &as_they_are_}) {
        draws->Add(static_cast<int>(i), signs,
                   Eigen::VectorXd::Constant(1, std::sqrt(variance_ * held[i])));
      }
    }
  }

  // From the inverse itself. Whether it could be computed.
  bool SetIntrinsics(const NormalFactor& factor, SceneSigmas& sigmas) const {
    const auto num_intrinsics = static_cast<Eigen::Index>(unknowns_.num_intrinsics);
    const auto inverse =
        factor.Solve(Eigen::MatrixXd::Identity(num_intrinsics, unknowns_.size), threads_);
    if (!inverse) return false;
    const Eigen::VectorXd all = (variance_ * inverse->diagonal()).cwiseSqrt();
    for (size_t c = 0; c < scene_.cameras.size(); ++c) {
      const SceneCamera& camera = scene_.cameras[c];
      const auto count = static_cast<Eigen::Index>(camera.intrinsics.params.size());
      Eigen::VectorXd& sigma = sigmas.intrinsics.emplace_back(Eigen::VectorXd::Zero(count));
      if (camera.focal_sigma_ratio > 0) sigma = all.segment(unknowns_.of_camera[c], count);
    }
    return true;
  }

  // What draws do to poses where that is more than what is there, with what a similarity of all
  // takes away left out: one that goes by the surest half of the photos, and by others the less the
  // less sure they are. One that nothing holds would else take all with it.
  void SetPoses(const Eigen::MatrixXd& solved, SceneSigmas& sigmas) const {
    const std::vector<int>& offsets = unknowns_.of_pose;
    Eigen::VectorXd weights(offsets.size());
    for (size_t i = 0; i < offsets.size(); ++i) weights[i] = offsets[i] >= 0 ? 1 : 0;
    std::optional<Datum> datum;
    Eigen::MatrixXd of_similarity;
    for (int round = 0; round < kDatumRounds; ++round) {
      datum.emplace(scene_, weights);
      of_similarity = solved * SimilarityByUnknowns(*datum).transpose();
      weights = WeightsIn(*datum, solved, of_similarity);
    }
    for (size_t i = 0; i < offsets.size(); ++i) {
      if (offsets[i] < 0) continue;
      const int camera = scene_.photos[i].camera;
      const bool is_variable = scene_.cameras[camera].focal_sigma_ratio > 0;
      const Eigen::Index num_intrinsics =
          is_variable ? static_cast<Eigen::Index>(scene_.cameras[camera].intrinsics.params.size())
                      : 0;
      Eigen::MatrixXd motion(solved.rows(), 6 + num_intrinsics);
      motion.leftCols<3>() = MotionOfCenter(i, *datum, solved, of_similarity);
      motion.middleCols<3>(3) =
          2 * solved.middleCols<3>(offsets[i]) -
          of_similarity * Datum::RotationBySimilarity(*scene_.photos[i].pose).transpose();
      motion.rightCols(num_intrinsics) =
          solved.middleCols(unknowns_.of_camera[camera], num_intrinsics);
      const PoseSigma shown = SigmaOf(scene_, static_cast<int>(i), motion.transpose() * motion);
      PoseSigma& sigma = sigmas.poses[i];
      sigma.position = std::max(sigma.position, shown.position);
      sigma.rotation_rad = std::max(sigma.rotation_rad, shown.rotation_rad);
      sigma.picture_px = std::max(sigma.picture_px, shown.picture_px);
    }
  }

  // What the unknowns do to the similarity of all.
  Eigen::MatrixXd SimilarityByUnknowns(const Datum& datum) const {
    Eigen::MatrixXd similarity = Eigen::MatrixXd::Zero(7, unknowns_.size);
    for (size_t i = 0; i < unknowns_.of_pose.size(); ++i) {
      if (unknowns_.of_pose[i] < 0) continue;
      similarity.middleCols<6>(unknowns_.of_pose[i]) =
          datum.ByCenter(i) * CenterByPose(*scene_.photos[i].pose);
    }
    return similarity;
  }

  Eigen::MatrixX3d MotionOfCenter(size_t photo, const Datum& datum, const Eigen::MatrixXd& solved,
                                  const Eigen::MatrixXd& of_similarity) const {
    return solved.middleCols<6>(unknowns_.of_pose[photo]) *
               CenterByPose(*scene_.photos[photo].pose).transpose() -
           of_similarity * datum.CenterBySimilarity(photo).transpose();
  }

  Eigen::VectorXd WeightsIn(const Datum& datum, const Eigen::MatrixXd& solved,
                            const Eigen::MatrixXd& of_similarity) const {
    Eigen::VectorXd variances = Eigen::VectorXd::Zero(unknowns_.of_pose.size());
    std::vector<double> all;
    for (size_t i = 0; i < unknowns_.of_pose.size(); ++i) {
      if (unknowns_.of_pose[i] < 0) continue;
      variances[i] = MotionOfCenter(i, datum, solved, of_similarity).squaredNorm();
      all.push_back(variances[i]);
    }
    const double usual = *Median(std::move(all));
    for (double& variance : variances) {
      if (variance > 0) variance = usual / std::max(usual, variance);
    }
    return variances;
  }

  const Scene& scene_;
  const int threads_;
  const Unknowns unknowns_;
  int num_points_ = 0;  // before what sets it
  const RobustVariance scatter_;
  double variance_ = 1;  // of an observation, as it counts
  double shrunk_ = 1;    // times larger than residuals are errors
  NormalMatrix normal_;
  Draws as_alike_;
  Draws as_they_are_;
  uint64_t next_key_ = uint64_t{1} << 40;  // after those of cells
  std::vector<Sight> sights_;              // of one track
  std::vector<Cross> cross_;               // likewise
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
  ReducedSystem system(scene, options.threads);
  if (options.tracks.empty()) {
    for (size_t track = 0; track < scene.tracks.size(); ++track) {
      system.AddTrack(static_cast<int>(track));
    }
  }
  for (const int track : options.tracks) system.AddTrack(track);
  return system.Solve(options.use_priors);
}

}  // namespace stucco
