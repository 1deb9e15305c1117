// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/which_bay.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calib/features/best_two.h"
#include "calib/features/descriptors.h"

namespace stucco {
namespace {

using Eigen::Vector2d;

constexpr double kReachSigmas = 3.5;
// One place in two photos differs by 0.25 to 0.35 at the median.
constexpr double kAlike_rad = 0.45;
constexpr double kUnlike_rad = 0.6;  // what counts where nothing alike is found
constexpr double kUndecided_rad = 0.08;
constexpr double kLikeBlob = 2;
constexpr double kCell_m = 0.1;
constexpr int kSmooth_cells = 5;
// Of places that are one; relief and the keypoints' own errors.
constexpr double kSamePlace_m = 0.2;
constexpr double kOtherShift_m = 0.5;
constexpr int kMostRivals = 8;
constexpr int kLeastVotes = 40;
constexpr double kAhead = 4;

// Keypoints of the second photo that look like one of the first.
struct Like {
  Vector2d place;
  double angle_rad = 0;
};
using Likes = std::vector<std::vector<Like>>;  // by keypoint of the first

Vector2d PlaceOf(const OnWall& at) {
  return {at.along_m, at.z_m};
}

Vector2d MiddleOf(const WallKeypoints& keypoints) {
  Vector2d sum = Vector2d::Zero();
  for (const OnWall& at : keypoints.places) sum += PlaceOf(at);
  return sum / std::max(1.0, static_cast<double>(keypoints.places.size()));
}

Likes FindLikes(const BayQuestion& question, double reach_m) {
  const WallKeypoints& second = question.second;
  const AlongOrder columns = SortAlong(second);
  Likes likes(question.first.places.size());
  std::vector<int32_t> products(second.places.size());
  for (size_t i = 0; i < likes.size(); ++i) {
    const OnWall& here = question.first.places[i];
    const auto column = [&](double at) {
      return std::lower_bound(columns.along_m.begin(), columns.along_m.end(), at) -
             columns.along_m.begin();
    };
    const auto begin = column(here.along_m - reach_m);
    const auto end = column(here.along_m + reach_m);
    DotProducts(question.first.descriptors.data() + i * kDescriptorSize,
                columns.descriptors.data() + begin * kDescriptorSize, static_cast<int>(end - begin),
                products.data());
    for (auto c = begin; c < end; ++c) {
      const OnWall& there = second.places[columns.index[c]];
      const double size = there.scale_m / here.scale_m;
      if (std::abs(there.z_m - here.z_m) > reach_m || size > kLikeBlob || size * kLikeBlob < 1)
        continue;
      const double angle = DescriptorAngle(products[c - begin]);
      if (angle < kAlike_rad) likes[i].push_back({PlaceOf(there), angle});
    }
  }
  return likes;
}

// The most alike of those near a place.
const Like* BestNear(const std::vector<Like>& likes, const Vector2d& place, double near_m) {
  const Like* best = nullptr;
  for (const Like& like : likes) {
    if ((like.place - place).norm() > near_m) continue;
    if (best == nullptr || like.angle_rad < best->angle_rad) best = &like;
  }
  return best;
}

// Votes for shifts on the wall.
class ShiftVotes {
 public:
  explicit ShiftVotes(double reach_m)
      : half_(static_cast<int>(std::ceil(reach_m / kCell_m))),
        votes_(2 * half_ + 1, 2 * half_ + 1, CV_32F, cv::Scalar(0)) {}

  void Add(const Vector2d& shift) {
    const cv::Point cell = CellOf(shift);
    if (cv::Rect(0, 0, votes_.cols, votes_.rows).contains(cell)) votes_.at<float>(cell) += 1;
  }
  void Smooth() {
    cv::boxFilter(votes_, votes_, -1, {kSmooth_cells, kSmooth_cells}, {-1, -1}, false,
                  cv::BORDER_CONSTANT);
  }
  std::optional<Vector2d> Most() const {
    double votes = 0;
    cv::Point cell;
    cv::minMaxLoc(votes_, nullptr, &votes, nullptr, &cell);
    if (votes <= 0) return std::nullopt;
    return kCell_m * Vector2d(cell.x - half_, cell.y - half_);
  }
  // All about there.
  void Forget(const Vector2d& shift) {
    cv::circle(votes_, CellOf(shift), static_cast<int>(kOtherShift_m / kCell_m), cv::Scalar(0),
               cv::FILLED);
  }

 private:
  cv::Point CellOf(const Vector2d& shift) const {
    return {static_cast<int>(std::lround(shift.x() / kCell_m)) + half_,
            static_cast<int>(std::lround(shift.y() / kCell_m)) + half_};
  }

  int half_;
  cv::Mat votes_;
};

ShiftVotes VotesAfter(const BayQuestion& question, const Likes& likes, const WallFromWall& from,
                      double reach_m) {
  ShiftVotes votes(reach_m);
  for (size_t i = 0; i < likes.size(); ++i) {
    const Vector2d place = from * PlaceOf(question.first.places[i]).homogeneous();
    for (const Like& like : likes[i]) votes.Add(like.place - place);
  }
  votes.Smooth();
  return votes;
}

WallFromWall Shifted(WallFromWall from, const Vector2d& shift) {
  from.col(2) += shift;
  return from;
}

// Least squares over what is near its like, held to the start's directions and scale by some
// keypoints' weight: poses that are off by a hand before a wall draw it larger or smaller by a few
// hundredths.
WallFromWall Fit(const BayQuestion& question, const Likes& likes, WallFromWall from) {
  const Vector2d middle = MiddleOf(question.first);
  for (const double near_m : {0.5, 0.5, 0.4, 0.3, 0.2, 0.2}) {
    Eigen::Matrix3d normals = Eigen::Vector3d(10, 10, 1e-3).asDiagonal();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    right.topRows<2>() = 10 * Eigen::Matrix2d::Identity();
    right.row(2) = 1e-3 * (from * middle.homogeneous()).transpose();
    for (size_t i = 0; i < likes.size(); ++i) {
      const Vector2d at = PlaceOf(question.first.places[i]);
      const Vector2d place = from * at.homogeneous();
      const Like* like = BestNear(likes[i], place, near_m);
      if (like == nullptr) continue;
      const Eigen::Vector3d row = (at - middle).homogeneous();
      const double weight =
          1 / (1 + (like->place - place).squaredNorm() / (kSamePlace_m * kSamePlace_m / 4));
      normals += weight * row * row.transpose();
      right += weight * row * like->place.transpose();
    }
    from = normals.ldlt().solve(right).transpose();
    from.col(2) -= from.leftCols<2>() * middle;
  }
  return from;
}

// Whether keypoints side with `from` against `rival`.
bool IsAhead(const BayQuestion& question, const Likes& likes, const WallFromWall& from,
             const WallFromWall& rival) {
  int ahead = 0;
  int behind = 0;
  for (size_t i = 0; i < likes.size(); ++i) {
    const Eigen::Vector3d at = PlaceOf(question.first.places[i]).homogeneous();
    const Vector2d place = from * at;
    const Vector2d other = rival * at;
    if (!question.second_shows(place) || !question.second_shows(other)) continue;
    const Like* here = BestNear(likes[i], place, kSamePlace_m);
    const Like* there = BestNear(likes[i], other, kSamePlace_m);
    const double nearer = (there != nullptr ? there->angle_rad : kUnlike_rad) -
                          (here != nullptr ? here->angle_rad : kUnlike_rad);
    ahead += nearer > kUndecided_rad;
    behind += nearer < -kUndecided_rad;
  }
  return ahead >= kLeastVotes && ahead >= kAhead * behind;
}

int NumAlike(const BayQuestion& question, const Likes& likes, const WallFromWall& from) {
  int count = 0;
  for (size_t i = 0; i < likes.size(); ++i) {
    const Vector2d place = from * PlaceOf(question.first.places[i]).homogeneous();
    count += BestNear(likes[i], place, kSamePlace_m) != nullptr;
  }
  return count;
}

}  // namespace

std::optional<WallFromWall> TellBay(const BayQuestion& question) {
  const double reach_m = kReachSigmas * question.sigma_m;
  const Likes likes = FindLikes(question, reach_m + 2 * kOtherShift_m);
  const WallFromWall as_posed = WallFromWall::Identity();
  const auto most = VotesAfter(question, likes, as_posed, reach_m + kOtherShift_m).Most();
  if (!most) return std::nullopt;
  const WallFromWall told = Fit(question, likes, Shifted(as_posed, *most));
  const Vector2d middle = MiddleOf(question.first);
  if ((told * middle.homogeneous() - middle).norm() > reach_m) return std::nullopt;
  if (NumAlike(question, likes, told) < kLeastVotes) return std::nullopt;
  // Shifts from one end of what the poses allow to the other.
  ShiftVotes votes = VotesAfter(question, likes, told, 2 * (reach_m + kOtherShift_m));
  votes.Forget({0, 0});
  for (int i = 0; i < kMostRivals; ++i) {
    const auto shift = votes.Most();
    if (!shift) break;
    const WallFromWall rival = Fit(question, likes, Shifted(told, *shift));
    // From near by the fit may come back to the same shift.
    const bool same =
        (rival * middle.homogeneous() - told * middle.homogeneous()).norm() < kOtherShift_m;
    if (!same && !IsAhead(question, likes, told, rival)) return std::nullopt;
    votes.Forget(*shift);
  }
  return told;
}

}  // namespace stucco
